//! Dual numbers over any scalar: exact derivatives along a flow, through the generated kernels themselves.

use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use gauss_runtime::prelude::Real;

/// `value + ε rate` with ε² = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<T> {
    /// The number.
    pub value: T,
    /// Its derivative.
    pub rate: T,
}

impl<T: Real> Dual<T> {
    /// A number and its derivative.
    pub fn new(value: T, rate: T) -> Self {
        Self { value, rate }
    }

    /// f(self) from the value and the derivative of f.
    fn chain(self, value: T, derivative: T) -> Self {
        Self::new(value, derivative * self.rate)
    }
}

// Operations are never inlined: kernels are thousands of them in a row, which would take the compiler twice as long.

impl<T: Real> Add for Dual<T> {
    type Output = Self;
    #[inline(never)]
    fn add(self, other: Self) -> Self {
        Self::new(self.value + other.value, self.rate + other.rate)
    }
}

impl<T: Real> Sub for Dual<T> {
    type Output = Self;
    #[inline(never)]
    fn sub(self, other: Self) -> Self {
        Self::new(self.value - other.value, self.rate - other.rate)
    }
}

impl<T: Real> Mul for Dual<T> {
    type Output = Self;
    #[inline(never)]
    fn mul(self, other: Self) -> Self {
        Self::new(self.value * other.value, self.rate * other.value + self.value * other.rate)
    }
}

impl<T: Real> Div for Dual<T> {
    type Output = Self;
    #[inline(never)]
    fn div(self, other: Self) -> Self {
        let quotient = self.value / other.value;
        Self::new(quotient, (self.rate - quotient * other.rate) / other.value)
    }
}

impl<T: Real> Neg for Dual<T> {
    type Output = Self;
    fn neg(self) -> Self {
        Self::new(-self.value, -self.rate)
    }
}

macro_rules! assigning {
    ($($trait:ident $assign:ident $method:ident;)+) => {$(
        impl<T: Real> $trait for Dual<T> {
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

impl<T: Real> Real for Dual<T> {
    const LANES: usize = T::LANES;
    const EPSILON: f64 = T::EPSILON;

    fn lane(self, i: usize) -> f64 {
        self.value.lane(i)
    }
    fn zero() -> Self {
        Self::new(T::zero(), T::zero())
    }
    fn one() -> Self {
        Self::new(T::one(), T::zero())
    }
    fn from_f64(value: f64) -> Self {
        Self::new(T::from_f64(value), T::zero())
    }
    fn ratio(p: i64, q: i64) -> Self {
        Self::new(T::ratio(p, q), T::zero())
    }
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.chain(root, (root + root).recip())
    }
    fn sin_cos(self) -> (Self, Self) {
        let (sine, cosine) = self.value.sin_cos();
        (self.chain(sine, cosine), self.chain(cosine, -sine))
    }
    fn asin(self) -> Self {
        self.chain(self.value.asin(), (T::one() - self.value * self.value).sqrt().recip())
    }
    fn acos(self) -> Self {
        self.chain(self.value.acos(), -(T::one() - self.value * self.value).sqrt().recip())
    }
    fn atan(self) -> Self {
        self.chain(self.value.atan(), (T::one() + self.value * self.value).recip())
    }
    fn atan2(self, x: Self) -> Self {
        let square = self.value * self.value + x.value * x.value;
        Self::new(self.value.atan2(x.value), (x.value * self.rate - self.value * x.rate) / square)
    }
    fn sinh(self) -> Self {
        self.chain(self.value.sinh(), self.value.cosh())
    }
    fn cosh(self) -> Self {
        self.chain(self.value.cosh(), self.value.sinh())
    }
    fn tanh(self) -> Self {
        let tanh = self.value.tanh();
        self.chain(tanh, T::one() - tanh * tanh)
    }
    fn exp(self) -> Self {
        let exp = self.value.exp();
        self.chain(exp, exp)
    }
    fn ln(self) -> Self {
        self.chain(self.value.ln(), self.value.recip())
    }
    fn abs(self) -> Self {
        if self.value.lane(0) < 0.0 { -self } else { self }
    }
    fn is_finite(self) -> bool {
        self.value.is_finite() && self.rate.is_finite()
    }
    fn select_lt(a: Self, b: Self, x: Self, y: Self) -> Self {
        Self::new(T::select_lt(a.value, b.value, x.value, y.value), T::select_lt(a.value, b.value, x.rate, y.rate))
    }
}
