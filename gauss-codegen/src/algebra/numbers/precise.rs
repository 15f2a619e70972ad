//! Numbers of 256 binary digits, for telling rounding errors from wrong results: two forms of one result that lose all
//! digits of double precision where their terms cancel still agree in sixty decimal places of these.

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

use num_bigint::{BigInt, BigUint};
use num_traits::Signed;

use crate::algebra::expressions::function::{BinaryFunction, Function};
use crate::algebra::numbers::elementary::{self, ManyDigits};
use crate::algebra::numbers::evaluate::{Number, Scalar};
use crate::algebra::numbers::limbs;
use crate::algebra::rational::Rational;

/// Binary digits of a number.
const DIGITS: i64 = 256;

/// Exponents beyond which a number is too large to be one, or zero.
const RANGE: i64 = 1 << 40;

/// ±m·2ⁿ with 256-bit m, rounded to nearest; copied freely. Without a value outside the domains of functions.
#[derive(Clone, Copy, Debug)]
pub struct Precise {
    defined: bool,
    negative: bool,
    /// The least significant first; the first bit of the last is set, unless all are zero.
    mantissa: [u64; 4],
    exponent: i64,
}

impl Precise {
    const UNDEFINED: Self = Self { defined: false, negative: false, mantissa: [0; 4], exponent: 0 };
    const ZERO: Self = Self { defined: true, negative: false, mantissa: [0; 4], exponent: 0 };

    /// ±m·2ⁿ, rounded; m by its digits, the least significant first.
    fn rounded(negative: bool, digits: &[u64], exponent: i64) -> Self {
        let mut length = digits.len();
        while length > 0 && digits[length - 1] == 0 {
            length -= 1;
        }
        if length == 0 {
            return Self::ZERO;
        }
        let mut shift = 64 * length as i64 - i64::from(digits[length - 1].leading_zeros()) - DIGITS;
        let mut mantissa = limbs::window(digits, shift);
        if shift > 0 && limbs::bit(digits, shift - 1) && limbs::increment(&mut mantissa) {
            // All ones, rounded up.
            mantissa = [0, 0, 0, 1 << 63];
            shift += 1;
        }
        let exponent = exponent + shift;
        if exponent.abs() > RANGE {
            return if exponent < 0 { Self::ZERO } else { Self::UNDEFINED };
        }
        Self { defined: true, negative, mantissa, exponent }
    }

    /// An integer, rounded.
    fn integer(value: &BigInt) -> Self {
        Self::rounded(value.is_negative(), &value.magnitude().to_u64_digits(), 0)
    }

    /// The mantissa as an integer of any length.
    fn integer_mantissa(self) -> BigUint {
        BigUint::new(self.mantissa.iter().flat_map(|&digit| [digit as u32, (digit >> 32) as u32]).collect())
    }

    fn is_zero(self) -> bool {
        self.defined && self.mantissa == [0; 4]
    }
}

impl Scalar for Precise {
    fn number(value: f64) -> Self {
        if !value.is_finite() {
            return Self::UNDEFINED;
        }
        let bits = value.to_bits();
        let (biased, fraction) = ((bits >> 52 & 0x7ff) as i64, (bits & ((1 << 52) - 1)) as i64);
        let (mantissa, exponent) = if biased == 0 { (fraction, -1074) } else { (fraction | 1 << 52, biased - 1075) };
        Self::rounded(value < 0.0, &[mantissa as u64], exponent)
    }

    fn fraction(value: Rational) -> Self {
        if let Some((numerator, denominator)) = value.parts() {
            let above = Self::rounded(numerator < 0, &[numerator.unsigned_abs()], 0);
            return if denominator == 1 { above } else { above / Self::rounded(false, &[denominator as u64], 0) };
        }
        value.exact().map_or(Self::UNDEFINED, |value| Self::integer(value.numer()) / Self::integer(value.denom()))
    }

    fn sine_cosine(self) -> (Self, Self) {
        elementary::sine_cosine(self)
    }

    fn call(self, function: Function) -> Self {
        elementary::call(self, function)
    }

    fn call_with(self, function: BinaryFunction, other: Self) -> Self {
        elementary::call_with(self, function, other)
    }
}

impl Number for Precise {
    /// A third of the digits may cancel before.
    const NEGLIGIBLE: f64 = 1e-50;

    fn to_f64(self) -> f64 {
        if !self.defined {
            return f64::NAN;
        }
        // 53 of the digits, and powers of two in steps that do not leave the range too early.
        let top = self.mantissa[3] as f64 * if self.negative { -1.0 } else { 1.0 };
        let exponent = (self.exponent + 192).clamp(-2200, 2200) as i32;
        top * 2.0_f64.powi(exponent / 2) * 2.0_f64.powi(exponent - exponent / 2)
    }

