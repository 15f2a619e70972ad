//! Numbers that functions are evaluated with: expressions of the derive on one side, jets of double precision on the
//! other; and the random smooth functions that both evaluate.

use std::ops::{Add, Mul, Sub};

use crate::algebra::{Expr, Rational};
use crate::mechanics::tests::Random;

/// Numbers that a smooth function can be evaluated with.
pub trait SmoothNumber: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {
    /// A constant, of the same kind as `self`.
    fn fraction(self, numerator: i64, denominator: i64) -> Self;
    fn sine(self) -> Self;
    fn cosine(self) -> Self;
    fn root(self) -> Self;
    fn reciprocal(self) -> Self;
}

impl SmoothNumber for Expr<'_> {
    fn fraction(self, numerator: i64, denominator: i64) -> Self {
        self.graph().number(Rational::new(numerator, denominator))
    }

    fn sine(self) -> Self {
        self.sin()
    }

    fn cosine(self) -> Self {
        self.cos()
    }

    fn root(self) -> Self {
        self.sqrt()
    }

    fn reciprocal(self) -> Self {
        self.recip()
    }
}

/// A function of two variables τ and σ up to the terms 1, τ, τ², σ, τσ, by its derivatives. Along a motion τ is time; σ
/// moves the configuration, or the speeds, along one partial velocity.
#[derive(Clone, Copy, Debug, Default)]
pub struct Jet {
    pub value: f64,
    pub rate: f64,
    pub second: f64,
    pub side: f64,
    pub side_rate: f64,
}

impl Jet {
    pub fn constant(value: f64) -> Self {
        Self { value, ..Self::default() }
    }

    /// A jet that starts at a value and goes on, and aside, at a rate.
    pub fn integral(value: f64, rate: Self) -> Self {
        Self { value, rate: rate.value, second: rate.rate, side: rate.side, side_rate: rate.side_rate }
    }

    /// A jet that goes on at the rate of `self`, and aside as that does: ∂v/∂z is ∂x/∂q·∂ψ/∂z.
    pub fn velocity(self) -> Self {
        Self { value: self.rate, rate: self.second, second: f64::NAN, side: self.side, side_rate: self.side_rate }
    }

    /// The same, standing still in σ.
    pub fn along(self) -> Self {
        Self { side: 0.0, side_rate: 0.0, ..self }
    }

    /// f(self), by f and its first two derivatives.
    fn chain(self, f: f64, slope: f64, curvature: f64) -> Self {
        Self {
            value: f,
            rate: slope * self.rate,
            second: slope * self.second + curvature * self.rate * self.rate,
            side: slope * self.side,
            side_rate: slope * self.side_rate + curvature * self.rate * self.side,
        }
    }

    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self {
            value: f(self.value, other.value),
            rate: f(self.rate, other.rate),
            second: f(self.second, other.second),
            side: f(self.side, other.side),
            side_rate: f(self.side_rate, other.side_rate),
        }
    }
}

impl Add for Jet {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        self.zip(other, |a, b| a + b)
    }
}

impl Sub for Jet {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self.zip(other, |a, b| a - b)
    }
}

impl Mul for Jet {
    type Output = Self;

    fn mul(self, b: Self) -> Self {
        let a = self;
        Self {
            value: a.value * b.value,
            rate: a.rate * b.value + a.value * b.rate,
            second: a.second * b.value + 2.0 * a.rate * b.rate + a.value * b.second,
            side: a.side * b.value + a.value * b.side,
            side_rate: a.side_rate * b.value + a.side * b.rate + a.rate * b.side + a.value * b.side_rate,
        }
    }
}

impl SmoothNumber for Jet {
    fn fraction(self, numerator: i64, denominator: i64) -> Self {
        Self::constant(numerator as f64 / denominator as f64)
    }

    fn sine(self) -> Self {
        let (sin, cos) = self.value.sin_cos();
        self.chain(sin, cos, -sin)
    }

    fn cosine(self) -> Self {
        let (sin, cos) = self.value.sin_cos();
        self.chain(cos, -sin, -cos)
    }

    fn root(self) -> Self {
        let root = self.value.sqrt();
        self.chain(root, 0.5 / root, -0.25 / (root * self.value))
    }

