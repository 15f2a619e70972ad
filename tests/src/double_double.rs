//! Double-double numbers: the unevaluated sum of two doubles, some 31 decimal digits (T. J. Dekker, Numerische
//! Mathematik 18, 1971; Y. Hida, X. S. Li & D. H. Bailey, *Algorithms for quad-double precision floating point
//! arithmetic*, 2001).

use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use gauss_runtime::prelude::Real;

/// `high + low`, where `low` is at most half a unit in the last place of `high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DoubleDouble {
    /// The double nearest to it.
    pub high: f64,
    /// The rest.
    pub low: f64,
}

/// π, its first 33 digits.
const PI: DoubleDouble = DoubleDouble { high: std::f64::consts::PI, low: 1.2246467991473532e-16 };

/// Terms of power series of arguments below one, with room to spare: 1/28! is 3e-30, and the arguments are below 0.79.
const TERMS: i64 = 34;

/// a + b exactly (Knuth).
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let part = sum - a;
    (sum, (a - (sum - part)) + (b - part))
}

/// a + b exactly where |a| is the larger (Dekker).
fn quick_two_sum(a: f64, b: f64) -> DoubleDouble {
    let high = a + b;
    DoubleDouble { high, low: b - (high - a) }
}

/// a b exactly: the rounding of a product is a double.
fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    (product, a.mul_add(b, -product))
}

impl From<f64> for DoubleDouble {
    fn from(value: f64) -> Self {
        Self::new(value)
    }
}

impl DoubleDouble {
    /// Nothing.
    pub const ZERO: Self = Self::new(0.0);
    /// One.
    pub const ONE: Self = Self::new(1.0);

    /// A double.
    #[must_use]
    pub const fn new(value: f64) -> Self {
        Self { high: value, low: 0.0 }
    }

    fn integer(value: i64) -> Self {
        let high = value as f64;
        quick_two_sum(high, (i128::from(value) - high as i128) as f64)
    }

    /// A decimal fraction.
    ///
    /// # Panics
    /// When it is none.
    #[must_use]
    pub fn decimal(text: &str) -> Self {
        let (sign, digits) = text.strip_prefix('-').map_or((1, text), |rest| (-1, rest));
        let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
        let (ten, mut value) = (Self::integer(10), Self::zero());
        for digit in whole.chars().chain(fraction.chars()) {
            value = value * ten + Self::integer(i64::from(digit.to_digit(10).expect("a decimal digit")));
        }
        let places = i32::try_from(fraction.len()).expect("not that many");
        Self::integer(sign) * value / Real::powi(ten, places)
    }

    /// Σ over k of xᵏ/k! from k = `first` in steps of `step`, with signs that alternate if `sign` is −1.
    fn series(self, first: i64, step: i64, sign: i64) -> Self {
        let (mut term, mut sum) = (Self::one(), Self::zero());
        for k in 0..TERMS {
            if k >= first && (k - first) % step == 0 {
                sum += if sign < 0 && (k - first) / step % 2 == 1 { -term } else { term };
            }
            term *= self / Self::integer(k + 1);
        }
        sum
    }
}

impl Add for DoubleDouble {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let (high, rest) = two_sum(self.high, other.high);
        let (low, lowest) = two_sum(self.low, other.low);
        let sum = quick_two_sum(high, rest + low);
        quick_two_sum(sum.high, sum.low + lowest)
    }
}

impl Neg for DoubleDouble {
    type Output = Self;
    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl Sub for DoubleDouble {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let (high, rest) = two_product(self.high, other.high);
        quick_two_sum(high, rest + (self.high * other.low + self.low * other.high))
    }
}

impl Div for DoubleDouble {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let mut rest = self;
        let mut quotient = Self::zero();
        for _ in 0..3 {
            let digit = Self::new(rest.high / other.high);
            quotient += digit;
            rest -= digit * other;
        }
        quotient
    }
}