    fn is_finite(self) -> bool {
        self.defined
    }
}

impl ManyDigits for Precise {
    const STEPS: u32 = 2;

    fn magnitude(self) -> i64 {
        if self.is_zero() { -RANGE } else { self.exponent + DIGITS }
    }

    fn times_two_to(self, power: i64) -> Self {
        if self.is_zero() { self } else { Self { exponent: self.exponent + power, ..self } }
    }
}

impl Add for Precise {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        if !self.defined || !other.defined {
            return Self::UNDEFINED;
        }
        let (large, small) = if other.is_zero() || self.exponent >= other.exponent && !self.is_zero() {
            (self, other)
        } else {
            (other, self)
        };
        let apart = large.exponent - small.exponent;
        // What is too small to be seen is left out.
        if small.is_zero() || apart > 2 * DIGITS {
            return large;
        }
        let mut digits = limbs::raised(large.mantissa, apart as usize);
        if large.negative == small.negative {
            limbs::add(&mut digits, small.mantissa);
            return Self::rounded(large.negative, &digits, small.exponent);
        }
        let larger = !limbs::subtract(&mut digits, small.mantissa);
        Self::rounded(large.negative == larger, &digits, small.exponent)
    }
}

impl Sub for Precise {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Neg for Precise {
    type Output = Self;
    fn neg(self) -> Self {
        Self { negative: !self.negative && !self.is_zero(), ..self }
    }
}

impl Mul for Precise {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        if !self.defined || !other.defined {
            return Self::UNDEFINED;
        }
        let digits = limbs::product(self.mantissa, other.mantissa);
        Self::rounded(self.negative != other.negative, &digits, self.exponent + other.exponent)
    }
}

impl Div for Precise {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        if !self.defined || !other.defined || other.is_zero() {
            return Self::UNDEFINED;
        }
        let (negative, exponent) = (self.negative != other.negative, self.exponent - other.exponent - DIGITS - 2);
        // Nearly always by an integer or a double.
        if let [0, 0, 0, divisor] = other.mantissa {
            let quotient = limbs::quotient(limbs::raised(self.mantissa, DIGITS as usize + 2 - 192), divisor);
            return Self::rounded(negative, &quotient, exponent);
        }
        let quotient = (self.integer_mantissa() << (DIGITS + 2)) / other.integer_mantissa();
        Self::rounded(negative, &quotient.to_u64_digits(), exponent)
    }
}

impl PartialEq for Precise {
    fn eq(&self, other: &Self) -> bool {
        // A number has one form.
        let form = |p: &Self| (p.defined, p.negative, p.exponent, p.mantissa);
        self.defined && form(self) == form(other)
    }
}

impl PartialOrd for Precise {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        let sign = |p: &Self| if p.is_zero() { 0 } else { 1 - 2 * i32::from(p.negative) };
        let [a, b, c, d] = self.mantissa;
        let [e, f, g, h] = other.mantissa;
        let sizes = (self.exponent, d, c, b, a).cmp(&(other.exponent, h, g, f, e));
        let order = match sign(self).cmp(&sign(other)) {
            Ordering::Equal if self.negative => sizes.reverse(),
            Ordering::Equal => sizes,
            signs => signs,
        };
        (self.defined && other.defined).then_some(order)
    }
}

#[cfg(test)]
mod tests {
    use std::cmp::Ordering;

    use num_bigint::{BigInt, BigUint, Sign};

    use super::{DIGITS, Precise};
    use crate::algebra::numbers::evaluate::{Number, Scalar};
    use crate::algebra::{BinaryFunction, Function, Rational};

    const POINTS: [f64; 9] = [1e-30, 3.7e-9, 0.02, 0.7, 1.0, 2.5, 31.4, 690.0, 1.234e8];

    /// Apart by less than 2⁻²⁰⁰ of the size.
    fn agree(what: &str, a: Precise, b: Precise) {
        let apart = (a - b).call(Function::Abs).to_f64();
        assert!(apart <= 2.0_f64.powi(-200) * (1.0 + a.to_f64().abs()), "{what}: {a:?} {b:?}");
    }

    #[test]
    fn doubles_stay_what_they_are() {
        for x in POINTS.into_iter().flat_map(|x| [x, -x, x.recip()]).chain([0.0, f64::MAX, f64::MIN_POSITIVE, 5e-324]) {
            assert_eq!(Precise::number(x).to_f64(), x);
        }
        assert!(!Precise::number(f64::INFINITY).is_finite() && !Precise::number(f64::NAN).is_finite());
    }

