//! Numbers of two doubles, of 106 binary digits: what the results of programs in double precision are compared with.
//! Twenty operations of the machine each, where [`Precise`] allocates.
//!
//! Sums and products after Dekker (1971) and Joldes, Muller & Popescu, Tight and rigorous error bounds for basic
//! building blocks of double-word arithmetic (2017): the error is some units of 2⁻¹⁰⁴.

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::algebra::expressions::function::{BinaryFunction, Function};
use crate::algebra::numbers::elementary::{self, ManyDigits};
use crate::algebra::numbers::evaluate::{Number, Scalar};
use crate::algebra::numbers::precise::Precise;
use crate::algebra::rational::Rational;

/// The unevaluated sum of a double and of another one below half a unit in its last place.
#[derive(Clone, Copy, Debug)]
pub struct Doubled {
    high: f64,
    low: f64,
}

impl Doubled {
    const fn new(value: f64) -> Self {
        Self { high: value, low: 0.0 }
    }

    /// a + b without an error, whatever their sizes (Knuth).
    fn sum(a: f64, b: f64) -> Self {
        let high = a + b;
        let part = high - a;
        Self { high, low: (a - (high - part)) + (b - part) }
    }

    /// The same of |a| ≥ |b|.
    fn ordered(a: f64, b: f64) -> Self {
        let high = a + b;
        Self { high, low: b - (high - a) }
    }

    /// a·b without an error.
    fn product(a: f64, b: f64) -> Self {
        let high = a * b;
        Self { high, low: a.mul_add(b, -high) }
    }

    /// The nearest to a number of more digits.
    pub fn nearest(value: Precise) -> Self {
        let high = value.to_f64();
        Self { high, low: (value - Precise::number(high)).to_f64() }
    }
}

impl Scalar for Doubled {
    fn number(value: f64) -> Self {
        Self::new(value)
    }

    fn fraction(value: Rational) -> Self {
        let high = value.to_f64();
        if value.is_dyadic() && value.parts().is_some_and(|(n, d)| n as f64 / d as f64 == high && n as f64 as i64 == n)
        {
            return Self::new(high);
        }
        Self::nearest(Precise::fraction(value))
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

impl Number for Doubled {
    /// A third of the digits may cancel before.
    const NEGLIGIBLE: f64 = 1e-20;

    fn to_f64(self) -> f64 {
        self.high
    }

    fn is_finite(self) -> bool {
        self.high.is_finite() && self.low.is_finite()
    }
}

impl ManyDigits for Doubled {
    const STEPS: u32 = 1;

    fn magnitude(self) -> i64 {
        (self.high.to_bits() >> 52 & 0x7ff) as i64 - 1022
    }

    fn times_two_to(self, power: i64) -> Self {
        // In two parts, each in the range of doubles.
        let power = power.clamp(-2000, 2000) as i32;
        let parts = [power / 2, power - power / 2].map(|power| 2.0_f64.powi(power));
        Self { high: self.high * parts[0] * parts[1], low: self.low * parts[0] * parts[1] }
    }
}

impl Add for Doubled {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let (high, low) = (Self::sum(self.high, other.high), Self::sum(self.low, other.low));
        let first = Self::ordered(high.high, high.low + low.high);
        Self::ordered(first.high, first.low + low.low)
    }
}

impl Sub for Doubled {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Neg for Doubled {
    type Output = Self;
    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl Mul for Doubled {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let product = Self::product(self.high, other.high);
        Self::ordered(product.high, product.low + (self.high * other.low + self.low * other.high))
    }
}

impl Div for Doubled {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self - other * Self::new(first);
        let second = rest.high / other.high;
        let rest = rest - other * Self::new(second);
        Self::ordered(first, second) + Self::new(rest.high / other.high)
    }
}

impl PartialEq for Doubled {
    fn eq(&self, other: &Self) -> bool {
        (self.high, self.low) == (other.high, other.low)
    }
}

impl PartialOrd for Doubled {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        (self.high, self.low).partial_cmp(&(other.high, other.low))
    }
}

#[cfg(test)]
mod tests {
    use super::{Doubled, Precise};
    use crate::algebra::numbers::evaluate::{Number, Scalar};
    use crate::algebra::{BinaryFunction, Function, Rational};

    fn exact(x: Doubled) -> Precise {
        Precise::number(x.high) + Precise::number(x.low)
    }

    /// Apart by less than some roundings of 106 digits, of the size.
    fn agree(what: &str, found: Doubled, expected: Precise) {
        let apart = (exact(found) - expected).to_f64().abs();
        assert!(
            apart <= 64.0 * 2.0_f64.powi(-104) * expected.to_f64().abs(),
            "{what}: {found:?} {expected:?} {apart:e}"
        );
    }

    #[test]
    fn arithmetic_and_functions_agree_with_those_of_more_digits() {
        let third = Doubled::fraction(Rational::new(1, 3));
        for x in [1e-30, 3.7e-9, 0.02, 0.7, 1.0, 2.5, 31.4, 600.0, 1.234e6] {
            for (x, p) in
                [(Doubled::new(x), Precise::number(x)), (Doubled::new(x) * third, exact(Doubled::new(x) * third))]
            {
                let t = exact(third);
                agree("sum", x + third, p + t);
                agree("difference", third - x, t - p);
                agree("product", x * third, p * t);
                agree("quotient", third / x, t / p);
                agree("power", x.powi(-3), p.powi(-3));
                // The angle itself is cut off in its last digit: what that does to a small sine is excused.
                let ((sin, cos), (s, c)) = (x.sine_cosine(), p.sine_cosine());
                for (found, expected) in [(sin, s), (cos, c)] {
                    let apart = (exact(found) - expected).to_f64().abs();
                    assert!(
                        apart <= 2.0_f64.powi(-100) * expected.to_f64().abs() + p.to_f64() * 2.0_f64.powi(-108),
                        "{x:?}"
                    );
                }
                agree("sqrt", x.call(Function::Sqrt), p.call(Function::Sqrt));
                agree("ln", x.call(Function::Ln) + Doubled::new(100.0), p.call(Function::Ln) + Precise::number(100.0));
                agree("tanh", x.call(Function::Tanh), p.call(Function::Tanh));
                agree("atan2", x.call_with(BinaryFunction::Atan2, -third), p.call_with(BinaryFunction::Atan2, -t));
                if x.high <= 600.0 {
                    let (found, expected) = (x.call(Function::Exp), p.call(Function::Exp));
                    let apart = ((exact(found) - expected) / expected).to_f64().abs();
                    assert!(apart <= (1.0 + x.high) * 2.0_f64.powi(-98), "{x:?} {apart:e}");
                }
            }
        }
    }
}