macro_rules! assign {
    ($($trait:ident $method:ident $operation:ident;)+) => {$(
        impl $trait for DoubleDouble {
            fn $method(&mut self, other: Self) {
                *self = self.$operation(other);
            }
        }
    )+};
}

assign! {
    AddAssign add_assign add;
    SubAssign sub_assign sub;
    MulAssign mul_assign mul;
    DivAssign div_assign div;
}

impl Real for DoubleDouble {
    const LANES: usize = 1;
    /// 2⁻¹⁰⁴.
    const EPSILON: f64 = f64::EPSILON * f64::EPSILON;
    const DERIVATIVES: bool = false;

    fn lane(self, _: usize) -> f64 {
        self.high
    }
    fn zero() -> Self {
        Self::ZERO
    }
    fn one() -> Self {
        Self::ONE
    }
    fn from_f64(value: f64) -> Self {
        Self::new(value)
    }
    fn ratio(p: i64, q: i64) -> Self {
        Self::integer(p) / Self::integer(q)
    }
    fn sqrt(self) -> Self {
        if self.high == 0.0 {
            return self;
        }
        // A step of Newton's from the root of the double doubles its digits.
        let root = Self::new(self.high.sqrt());
        root + (self - root * root) / (root + root)
    }
    fn sin_cos(self) -> (Self, Self) {
        // The nearest multiple of π/2; the rest is at most π/4.
        let quarters = (self.high / std::f64::consts::FRAC_PI_2).round();
        let rest = self - PI * Self::new(0.5 * quarters);
        let (sine, cosine) = (rest.series(1, 2, -1), rest.series(0, 2, -1));
        match quarters.rem_euclid(4.0) as u8 {
            0 => (sine, cosine),
            1 => (cosine, -sine),
            2 => (-sine, -cosine),
            _ => (-cosine, sine),
        }
    }
    fn asin(self) -> Self {
        self.atan2((Self::one() - self * self).sqrt())
    }
    fn acos(self) -> Self {
        (Self::one() - self * self).sqrt().atan2(self)
    }
    fn atan(self) -> Self {
        self.atan2(Self::one())
    }
    fn atan2(self, x: Self) -> Self {
        // Off by δ of 1e-16 the double's angle leaves y cos − x sin = r sin δ, which is r δ to 48 digits.
        let near = Self::new(self.high.atan2(x.high));
        let radius = (self * self + x * x).sqrt();
        if radius.high == 0.0 {
            return near;
        }
        let (sine, cosine) = near.sin_cos();
        near + (self * cosine - x * sine) / radius
    }
    fn sinh(self) -> Self {
        if self.high.abs() < 0.7 {
            return self.series(1, 2, 1);
        }
        let growing = self.exp();
        (growing - growing.recip()) * Self::new(0.5)
    }
    fn cosh(self) -> Self {
        let growing = self.exp();
        (growing + growing.recip()) * Self::new(0.5)
    }
    fn tanh(self) -> Self {
        self.sinh() / self.cosh()
    }
    fn exp(self) -> Self {
        // e^x = (e^(x/2ⁿ))^(2ⁿ) with an argument below one half.
        let halvings = if self.high == 0.0 { 0 } else { (self.high.abs().log2().ceil() as i32 + 1).clamp(0, 12) };
        let mut power = (self * Self::new(0.5_f64.powi(halvings))).series(0, 1, 1);
        (0..halvings).for_each(|_| power *= power);
        power
    }
    fn ln(self) -> Self {
        let near = Self::new(self.high.ln());
        near + (self * (-near).exp() - Self::one())
    }
    fn abs(self) -> Self {
        if self.high < 0.0 { -self } else { self }
    }
    fn is_finite(self) -> bool {
        self.high.is_finite() && self.low.is_finite()
    }
    fn select_lt(a: Self, b: Self, x: Self, y: Self) -> Self {
        if a.high < b.high || (a.high == b.high && a.low < b.low) { x } else { y }
    }
}