    #[test]
    fn arithmetic() {
        let third = Precise::fraction(Rational::new(1, 3));
        agree("3/3", third * Precise::number(3.0), Precise::number(1.0));
        agree("power", third.powi(-5), Precise::number(243.0));
        // (10¹⁰ + ⅓) − 10¹⁰.
        let far = Precise::number(1e10);
        agree("difference", far + third - far, third);
        assert!(third > Precise::ZERO && -third < Precise::ZERO && third < far);
        assert!(!(third / Precise::ZERO).is_finite());
    }

    #[test]
    fn functions_and_their_inverses() {
        for x in POINTS {
            let p = Precise::number(x);
            let (sin, cos) = p.sine_cosine();
            agree("sin² + cos²", sin * sin + cos * cos, Precise::number(1.0));
            assert!((sin.to_f64() - x.sin()).abs() < 1e-15 && (cos.to_f64() - x.cos()).abs() < 1e-15, "{x}");
            agree("sqrt", p.call(Function::Sqrt).powi(2) / p, Precise::number(1.0));
            let (one, power) = (Precise::number(1.0), p.call(Function::Exp));
            agree("tanh", p.call(Function::Tanh), (power - one / power) / (power + one / power));
            agree("powf", p.call_with(BinaryFunction::Powf, Precise::number(2.5)).powi(2) / p.powi(5), one);
            agree("ln", p.call(Function::Ln).call(Function::Exp) / p, Precise::number(1.0));
            let (y, x) = (sin * p, cos * p);
            let angle = y.call_with(BinaryFunction::Atan2, x);
            let (s, c) = angle.sine_cosine();
            agree("atan2", s * p, y);
            agree("atan2", c * p, x);
        }
        assert!(!Precise::number(-1.0).call(Function::Sqrt).is_finite());
        assert!(!Precise::ZERO.call(Function::Ln).is_finite());
        let of_pi = Precise::ZERO.call_with(BinaryFunction::Atan2, Precise::number(-1.0));
        assert_eq!(of_pi.to_f64(), std::f64::consts::PI);
    }
    fn signed(p: Precise) -> BigInt {
        BigInt::from_biguint(if p.negative { Sign::Minus } else { Sign::Plus }, p.integer_mantissa())
    }

    /// An integer of any length to 256 digits, halves away from zero.
    fn nearest(value: &BigInt, exponent: i64) -> (BigInt, i64) {
        let shift = value.bits() as i64 - DIGITS;
        let half = BigUint::from(u8::from(shift > 0)) << (shift - 1).max(0);
        let rounded = (value.magnitude() + half) >> shift.max(0) << (-shift).max(0);
        // All ones, rounded up.
        let over = i64::from(rounded.bits() as i64 > DIGITS);
        (BigInt::from_biguint(value.sign(), rounded >> over), exponent + shift + over)
    }

    /// Sums, products and quotients of numbers that are near, far apart, of few digits, or all ones.
    #[test]
    fn the_same_as_with_integers_of_any_length() {
        let mut word = 1_u64;
        let mut random = || {
            word = word.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            word ^ word >> 29
        };
        let mut numbers = Vec::new();
        for k in 0..60_u64 {
            let mut digits = [random(), random(), random(), random()];
            digits[..(k % 5).min(3) as usize].fill(if k % 3 == 0 { 0 } else { u64::MAX });
            if k % 7 == 0 {
                digits[3] = u64::MAX;
            }
            numbers.push(Precise::rounded(k % 2 == 0, &digits, (random() % 700) as i64 * i64::from(k % 4 > 0)));
        }
        let holds = |found: Precise, (mantissa, exponent): (BigInt, i64)| {
            assert!(
                found.is_zero() && mantissa == BigInt::ZERO || (signed(found), found.exponent) == (mantissa, exponent)
            );
        };
        for (a, b) in numbers.iter().flat_map(|a| numbers.iter().map(move |b| (*a, *b))) {
            holds(a * b, nearest(&(signed(a) * signed(b)), a.exponent + b.exponent));
            holds(a / b, nearest(&((signed(a) << (DIGITS + 2)) / signed(b)), a.exponent - b.exponent - DIGITS - 2));
            let least = a.exponent.min(b.exponent);
            let difference = a - b;
            let order = if difference.negative { Ordering::Less } else { Ordering::Greater };
            let order = if difference.is_zero() { Ordering::Equal } else { order };
            assert_eq!((a.partial_cmp(&b), a == b), (Some(order), difference.is_zero()));
            if (a.exponent - b.exponent).abs() <= 2 * DIGITS {
                let sum = (signed(a) << (a.exponent - least)) + (signed(b) << (b.exponent - least));
                holds(a + b, nearest(&sum, least));
            }
        }
    }
}
