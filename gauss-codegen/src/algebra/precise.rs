//! Numbers of 256 binary digits, for telling rounding errors from wrong results: two forms of one result that lose all digits of double
//! precision where their terms cancel still agree in sixty decimal places of these.

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

use num_bigint::{BigInt, BigUint, Sign};

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

    /// The power of two next to it.
    fn magnitude(self) -> i64 {
        self.exponent + DIGITS
    }

    fn times_two_to(self, power: i64) -> Self {
        if self.is_zero() { self } else { Self { exponent: self.exponent + power, ..self } }
    }

    fn integer(value: i64) -> Self {
        Self::rounded(value.into(), 0)
    }

    /// x/2ᵏ below 2⁻⁸, and k; `None` where doubling k times would lose too many digits.
    fn halved(self) -> Option<(Self, i64)> {
        let steps = if self.is_zero() { 0 } else { (self.magnitude() + 8).max(0) };
        (self.defined && steps <= DIGITS / 2).then(|| (self.times_two_to(-steps), steps))
    }

    /// `Σ xᵏ/k!` over even or odd k with alternating signs, or over all k.
    fn series(self, first: i64, step: i64, alternating: bool) -> Self {
        let mut term = if first == 0 { Self::integer(1) } else { self };
        let (mut sum, mut k) = (term, first);
        // Each pair of factors is below 2⁻¹⁶, so the end is sure.
        while !term.is_zero() && term.magnitude() > sum.magnitude() - DIGITS - 8 {
            for _ in 0..step {
                k += 1;
                term = term * self / Self::integer(k);
            }
            if alternating {
                term = -term;
            }
            sum = sum + term;
        }
        sum
    }

    fn exp(self) -> Self {
        let Some((x, doublings)) = self.halved() else { return Self::UNDEFINED };
        (0..doublings).fold(x.series(0, 1, false), |power, _| power * power)
    }

    /// From the nearest double, by Halley's iteration, which makes the digits three times as many.
    fn ln(self) -> Self {
        if !self.defined || self.negative || self.is_zero() {
            return Self::UNDEFINED;
        }
        let mantissa = self.times_two_to(-self.magnitude()).to_f64();
        let guess = mantissa.ln() + self.magnitude() as f64 * std::f64::consts::LN_2;
        (0..3).fold(Self::number(guess), |y, _| {
            let power = y.exp();
            y + ((self - power) / (self + power)).times_two_to(1)
        })
    }

    fn sqrt(self) -> Self {
        match (self.defined, self.is_zero(), self.negative) {
            (true, true, _) => Self::ZERO,
            (true, false, false) => {
                // An even exponent, and twice the digits.
                let shift = DIGITS + 2 + (self.exponent & 1);
                let root = (self.signed() << shift).sqrt();
                Self::rounded(root, (self.exponent - shift) / 2)
            }
            _ => Self::UNDEFINED,
        }
    }

    /// sinh and cosh of a small part, doubled; far from zero the difference from ±1 has no digit here.
    fn tanh(self) -> Self {
        if self.defined && !self.is_zero() && self.magnitude() > 8 {
            return self.call(Function::Signum);
        }
        let Some((x, doublings)) = self.halved() else { return Self::UNDEFINED };
        let start = (x.series(1, 2, false), x.series(0, 2, false));
        let double = |(sinh, cosh): (Self, Self), _| ((sinh * cosh).times_two_to(1), cosh * cosh + sinh * sinh);
        let (sinh, cosh) = (0..doublings).fold(start, double);
        sinh / cosh
    }

    /// Of a base that is not negative.
    fn powf(self, exponent: Self) -> Self {
        match (self.is_zero(), exponent.is_zero(), exponent.negative) {
            (_, true, _) => Self::integer(1),
            (true, _, true) => Self::UNDEFINED,
            (true, _, false) if exponent.defined => Self::ZERO,
            _ => (exponent * self.ln()).exp(),
        }
    }

    /// From the nearest double, by Newton's iteration on the tangent of what is left.
    fn atan2(self, x: Self) -> Self {
        if !self.defined || !x.defined {
            return Self::UNDEFINED;
        }
        if self.is_zero() && (x.is_zero() || !x.negative) {
            return Self::ZERO;
        }
        let scale = -self.magnitude().max(x.magnitude());
        let guess = self.times_two_to(scale).to_f64().atan2(x.times_two_to(scale).to_f64());
        (0..4).fold(Self::number(guess), |angle, _| {
            let (sin, cos) = angle.sine_cosine();
            angle + (self * cos - x * sin) / (x * cos + self * sin)
        })
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
        let Some((x, doublings)) = self.halved() else { return (Self::UNDEFINED, Self::UNDEFINED) };
        let start = (x.series(1, 2, true), x.series(0, 2, true));
        (0..doublings).fold(start, |(sin, cos), _| ((sin * cos).times_two_to(1), cos * cos - sin * sin))
    }

    fn call(self, function: Function) -> Self {
        match function {
            Function::Sin => self.sine_cosine().0,
            Function::Cos => self.sine_cosine().1,
            Function::Exp => self.exp(),
            Function::Ln => self.ln(),
            Function::Sqrt => self.sqrt(),
            Function::Abs => Self { negative: false, ..self },
            Function::Signum if !self.defined || self.is_zero() => self,
            Function::Signum => Self::integer(if self.negative { -1 } else { 1 }),
            Function::Tanh => self.tanh(),
            Function::Own(_) => Self::UNDEFINED,
        }
    }

    fn call_with(self, function: BinaryFunction, other: Self) -> Self {
        match (function, self.partial_cmp(&other)) {
            (BinaryFunction::Atan2, _) => self.atan2(other),
            (BinaryFunction::Powf, _) => self.powf(other),
            (_, None) => Self::UNDEFINED,
            (BinaryFunction::Min, Some(Ordering::Greater)) | (BinaryFunction::Max, Some(Ordering::Less)) => other,
            _ => self,
        }
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

    fn powi(self, exponent: i32) -> Self {
        let (mut power, mut square, mut remaining) = (Self::integer(1), self, exponent.unsigned_abs());
        while remaining > 0 {
            if remaining & 1 == 1 {
                power = power * square;
            }
            square = square * square;
            remaining >>= 1;
        }
        if exponent < 0 { Self::integer(1) / power } else { power }
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
