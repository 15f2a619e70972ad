//! Numbers of two doubles, of 106 binary digits: what the results of programs in double precision are compared with. Twenty operations of the
//! machine each, where [`Precise`](super::Precise) allocates.
//!
//! Sums and products after Dekker (1971) and Joldes, Muller & Popescu, Tight and rigorous error bounds for basic building blocks of
//! double-word arithmetic (2017): the error is some units of 2⁻¹⁰⁴.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::evaluate::{Number, Scalar};
use super::function::{BinaryFunction, Function};
use super::precise::Precise;
use super::rational::Rational;

/// The unevaluated sum of a double and of another one below half a unit in its last place.
#[derive(Clone, Copy, Debug)]
pub struct Doubled {
    high: f64,
    low: f64,
}

/// π/2 and ln 2 in three doubles.
const QUARTER_TURN: [f64; 3] = [std::f64::consts::FRAC_PI_2, 6.123_233_995_736_766e-17, -1.497_384_904_859_183_3e-33];
const LN_2: [f64; 3] = [std::f64::consts::LN_2, 2.319_046_813_846_299_6e-17, 5.707_708_438_416_212e-34];

/// Terms of a series, each smaller than the last by a factor of four at least, after which nothing is left of 106 digits.
const TERMS: u32 = 30;

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

    /// n·(a + b + c), for an integer n.
    fn multiple(n: f64, [a, b, c]: [f64; 3]) -> Self {
        Self::product(n, a) + Self::product(n, b) + Self::product(n, c)
    }

    fn times(self, factor: f64) -> Self {
        self * Self::new(factor)
    }

    /// `Σ xᵏ/k!` over k = first, first + step, …; with alternating signs where x² is given negative.
    fn series(first: Self, square: Self, from: u32, step: u32) -> Self {
        let (mut sum, mut term, mut k) = (first, first, from);
        for _ in 0..TERMS {
            for _ in 0..step {
                k += 1;
                term = term / Self::new(f64::from(k));
            }
            term = term * square;
            let next = sum + term;
            if (next.high, next.low) == (sum.high, sum.low) {
                break;
            }
            sum = next;
        }
        sum
    }

    fn exp(self) -> Self {
        if self.high.abs() > 700.0 {
            return Self::new(self.high.exp());
        }
        let halvings = (self.high / LN_2[0]).round();
        // Below ln 2/128.
        let rest = (self - Self::multiple(halvings, LN_2)).times(1.0 / 64.0);
        let small = Self::series(Self::new(1.0), rest, 0, 1);
        let power = (0..6).fold(small, |power, _| power * power);
        power.times(2.0_f64.powi(halvings as i32))
    }

    /// From the nearest double, by Newton's iteration on the exponential.
    fn ln(self) -> Self {
        let guess = Self::new(self.high.ln());
        guess + (self * (-guess).exp() - Self::new(1.0))
    }

    /// By series near zero, where the exponentials cancel.
    fn tanh(self) -> Self {
        if self.high.abs() < 0.5 {
            let square = self * self;
            return Self::series(self, square, 1, 2) / Self::series(Self::new(1.0), square, 0, 2);
        }
        if self.high.abs() > 80.0 {
            return Self::new(self.high.signum());
        }
        let (up, down) = (self.exp(), (-self).exp());
        (up - down) / (up + down)
    }

    fn sqrt(self) -> Self {
        let root = self.high.sqrt();
        if root == 0.0 || !root.is_finite() {
            return Self::new(root);
        }
        let guess = Self::new(root);
        guess + (self - Self::product(root, root)) / guess.times(2.0)
    }

    /// From the nearest double, by Newton's iteration on the tangent of what is left.
    fn atan2(self, x: Self) -> Self {
        let guess = Self::new(self.high.atan2(x.high));
        if guess.high == 0.0 {
            return guess;
        }
        let (sin, cos) = guess.sine_cosine();
        guess + (self * cos - x * sin) / (x * cos + self * sin)
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
        let turns = (self.high / QUARTER_TURN[0]).round();
        let x = self - Self::multiple(turns, QUARTER_TURN);
        let square = -(x * x);
        let (sin, cos) = (Self::series(x, square, 1, 2), Self::series(Self::new(1.0), square, 0, 2));
        match turns.rem_euclid(4.0) as u8 {
            0 => (sin, cos),
            1 => (cos, -sin),
            2 => (-sin, -cos),
            _ => (-cos, sin),
        }
    }

    fn call(self, function: Function) -> Self {
        match function {
            Function::Sin => self.sine_cosine().0,
            Function::Cos => self.sine_cosine().1,
            Function::Exp => self.exp(),
            Function::Ln => self.ln(),
            Function::Sqrt => self.sqrt(),
            Function::Abs if self.high < 0.0 => -self,
            Function::Abs => self,
            Function::Signum => Self::new(self.high.call(Function::Signum)),
            Function::Tanh => self.tanh(),
            Function::Own(_) => Self::new(f64::NAN),
        }
    }

    fn call_with(self, function: BinaryFunction, other: Self) -> Self {
        match function {
            BinaryFunction::Atan2 => self.atan2(other),
            BinaryFunction::Powf if other.high == 0.0 => Self::new(1.0),
            BinaryFunction::Powf if self.high == 0.0 => Self::new(self.high.powf(other.high)),
            BinaryFunction::Powf => (other * self.ln()).exp(),
            BinaryFunction::Min => {
                if self > other {
                    other
                } else {
                    self
                }
            }
            BinaryFunction::Max => {
                if self < other {
                    other
                } else {
                    self
                }
            }
        }
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

    fn powi(self, exponent: i32) -> Self {
        let (mut power, mut square, mut remaining) = (Self::new(1.0), self, exponent.unsigned_abs());
        while remaining > 0 {
            if remaining & 1 == 1 {
                power = power * square;
            }
            square = square * square;
            remaining >>= 1;
        }
        if exponent < 0 { Self::new(1.0) / power } else { power }
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
    use super::super::evaluate::{Number, Scalar};
    use super::super::{BinaryFunction, Function, Rational};
    use super::{Doubled, Precise};

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
