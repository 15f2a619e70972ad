//! Numbers that know how wrong they can be: running error analysis (N. J. Higham, *Accuracy and Stability of Numerical
//! Algorithms*, 2nd ed., section 3.3).
//!
//! Each operation carries the bounds of its operands on and adds its own rounding, so that "agree" needs no tolerance that
//! somebody chose: two results of exact arithmetic that are equal differ by no more than the sum of their bounds.

use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use gauss_runtime::prelude::Real;

/// Unit roundoff, doubled: what one operation adds, with room for the rounding of the bounds themselves.
const UNIT: f64 = f64::EPSILON;

/// A computed number and a bound on its distance from the exact one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounded {
    /// The computed number.
    pub value: f64,
    /// |computed − exact| is at most this.
    pub bound: f64,
}

impl Bounded {
    /// A number known up to `bound`.
    pub fn new(value: f64, bound: f64) -> Self {
        Self { value, bound }
    }

    /// The result of one rounded operation on operands whose errors contribute `inherited`.
    fn rounded(value: f64, inherited: f64) -> Self {
        // The last term is what gradual underflow can lose.
        Self { value, bound: inherited * (1.0 + UNIT) + UNIT * value.abs() + f64::MIN_POSITIVE }
    }

    /// A library function: faithful to two units in the last place.
    fn function(value: f64, inherited: f64) -> Self {
        Self { value, bound: inherited + 2.0 * UNIT * value.abs() + f64::MIN_POSITIVE }
    }

    /// The smallest magnitude that the exact number can have.
    fn least(self) -> f64 {
        (self.value.abs() - self.bound).max(0.0)
    }
}

// Operations are never inlined: kernels are thousands of them in a row, which would take the compiler twice as long.

impl Add for Bounded {
    type Output = Self;
    #[inline(never)]
    fn add(self, other: Self) -> Self {
        Self::rounded(self.value + other.value, self.bound + other.bound)
    }
}

impl Sub for Bounded {
    type Output = Self;
    #[inline(never)]
    fn sub(self, other: Self) -> Self {
        Self::rounded(self.value - other.value, self.bound + other.bound)
    }
}

impl Mul for Bounded {
    type Output = Self;
    #[inline(never)]
    fn mul(self, other: Self) -> Self {
        let inherited = self.value.abs() * other.bound + other.value.abs() * self.bound + self.bound * other.bound;
        Self::rounded(self.value * other.value, inherited)
    }
}

impl Div for Bounded {
    type Output = Self;
    #[inline(never)]
    fn div(self, other: Self) -> Self {
        let quotient = self.value / other.value;
        Self::rounded(quotient, (self.bound + quotient.abs() * other.bound) / other.least())
    }
}

impl Neg for Bounded {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, bound: self.bound }
    }
}

macro_rules! assigning {
    ($($trait:ident $assign:ident $method:ident;)+) => {$(
        impl $trait for Bounded {
            fn $assign(&mut self, other: Self) {
                *self = self.$method(other);
            }
        }
    )+};
}

assigning! {
    AddAssign add_assign add;
    SubAssign sub_assign sub;
    MulAssign mul_assign mul;
    DivAssign div_assign div;
}

impl Real for Bounded {
    const LANES: usize = 1;

    fn lane(self, _: usize) -> f64 {
        self.value
    }
    fn zero() -> Self {
        Self::new(0.0, 0.0)
    }
    fn one() -> Self {
        Self::new(1.0, 0.0)
    }
    fn from_f64(value: f64) -> Self {
        Self::new(value, 0.0)
    }
    fn ratio(p: i64, q: i64) -> Self {
        Self::rounded(f64::ratio(p, q), 0.0)
    }
    fn sqrt(self) -> Self {
        // |√x − √y| = |x − y|/(√x + √y).
        let root = self.value.sqrt();
        let inherited = if self.bound == 0.0 { 0.0 } else { self.bound / (root + self.least().sqrt()) };
        Self::rounded(root, inherited)
    }
    fn sin_cos(self) -> (Self, Self) {
        // Mean value theorem: the derivative nearby is at most its value here plus the distance.
        let (sine, cosine) = self.value.sin_cos();
        let inherited = |derivative: f64| (derivative.abs() + self.bound).min(1.0) * self.bound;
        (Self::function(sine, inherited(cosine)), Self::function(cosine, inherited(sine)))
    }
    fn asin(self) -> Self {
        let slope = 1.0 / (1.0 - (self.value.abs() + self.bound).powi(2)).max(0.0).sqrt();
        Self::function(self.value.asin(), if self.bound == 0.0 { 0.0 } else { slope * self.bound })
    }
    fn acos(self) -> Self {
        let slope = 1.0 / (1.0 - (self.value.abs() + self.bound).powi(2)).max(0.0).sqrt();
        Self::function(self.value.acos(), if self.bound == 0.0 { 0.0 } else { slope * self.bound })
    }
    fn atan(self) -> Self {
        Self::function(self.value.atan(), self.bound / (1.0 + self.least().powi(2)))
    }
    fn atan2(self, x: Self) -> Self {
        // The angle seen from the origin of a disc with the radius of both bounds.
        let radius = self.value.hypot(x.value);
        let disc = self.bound.hypot(x.bound);
        let inherited = if disc < radius { (disc / radius).asin() } else { std::f64::consts::PI };
        Self::function(self.value.atan2(x.value), inherited)
    }
    fn sinh(self) -> Self {
        Self::function(self.value.sinh(), self.bound * (self.value.abs() + self.bound).cosh())
    }
    fn cosh(self) -> Self {
        Self::function(self.value.cosh(), self.bound * (self.value.abs() + self.bound).sinh())
    }
    fn tanh(self) -> Self {
        Self::function(self.value.tanh(), self.bound)
    }
    fn exp(self) -> Self {
        Self::function(self.value.exp(), self.bound * (self.value + self.bound).exp())
    }
    fn ln(self) -> Self {
        Self::function(self.value.ln(), self.bound / self.least())
    }
    fn abs(self) -> Self {
        Self::new(self.value.abs(), self.bound)
    }
    fn is_finite(self) -> bool {
        self.value.is_finite() && self.bound.is_finite()
    }
    fn select_lt(a: Self, b: Self, x: Self, y: Self) -> Self {
        // Both branches of the runtime's functions are accurate where either is taken, so the value alone decides.
        if a.value < b.value { x } else { y }
    }
}