    fn reciprocal(self) -> Self {
        let inverse = self.value.recip();
        self.chain(inverse, -inverse * inverse, 2.0 * inverse.powi(3))
    }
}

/// A smooth function of one variable.
#[derive(Clone, Copy, Debug)]
enum SmoothShape {
    Itself,
    Square,
    Sine,
    Cosine,
    /// √(1 + x²).
    Root,
    /// 1 / (2 + cos x).
    Quotient,
}

/// A constant and a sum of products of functions of single variables; coefficients are eighths.
#[derive(Clone, Debug)]
pub struct Smooth {
    constant: i64,
    terms: Vec<(i64, Vec<(usize, SmoothShape)>)>,
}

const DENOMINATOR: i64 = 8;

/// A whole number below the limit.
pub fn below(random: &mut Random, limit: usize) -> usize {
    ((0.5 + 0.5 * random.next()) * limit as f64) as usize
}

impl Smooth {
    pub fn constant(eighths: i64) -> Self {
        Self { constant: eighths, terms: Vec::new() }
    }

    pub fn one() -> Self {
        Self::constant(DENOMINATOR)
    }

    pub fn variable(index: usize) -> Self {
        Self::constant(0).plus_multiple(DENOMINATOR, index)
    }

    /// A random constant, of order one.
    pub fn random_constant(random: &mut Random) -> Self {
        Self::constant(below(random, 17) as i64 - 8)
    }

    /// A function with so many terms in the given variables, of order ½ each.
    pub fn random(random: &mut Random, terms: usize, variables: &[usize]) -> Self {
        const SHAPES: [SmoothShape; 6] = [
            SmoothShape::Itself,
            SmoothShape::Square,
            SmoothShape::Sine,
            SmoothShape::Cosine,
            SmoothShape::Root,
            SmoothShape::Quotient,
        ];
        let mut function = Self::random_constant(random);
        for _ in 0..terms {
            let coefficient = [-4, -3, -2, 2, 3, 4][below(random, 6)];
            let factor = |random: &mut Random| (variables[below(random, variables.len())], SHAPES[below(random, 6)]);
            let factors = (0..1 + below(random, 2)).map(|_| factor(random)).collect();
            function.terms.push((coefficient, factors));
        }
        function
    }

    pub fn plus_multiple(mut self, eighths: i64, variable: usize) -> Self {
        self.terms.push((eighths, vec![(variable, SmoothShape::Itself)]));
        self
    }

    pub fn plus_square(mut self, eighths: i64, variable: usize) -> Self {
        self.terms.push((eighths, vec![(variable, SmoothShape::Square)]));
        self
    }

    /// A product of the variable and a function of others.
    pub fn plus_product(mut self, random: &mut Random, variable: usize, others: &[usize]) -> Self {
        const SHAPES: [SmoothShape; 3] = [SmoothShape::Itself, SmoothShape::Sine, SmoothShape::Root];
        let other = (others[below(random, others.len())], SHAPES[below(random, 3)]);
        let factors = if below(random, 3) == 0 { Vec::new() } else { vec![other] };
        self.terms.push((6, [vec![(variable, SmoothShape::Itself)], factors].concat()));
        self
    }

    pub fn is_constant(&self) -> bool {
        self.terms.is_empty()
    }

    pub fn at<N: SmoothNumber>(&self, variables: &[N]) -> N {
        let unit = variables[0];
        let function = |&(index, shape): &(usize, SmoothShape)| {
            let x = variables[index];
            match shape {
                SmoothShape::Itself => x,
                SmoothShape::Square => x * x,
                SmoothShape::Sine => x.sine(),
                SmoothShape::Cosine => x.cosine(),
                SmoothShape::Root => (unit.fraction(1, 1) + x * x).root(),
                SmoothShape::Quotient => (unit.fraction(2, 1) + x.cosine()).reciprocal(),
            }
        };
        let constant = unit.fraction(self.constant, DENOMINATOR);
        self.terms.iter().fold(constant, |sum, (coefficient, factors)| {
            let start = unit.fraction(*coefficient, DENOMINATOR);
            sum + factors.iter().map(function).fold(start, |product, x| product * x)
        })
    }
}
