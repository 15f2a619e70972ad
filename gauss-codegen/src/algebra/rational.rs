//! Exact coefficients.

use std::cmp::Ordering;
use std::ops::{Div, Mul, MulAssign, Neg, Sub};

use num_rational::Ratio;
use num_traits::{CheckedAdd, CheckedDiv, CheckedMul};

/// A fraction of 64-bit integers. Arithmetic never panics and never rounds: what leaves the range becomes `0/0`, which
/// stays `0/0` and is noticed by the graph (see `Graph::overflowed`).
///
/// Nearly all coefficients are small integers, so those take a short way past the greatest common divisors of
/// `num_rational`, whose equality and hash are also needlessly general for reduced fractions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(from = "(i64, i64)", into = "(i64, i64)")
)]
pub struct Rational {
    numerator: i64,
    denominator: i64,
}

impl Rational {
    const OVERFLOW: Self = Self { numerator: 0, denominator: 0 };

    /// The reduced fraction; `0/0` where the denominator is 0.
    pub fn new(numerator: i64, denominator: i64) -> Self {
        if denominator == 0 {
            return Self::OVERFLOW;
        }
        Self::from(Ratio::new(numerator, denominator))
    }

    /// n/1.
    pub const fn from_integer(value: i64) -> Self {
        Self { numerator: value, denominator: 1 }
    }

    /// 0.
    pub const fn zero() -> Self {
        Self::from_integer(0)
    }

    /// 1.
    pub const fn one() -> Self {
        Self::from_integer(1)
    }

    /// The numerator, which has the sign.
    pub const fn numer(self) -> i64 {
        self.numerator
    }

    /// The denominator: positive, or 0 out of range.
    pub const fn denom(self) -> i64 {
        self.denominator
    }

    /// Whether it left the range.
    pub const fn is_overflow(self) -> bool {
        self.denominator == 0
    }

    /// Whether it is 0.
    pub const fn is_zero(self) -> bool {
        self.numerator == 0 && self.denominator == 1
    }

    /// Whether it is 1.
    pub const fn is_one(self) -> bool {
        self.numerator == 1 && self.denominator == 1
    }

    /// Whether its denominator is 1.
    pub const fn is_integer(self) -> bool {
        self.denominator == 1
    }

    /// Whether it is less than 0.
    pub const fn is_negative(self) -> bool {
        self.numerator < 0
    }

    /// A fraction that binary floating point holds exactly (its numerator being small).
    pub const fn is_dyadic(self) -> bool {
        self.denominator > 0 && self.denominator & (self.denominator - 1) == 0 && self.numerator.abs() < 1 << 24
    }

    /// Without its sign.
    pub const fn abs(self) -> Self {
        Self { numerator: self.numerator.abs(), denominator: self.denominator }
    }

    /// 1/x; `0/0` of 0.
    pub fn recip(self) -> Self {
        match self.numerator {
            0 => Self::OVERFLOW,
            n if n < 0 => Self { numerator: -self.denominator, denominator: -n },
            n => Self { numerator: self.denominator, denominator: n },
        }
    }

    /// Its power.
    pub fn pow(self, exponent: i32) -> Self {
        let base = if exponent < 0 { self.recip() } else { self };
        (0..exponent.unsigned_abs()).fold(Self::one(), |power, _| power * base)
    }

    /// The sum.
    pub fn plus(self, other: Self) -> Self {
        if self.denominator == 1 && other.denominator == 1 {
            return Self::integer_or_overflow(self.numerator.checked_add(other.numerator));
        }
        self.general(other, |a, b| a.checked_add(b))
    }

    fn integer_or_overflow(value: Option<i64>) -> Self {
        value.filter(|&n| n != i64::MIN).map_or(Self::OVERFLOW, Self::from_integer)
    }

    fn general(self, other: Self, operation: impl Fn(&Ratio<i64>, &Ratio<i64>) -> Option<Ratio<i64>>) -> Self {
        if self.is_overflow() || other.is_overflow() {
            return Self::OVERFLOW;
        }
        let raw = |r: Self| Ratio::new_raw(r.numerator, r.denominator);
        operation(&raw(self), &raw(other)).map_or(Self::OVERFLOW, Self::from)
    }

    /// The nearest number in double precision, for numerators and denominators below 2⁵³.
    pub fn to_f64(self) -> f64 {
        self.numerator as f64 / self.denominator as f64
    }
}

impl From<Ratio<i64>> for Rational {
    /// The most negative integer counts as out of range, so that negation never overflows.
    fn from(reduced: Ratio<i64>) -> Self {
        match *reduced.numer() {
            i64::MIN => Self::OVERFLOW,
            numerator => Self { numerator, denominator: *reduced.denom() },
        }
    }
}

/// Numerator and denominator.
impl From<(i64, i64)> for Rational {
    fn from((numerator, denominator): (i64, i64)) -> Self {
        match (numerator, denominator) {
            (i64::MIN, _) | (_, i64::MIN) => Self::OVERFLOW,
            _ => Self::new(numerator, denominator),
        }
    }
}

impl From<Rational> for (i64, i64) {
    fn from(value: Rational) -> Self {
        (value.numerator, value.denominator)
    }
}

impl From<i64> for Rational {
    fn from(value: i64) -> Self {
        Self::from_integer(value)
    }
}

impl Mul for Rational {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        if self.denominator == 1 && other.denominator == 1 {
            return Self::integer_or_overflow(self.numerator.checked_mul(other.numerator));
        }
        self.general(other, |a, b| a.checked_mul(b))
    }
}

impl MulAssign for Rational {
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

impl Div for Rational {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        if other.numerator == 0 {
            return Self::OVERFLOW;
        }
        self.general(other, |a, b| a.checked_div(b))
    }
}

impl Neg for Rational {
    type Output = Self;
    fn neg(self) -> Self {
        Self { numerator: -self.numerator, denominator: self.denominator }
    }
}

impl Sub for Rational {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.plus(-other)
    }
}

/// By value; 128 bits hold the cross products.
impl Ord for Rational {
    fn cmp(&self, other: &Self) -> Ordering {
        let cross = |a: &Self, b: &Self| i128::from(a.numerator) * i128::from(b.denominator);
        cross(self, other).cmp(&cross(other, self))
    }
}

impl PartialOrd for Rational {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
