//! Numerical values of expressions, for checking one form of a result against another.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::graph::{BinaryFunction, Expr, Function, NodeView};
use super::map::Map;
use super::rational::Rational;

/// What expressions are evaluated in.
pub trait Number:
    Copy
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// What is left of an unknown when numbers of order one are eliminated from it, and should be zero: some thousand roundings.
    const NEGLIGIBLE: f64;

    /// As it is.
    fn from_f64(value: f64) -> Self;

    /// The nearest one.
    fn fraction(value: Rational) -> Self;

    /// The nearest one.
    fn to_f64(self) -> f64;

    /// Whether it is a number.
    fn is_finite(self) -> bool;

    /// An integer power.
    fn powi(self, exponent: i32) -> Self;

    /// Sine and cosine of an angle in radians.
    fn sine_cosine(self) -> (Self, Self);

    /// A function; not finite outside its domain.
    fn call(self, function: Function) -> Self;

    /// A function of two arguments, of which this is the first.
    fn call_with(self, function: BinaryFunction, other: Self) -> Self;
}

impl Number for f64 {
    const NEGLIGIBLE: f64 = 1e-12;

    fn from_f64(value: f64) -> Self {
        value
    }

    fn fraction(value: Rational) -> Self {
        value.to_f64()
    }

    fn to_f64(self) -> f64 {
        self
    }

    fn is_finite(self) -> bool {
        f64::is_finite(self)
    }

    fn powi(self, exponent: i32) -> Self {
        f64::powi(self, exponent)
    }

    fn sine_cosine(self) -> (Self, Self) {
        self.sin_cos()
    }

    fn call(self, function: Function) -> Self {
        function.value(self)
    }

    fn call_with(self, function: BinaryFunction, other: Self) -> Self {
        function.value(self, other)
    }
}

impl Function {
    /// Its derivative.
    fn slope<N: Number>(self, x: N) -> N {
        let one = N::from_f64(1.0);
        match self {
            Function::Sin => x.call(Function::Cos),
            Function::Cos => -x.call(Function::Sin),
            Function::Exp => x.call(Function::Exp),
            Function::Ln => one / x,
            Function::Sqrt => N::from_f64(0.5) / x.call(Function::Sqrt),
            Function::Abs => x.call(Function::Signum),
            Function::Signum => N::from_f64(0.0),
        }
    }

    /// In double precision; NaN outside the domain.
    pub fn value(self, x: f64) -> f64 {
        match self {
            Function::Sin => x.sin(),
            Function::Cos => x.cos(),
            Function::Exp => x.exp(),
            Function::Ln => x.ln(),
            Function::Sqrt => x.sqrt(),
            Function::Abs => x.abs(),
            // Unlike that of `f64`, zero at zero.
            Function::Signum if x == 0.0 => 0.0,
            Function::Signum => x.signum(),
        }
    }
}

impl BinaryFunction {
    /// In double precision.
    pub fn value(self, a: f64, b: f64) -> f64 {
        match self {
            BinaryFunction::Atan2 => a.atan2(b),
            BinaryFunction::Min => a.min(b),
            BinaryFunction::Max => a.max(b),
        }
    }
}

/// Evaluates expressions at a point, each node once.
pub struct Evaluation<'a, N = f64> {
    symbols: &'a Map<u32, N>,
    values: Map<u32, N>,
}

impl<'a, N: Number> Evaluation<'a, N> {
    /// `symbols` gives the value of every symbol, by key.
    pub fn new(symbols: &'a Map<u32, N>) -> Self {
        Self { symbols, values: Map::default() }
    }

    /// The value of an expression; NaN where a symbol has none.
    pub fn value(&mut self, e: Expr<'_>) -> N {
        if let Some(&known) = self.values.get(&e.key()) {
            return known;
        }
        let value = match e.view() {
            NodeView::Number(value) => N::fraction(value),
            NodeView::Symbol(_) => self.symbols.get(&e.key()).copied().unwrap_or(N::from_f64(f64::NAN)),
            NodeView::Sum(terms) => {
                terms.into_iter().fold(N::from_f64(0.0), |sum, (c, e)| sum + N::fraction(c) * self.value(e))
            }
            NodeView::Product(factors) => {
                factors.into_iter().fold(N::from_f64(1.0), |product, (e, n)| product * self.value(e).powi(n))
            }
            NodeView::Call(function, e) => self.value(e).call(function),
            NodeView::Binary(function, a, b) => self.value(a).call_with(function, self.value(b)),
            NodeView::Group(e) | NodeView::Opaque(e) => self.value(e),
        };
        self.values.insert(e.key(), value);
        value
    }
}

/// Directional derivatives of expressions at a point by dual numbers, each node once: differentiation that owes nothing to
/// the symbolic one.
pub struct Tangents<'a, 'b, N = f64> {
    values: &'a mut Evaluation<'b, N>,
    /// Rate of every symbol that moves.
    direction: &'a Map<u32, N>,
    known: Map<u32, N>,
}

impl<'a, 'b, N: Number> Tangents<'a, 'b, N> {
    /// `direction` gives the rates of symbols, by key; all others stand still.
    pub fn new(values: &'a mut Evaluation<'b, N>, direction: &'a Map<u32, N>) -> Self {
        Self { values, direction, known: Map::default() }
    }

    /// The derivative of an expression along the direction.
    pub fn along(&mut self, e: Expr<'_>) -> N {
        if let Some(&known) = self.known.get(&e.key()) {
            return known;
        }
        let zero = N::from_f64(0.0);
        let rate = match e.view() {
            NodeView::Number(_) => zero,
            NodeView::Symbol(_) => self.direction.get(&e.key()).copied().unwrap_or(zero),
            NodeView::Sum(terms) => terms.into_iter().fold(zero, |sum, (c, e)| sum + N::fraction(c) * self.along(e)),
            NodeView::Product(factors) => {
                // (Π fᵢ^nᵢ)˙ by the product rule on (value, rate) pairs.
                let (mut value, mut rate) = (N::from_f64(1.0), zero);
                for (e, n) in factors {
                    let (x, slope) = (self.values.value(e), self.along(e));
                    let power = x.powi(n);
                    rate = rate * power + value * N::from_f64(n.into()) * x.powi(n - 1) * slope;
                    value = value * power;
                }
                rate
            }
            NodeView::Call(function, e) => match self.along(e) {
                still if still == zero => zero,
                rate => function.slope(self.values.value(e)) * rate,
            },
            NodeView::Binary(BinaryFunction::Atan2, y, x) => {
                let (b, a) = (self.values.value(y), self.values.value(x));
                (a * self.along(y) - b * self.along(x)) / (a * a + b * b)
            }
            NodeView::Binary(function, a, b) => {
                let first = self.values.value(a).call_with(function, self.values.value(b)) == self.values.value(a);
                if first { self.along(a) } else { self.along(b) }
            }
            NodeView::Group(e) | NodeView::Opaque(e) => self.along(e),
        };
        self.known.insert(e.key(), rate);
        rate
    }
}
