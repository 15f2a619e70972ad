//! Numerical values of expressions, for checking one form of a result against another.

use super::graph::{Expr, Function, NodeView};
use super::map::Map;

impl Function {
    /// In double precision; NaN outside the domain.
    pub fn value(self, x: f64) -> f64 {
        match self {
            Function::Sin => x.sin(),
            Function::Cos => x.cos(),
            Function::Exp => x.exp(),
            Function::Ln => x.ln(),
            Function::Sqrt => x.sqrt(),
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
            NodeView::Group(e) | NodeView::Opaque(e) => self.value(e),
        };
        self.values.insert(e.key(), value);
        value
    }
}
