//! Exact coefficients.

use std::cmp::Ordering;
use std::fmt;
use std::hash::{Hash, Hasher};
use std::ops::{Div, Mul, MulAssign, Neg, Sub};

use num_bigint::BigInt;
use num_rational::{BigRational, Ratio};
use num_traits::{CheckedAdd, CheckedDiv, CheckedMul, Signed, ToPrimitive, Zero};

use crate::algebra::large;
use crate::algebra::map::Key;

/// A fraction. Arithmetic never panics and never overflows; it rounds nothing up to a thousand bits, and by 2⁻²⁵⁶
/// beyond (see `large.rs`). What has no value, as a quotient by zero, becomes `0/0`, which stays `0/0` and is noticed
/// by the graph (see `Graph::is_undefined`).
///
/// Nearly all coefficients are small integers, so those take a short way past the greatest common divisors of
/// `num_rational`, whose equality and hash are also needlessly general for reduced fractions.
#[derive(Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(from = "(String, String)", into = "(String, String)")
)]
pub struct Rational {
    /// Numerator; of a large fraction its index.
    numerator: i64,
    /// Positive; zero without a value, [`LARGE`] where 64 bits are too few.
    denominator: i64,
}

/// The denominator of fractions that are kept in a table.
const LARGE: i64 = -1;

impl Rational {
    const UNDEFINED: Self = Self { numerator: 0, denominator: 0 };

