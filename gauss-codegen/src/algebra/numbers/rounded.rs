//! Numbers of 256 digits with what rounding to doubles may do to them: tell zeros that rounding left from numbers that
//! are too small.

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::algebra::expressions::function::{BinaryFunction, Function};
use crate::algebra::numbers::evaluate::{Number, Scalar};
use crate::algebra::numbers::precise::Precise;
use crate::algebra::rational::Rational;

/// A value, and how far the same operations in double precision may end from it, to first order.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct ErrorBound {
    pub value: Precise,
    error: Precise,
}

impl ErrorBound {
    /// A result, which is rounded once more.
    fn of(value: Precise, inherited: Precise) -> Self {
        Self { value, error: inherited + Precise::number(f64::EPSILON) * size(value) }
    }

    /// Whether doubles cannot tell it from zero.
    pub fn may_be_zero(self) -> bool {
        size(self.value) <= self.error
    }
}

fn size(value: Precise) -> Precise {
    value.call(Function::Abs)
}

impl Add for ErrorBound {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        Self::of(self.value + b.value, self.error + b.error)
    }
}

impl Sub for ErrorBound {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        self + -b
    }
}

impl Mul for ErrorBound {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        Self::of(self.value * b.value, self.error * size(b.value) + size(self.value) * b.error)
    }
}

impl Div for ErrorBound {
    type Output = Self;
    fn div(self, b: Self) -> Self {
        let value = self.value / b.value;
        Self::of(value, (self.error + size(value) * b.error) / size(b.value))
    }
}

impl Neg for ErrorBound {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, ..self }
    }
}

impl Scalar for ErrorBound {
    fn number(value: f64) -> Self {
        Self::of(Precise::number(value), Precise::number(0.0))
    }

    fn fraction(value: Rational) -> Self {
        Self::of(Precise::fraction(value), Precise::number(0.0))
    }

    fn sine_cosine(self) -> (Self, Self) {
        let (sine, cosine) = self.value.sine_cosine();
        (Self::of(sine, self.error), Self::of(cosine, self.error))
    }

    fn call(self, function: Function) -> Self {
        // Where it is exact an infinite slope is left out.
        let zero = Precise::number(0.0);
        let inherited = if self.error == zero { zero } else { size(function.slope(self.value)) * self.error };
        Self::of(self.value.call(function), inherited)
    }

    fn call_with(self, function: BinaryFunction, other: Self) -> Self {
        let (a, b) = (self.value, other.value);
        let value = a.call_with(function, b);
        let inherited = match function {
            BinaryFunction::Atan2 => (self.error * size(b) + other.error * size(a)) / (a * a + b * b),
            BinaryFunction::Min | BinaryFunction::Max => self.error + other.error,
            BinaryFunction::Powf => size(value) * (size(b / a) * self.error + size(a.call(Function::Ln)) * other.error),
        };
        Self::of(value, inherited)
    }
}

impl Number for ErrorBound {
    const NEGLIGIBLE: f64 = Precise::NEGLIGIBLE;

    fn to_f64(self) -> f64 {
        self.value.to_f64()
    }

    fn is_finite(self) -> bool {
        self.value.is_finite() && self.error.is_finite()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_rounding_leaves_and_what_is_small() {
        let of = |numerator, denominator| ErrorBound::fraction(Rational::new(numerator, denominator));
        let (sine, cosine) = of(7, 10).sine_cosine();
        let one = of(1, 1);
        assert!((sine * sine + cosine * cosine - one).may_be_zero());
        assert!((of(3, 10) * of(1, 10) - of(3, 100)).may_be_zero() && of(0, 1).may_be_zero());
        assert!((of(2, 1).call(Function::Sqrt).powi(2) - of(2, 1)).may_be_zero());
        let small = ErrorBound::number(1e-200);
        assert!(!(small * small).may_be_zero() && !(small / (one / small)).may_be_zero());
        assert!((one + small * small - one).may_be_zero());
        // Ten digits are left.
        assert!(!(of(1, 1) + of(1, 1_000_000) - one).may_be_zero());
    }
}
