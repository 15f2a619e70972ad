//! Dual numbers over any numbers: what expressions and programs are run in for derivatives that owe nothing to symbolic
//! ones, and over dual numbers again for second ones.

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::algebra::expressions::function::{BinaryFunction, Function};
use crate::algebra::numbers::evaluate::{Number, Scalar};
use crate::algebra::rational::Rational;

/// A value and its rate along a direction.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Dual<N> {
    pub value: N,
    pub rate: N,
}

impl<N: Number> Dual<N> {
    pub fn constant(value: N) -> Self {
        Self { value, rate: N::number(0.0) }
    }

    /// f of it, with f and f′ at its value. Where it does not move an infinite slope is left out.
    fn chain(self, value: N, slope: impl FnOnce() -> N) -> Self {
        let zero = N::number(0.0);
        Self { value, rate: if self.rate == zero { zero } else { slope() * self.rate } }
    }
}

impl<N: Number> Add for Dual<N> {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        Self { value: self.value + b.value, rate: self.rate + b.rate }
    }
}

impl<N: Number> Sub for Dual<N> {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        Self { value: self.value - b.value, rate: self.rate - b.rate }
    }
}

impl<N: Number> Mul for Dual<N> {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        Self { value: self.value * b.value, rate: self.rate * b.value + self.value * b.rate }
    }
}

impl<N: Number> Div for Dual<N> {
    type Output = Self;
    fn div(self, b: Self) -> Self {
        let value = self.value / b.value;
        Self { value, rate: (self.rate - value * b.rate) / b.value }
    }
}

impl<N: Number> Neg for Dual<N> {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, rate: -self.rate }
    }
}

impl<N: Number> Scalar for Dual<N> {
    fn number(value: f64) -> Self {
        Self::constant(N::number(value))
    }

    fn fraction(value: Rational) -> Self {
        Self::constant(N::fraction(value))
    }

    fn sine_cosine(self) -> (Self, Self) {
        let (sine, cosine) = self.value.sine_cosine();
        (self.chain(sine, || cosine), self.chain(cosine, || -sine))
    }

    fn call(self, function: Function) -> Self {
        self.chain(self.value.call(function), || function.slope(self.value))
    }

    fn call_with(self, function: BinaryFunction, other: Self) -> Self {
        let (a, b) = (self.value, other.value);
        let value = a.call_with(function, b);
        match function {
            BinaryFunction::Atan2 => Self { value, rate: (self.rate * b - other.rate * a) / (a * a + b * b) },
            BinaryFunction::Min | BinaryFunction::Max => {
                if value == a {
                    self
                } else {
                    other
                }
            }
            BinaryFunction::Powf => {
                let less = a.call_with(BinaryFunction::Powf, b - N::number(1.0));
                let by_exponent = other.chain(value, || value * a.call(Function::Ln));
                Self { value, rate: self.chain(value, || b * less).rate + by_exponent.rate }
            }
        }
    }
}

impl<N: Number> Number for Dual<N> {
    const NEGLIGIBLE: f64 = N::NEGLIGIBLE;

    fn to_f64(self) -> f64 {
        self.value.to_f64()
    }

    fn is_finite(self) -> bool {
        self.value.is_finite() && self.rate.is_finite()
    }

    fn powi(self, exponent: i32) -> Self {
        self.chain(self.value.powi(exponent), || N::number(exponent.into()) * self.value.powi(exponent - 1))
    }
}