    /// The fraction in lowest terms; without a value where the denominator is zero.
    pub fn new(numerator: i64, denominator: i64) -> Self {
        match (numerator, denominator) {
            (_, 0) => Self::UNDEFINED,
            (i64::MIN, _) | (_, i64::MIN) => BigRational::new(numerator.into(), denominator.into()).into(),
            _ => Self::from(Ratio::new(numerator, denominator)),
        }
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

    /// Numerator and denominator, where 64-bit integers hold them.
    pub fn parts(self) -> Option<(i64, i64)> {
        (self.denominator > 0).then_some((self.numerator, self.denominator))
    }

    /// Terms m·2ⁿ, the largest first, whose sum is this fraction to 180 binary digits.
    pub fn leading_terms(self) -> Vec<(i64, i64)> {
        self.exact().map_or_else(Vec::new, |value| large::leading_terms(&value, 3))
    }

    /// Whether it has no value.
    pub const fn is_undefined(self) -> bool {
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

    /// Whether it is less than 0.
    pub fn is_negative(self) -> bool {
        if self.denominator == LARGE { large::kept(self.numerator).is_negative() } else { self.numerator < 0 }
    }

    /// A fraction that binary floating point holds exactly (its numerator being small).
    pub const fn is_dyadic(self) -> bool {
        self.denominator > 0 && self.denominator & (self.denominator - 1) == 0 && self.numerator.abs() < 1 << 24
    }

    /// Without its sign.
    pub fn abs(self) -> Self {
        if self.is_negative() { -self } else { self }
    }

    /// 1/x; without a value of 0.
    pub fn recip(self) -> Self {
        match (self.numerator, self.denominator) {
            (_, LARGE) => Self::one() / self,
            (0, _) => Self::UNDEFINED,
            (n, d) if n < 0 => Self { numerator: -d, denominator: -n },
            (n, d) => Self { numerator: d, denominator: n },
        }
    }

    /// Its power.
    pub fn pow(self, exponent: i32) -> Self {
        let mut square = if exponent < 0 { self.recip() } else { self };
        let (mut power, mut remaining) = (Self::one(), exponent.unsigned_abs());
        while remaining > 0 {
            if remaining & 1 == 1 {
                power *= square;
            }
            remaining >>= 1;
            if remaining > 0 {
                square *= square;
            }
        }
        power
    }

    /// The sum.
    pub fn plus(self, other: Self) -> Self {
        if self.denominator == 1
            && other.denominator == 1
            && let Some(sum) = self.numerator.checked_add(other.numerator)
            && sum != i64::MIN
        {
            return Self::from_integer(sum);
        }
        self.general(other, |a, b| a.checked_add(b), |a, b| a + b)
    }

    /// The greatest fraction of which both are multiples: that of the numerators over the least common multiple of the
    /// denominators.
    pub fn common_divisor(self, other: Self) -> Self {
        if self.denominator > 0 && other.denominator > 0 {
            let numerator = greatest_common_divisor(self.numerator, other.numerator);
            let factor = other.denominator / greatest_common_divisor(self.denominator, other.denominator);
            if let Some(denominator) = self.denominator.checked_mul(factor) {
                return Self { numerator, denominator };
            }
        }
        let (Some(a), Some(b)) = (self.exact(), other.exact()) else { return Self::UNDEFINED };
        // gcd(a/b, c/d) = gcd(a d, c b)/(b d).
        let (mut m, mut n) = (a.numer() * b.denom(), b.numer() * a.denom());
        while !n.is_zero() {
            (m, n) = (n.clone(), m % n);
        }
        BigRational::new(m.abs(), a.denom() * b.denom()).into()
    }

    /// Common divisor of both as they are written: the greatest common divisor of the numerators over that of the
    /// denominators.
    pub fn shared_with(self, other: Self) -> Self {
        if self.denominator > 0 && other.denominator > 0 {
            return Self {
                numerator: greatest_common_divisor(self.numerator, other.numerator),
                denominator: greatest_common_divisor(self.denominator, other.denominator),
            };
        }
        self.common_divisor(other)
    }

    /// Within 64 bits where that is possible; the most negative integer counts as large, so that negation never
    /// overflows.
    fn general(
        self,
        other: Self,
        small: impl Fn(&Ratio<i64>, &Ratio<i64>) -> Option<Ratio<i64>>,
        large: impl Fn(&BigRational, &BigRational) -> BigRational,
    ) -> Self {
        let raw = |r: Self| Ratio::new_raw(r.numerator, r.denominator);
        if self.denominator > 0
            && other.denominator > 0
            && let Some(result) = small(&raw(self), &raw(other)).filter(|result| *result.numer() != i64::MIN)
        {
            return Self { numerator: *result.numer(), denominator: *result.denom() };
        }
        match (self.exact(), other.exact()) {
            (Some(a), Some(b)) => large(&a, &b).into(),
            _ => Self::UNDEFINED,
        }
    }

    /// As a fraction of integers of any length.
    pub fn exact(self) -> Option<BigRational> {
        match self.denominator {
            0 => None,
            LARGE => Some(large::kept(self.numerator).clone()),
            denominator => Some(Ratio::new_raw(self.numerator.into(), denominator.into())),
        }
    }

    /// The nearest number in double precision.
    pub fn to_f64(self) -> f64 {
        const WHOLE: i64 = 1 << f64::MANTISSA_DIGITS;
        if self.denominator >= 0 && self.numerator.abs() <= WHOLE && self.denominator <= WHOLE {
            return self.numerator as f64 / self.denominator as f64;
        }
        self.exact().and_then(|value| value.to_f64()).unwrap_or(f64::NAN)
    }
}

/// Numerator and denominator in decimal digits; what is no fraction of these has no value.
impl From<(String, String)> for Rational {
    fn from((numerator, denominator): (String, String)) -> Self {
        match (numerator.parse::<BigInt>(), denominator.parse::<BigInt>()) {
            (Ok(numerator), Ok(denominator)) if !denominator.is_zero() => {
                BigRational::new(numerator, denominator).into()
            }
            _ => Self::UNDEFINED,
        }
    }
}

impl From<Rational> for (String, String) {
    fn from(value: Rational) -> Self {
        let digits = |value: BigRational| (value.numer().to_string(), value.denom().to_string());
        value.exact().map_or_else(|| ("0".into(), "0".into()), digits)
    }
}

/// Euclid's algorithm.
fn greatest_common_divisor(mut a: i64, mut b: i64) -> i64 {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a.abs()
}

impl From<Ratio<i64>> for Rational {
    fn from(reduced: Ratio<i64>) -> Self {
        match *reduced.numer() {
            numerator @ i64::MIN => BigRational::new(numerator.into(), (*reduced.denom()).into()).into(),
            numerator => Self { numerator, denominator: *reduced.denom() },
        }
    }
}

impl From<BigRational> for Rational {
    fn from(reduced: BigRational) -> Self {
        let small = |n: &BigInt| i64::try_from(n).ok().filter(|&n| n != i64::MIN);
        if let (Some(numerator), Some(denominator)) = (small(reduced.numer()), small(reduced.denom())) {
            return Self { numerator, denominator };
        }
        large::bounded(reduced)
            .map_or(Self::UNDEFINED, |value| Self { numerator: large::keep(value), denominator: LARGE })
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
        if self.is_one() {
            return other;
        }
        if other.is_one() {
            return self;
        }
        if self.denominator == 1
            && other.denominator == 1
            && let Some(product) = self.numerator.checked_mul(other.numerator)
            && product != i64::MIN
        {
            return Self::from_integer(product);
        }
        self.general(other, |a, b| a.checked_mul(b), |a, b| a * b)
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
        match (other.numerator, other.denominator) {
            (0, 1) => return Self::UNDEFINED,
            (1, 1) => return self,
            (-1, 1) => return -self,
            _ => {}
        }
        self.general(other, |a, b| a.checked_div(b), |a, b| a / b)
    }
}

impl Neg for Rational {
    type Output = Self;
    fn neg(self) -> Self {
        match self.denominator {
            LARGE => self * Self::from_integer(-1),
            _ => Self { numerator: -self.numerator, denominator: self.denominator },
        }
    }
}

impl Sub for Rational {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.plus(-other)
    }
}

/// Key by value, whatever the index of a large one.
impl Key for Rational {
    fn word(&self) -> u64 {
        match self.denominator {
            LARGE => self.to_f64().to_bits(),
            denominator => (self.numerator as u64) ^ (denominator as u64).rotate_left(32),
        }
    }
}

impl Hash for Rational {
    fn hash<H: Hasher>(&self, state: &mut H) {
        state.write_u64(self.word());
    }
}

/// Order by value; 128 bits hold the cross products. What has no value comes first.
impl Ord for Rational {
    fn cmp(&self, other: &Self) -> Ordering {
        if self.denominator > 0 && other.denominator > 0 {
            let cross = |a: &Self, b: &Self| i128::from(a.numerator) * i128::from(b.denominator);
            return cross(self, other).cmp(&cross(other, self));
        }
        self.exact().cmp(&other.exact())
    }
}

impl PartialOrd for Rational {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl fmt::Debug for Rational {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.exact() {
            Some(value) => write!(f, "{value}"),
            None => f.write_str("0/0"),
        }
    }
}
