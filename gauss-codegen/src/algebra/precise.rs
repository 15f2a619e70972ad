//! Numbers of 256 binary digits, for telling rounding errors from wrong results: two forms of one result that lose all digits of double
//! precision where their terms cancel still agree in sixty decimal places of these.

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

use num_bigint::{BigInt, BigUint, Sign};

use super::elementary::{self, ManyDigits};
use super::evaluate::{Number, Scalar};
use super::function::{BinaryFunction, Function};
use super::rational::Rational;

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

    /// m·2ⁿ, rounded.
    fn rounded(value: BigInt, exponent: i64) -> Self {
        let (sign, mut mantissa) = value.into_parts();
        if sign == Sign::NoSign {
            return Self::ZERO;
        }
        let mut shift = mantissa.bits() as i64 - DIGITS;
        if shift > 0 {
            mantissa = (mantissa + (BigUint::from(1_u8) << (shift - 1))) >> shift;
            // All ones, rounded up.
            if mantissa.bits() as i64 > DIGITS {
                mantissa >>= 1;
                shift += 1;
            }
        } else {
            mantissa <<= -shift;
        }
        let exponent = exponent + shift;
        if exponent.abs() > RANGE {
            return if exponent < 0 { Self::ZERO } else { Self::UNDEFINED };
        }
        let mut digits = [0; 4];
        digits.iter_mut().zip(mantissa.iter_u64_digits()).for_each(|(to, from)| *to = from);
        Self { defined: true, negative: sign == Sign::Minus, mantissa: digits, exponent }
    }

    /// The mantissa with its sign.
    fn signed(self) -> BigInt {
        let bytes: Vec<u8> = self.mantissa.iter().flat_map(|digit| digit.to_le_bytes()).collect();
        BigInt::from_bytes_le(if self.negative { Sign::Minus } else { Sign::Plus }, &bytes)
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
        Self::rounded(if value < 0.0 { -mantissa } else { mantissa }.into(), exponent)
    }

    fn fraction(value: Rational) -> Self {
        value.exact().map_or(Self::UNDEFINED, |value| {
            Self::rounded(value.numer().clone(), 0) / Self::rounded(value.denom().clone(), 0)
        })
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
        Self::rounded((large.signed() << apart) + small.signed(), small.exponent)
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
        Self::rounded(self.signed() * other.signed(), self.exponent + other.exponent)
    }
}

impl Div for Precise {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        if !self.defined || !other.defined || other.is_zero() {
            return Self::UNDEFINED;
        }
        let quotient = (self.signed() << (DIGITS + 2)) / other.signed();
        Self::rounded(quotient, self.exponent - other.exponent - DIGITS - 2)
    }
}

impl PartialEq for Precise {
    fn eq(&self, other: &Self) -> bool {
        self.partial_cmp(other) == Some(Ordering::Equal)
    }
}

impl PartialOrd for Precise {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        let difference = *self - *other;
        match (difference.defined, difference.is_zero(), difference.negative) {
            (false, ..) => None,
            (_, true, _) => Some(Ordering::Equal),
            (_, _, true) => Some(Ordering::Less),
            (_, _, false) => Some(Ordering::Greater),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::evaluate::{Number, Scalar};
    use super::super::{BinaryFunction, Function, Rational};
    use super::Precise;

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
}
