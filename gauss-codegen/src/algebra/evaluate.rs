//! Numerical values of expressions, for checking one form of a result against another.

use super::graph::{BinaryFunction, Expr, Function, NodeView};
use super::map::Map;

impl Function {
    /// Its derivative, in double precision.
    fn slope(self, x: f64) -> f64 {
        match self {
            Function::Sin => x.cos(),
            Function::Cos => -x.sin(),
            Function::Exp => x.exp(),
            Function::Ln => x.recip(),
            Function::Sqrt => 0.5 / x.sqrt(),
            Function::Abs => Function::Signum.value(x),
            Function::Signum => 0.0,
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
pub struct Evaluation<'a> {
    symbols: &'a Map<u32, f64>,
    values: Map<u32, f64>,
}

impl<'a> Evaluation<'a> {
    /// `symbols` gives the value of every symbol, by key.
    pub fn new(symbols: &'a Map<u32, f64>) -> Self {
        Self { symbols, values: Map::default() }
    }

    /// The value of an expression; NaN where a symbol has none.
    pub fn value(&mut self, e: Expr<'_>) -> f64 {
        if let Some(&known) = self.values.get(&e.key()) {
            return known;
        }
        let value = match e.view() {
            NodeView::Number(value) => value.to_f64(),
            NodeView::Symbol(_) => self.symbols.get(&e.key()).copied().unwrap_or(f64::NAN),
            NodeView::Sum(terms) => terms.into_iter().map(|(c, e)| c.to_f64() * self.value(e)).sum(),
            NodeView::Product(factors) => factors.into_iter().map(|(e, n)| self.value(e).powi(n)).product(),
            NodeView::Call(function, e) => function.value(self.value(e)),
            NodeView::Binary(function, a, b) => function.value(self.value(a), self.value(b)),
            NodeView::Group(e) | NodeView::Opaque(e) => self.value(e),
        };
        self.values.insert(e.key(), value);
        value
    }
}

/// Directional derivatives of expressions at a point by dual numbers, each node once: differentiation that owes nothing to
/// the symbolic one.
pub struct Tangents<'a, 'b> {
    values: &'a mut Evaluation<'b>,
    /// Rate of every symbol that moves.
    direction: &'a Map<u32, f64>,
    known: Map<u32, f64>,
}

impl<'a, 'b> Tangents<'a, 'b> {
    /// `direction` gives the rates of symbols, by key; all others stand still.
    pub fn new(values: &'a mut Evaluation<'b>, direction: &'a Map<u32, f64>) -> Self {
        Self { values, direction, known: Map::default() }
    }

    /// The derivative of an expression along the direction.
    pub fn along(&mut self, e: Expr<'_>) -> f64 {
        if let Some(&known) = self.known.get(&e.key()) {
            return known;
        }
        let rate = match e.view() {
            NodeView::Number(_) => 0.0,
            NodeView::Symbol(_) => self.direction.get(&e.key()).copied().unwrap_or(0.0),
            NodeView::Sum(terms) => terms.into_iter().map(|(c, e)| c.to_f64() * self.along(e)).sum(),
            NodeView::Product(factors) => {
                // (Π fᵢ^nᵢ)˙ by the product rule on (value, rate) pairs.
                let (mut value, mut rate) = (1.0, 0.0);
                for (e, n) in factors {
                    let (x, slope) = (self.values.value(e), self.along(e));
                    let power = x.powi(n);
                    rate = rate * power + value * f64::from(n) * x.powi(n - 1) * slope;
                    value *= power;
                }
                rate
            }
            NodeView::Call(function, e) => match self.along(e) {
                0.0 => 0.0,
                rate => function.slope(self.values.value(e)) * rate,
            },
            NodeView::Binary(BinaryFunction::Atan2, y, x) => {
                let (b, a) = (self.values.value(y), self.values.value(x));
                (a * self.along(y) - b * self.along(x)) / (a * a + b * b)
            }
            NodeView::Binary(function, a, b) => {
                let first = function.value(self.values.value(a), self.values.value(b)) == self.values.value(a);
                if first { self.along(a) } else { self.along(b) }
            }
            NodeView::Group(e) | NodeView::Opaque(e) => self.along(e),
        };
        self.known.insert(e.key(), rate);
        rate
    }
}
