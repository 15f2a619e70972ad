//! Derivatives: one recursion serves partial derivatives and derivatives along a flow alike.

use crate::algebra::expressions::function::{BinaryFunction, Function};
use crate::algebra::expressions::graph::{Expr, NodeView};
use crate::algebra::map::Map;

use crate::algebra::rational::Rational;

/// Derivatives of many expressions along one flow, with what has been differentiated so far.
pub struct FlowDerivative<'a, 'g> {
    rates: &'a Map<u32, Expr<'g>>,
    done: Map<u32, Expr<'g>>,
}

impl<'a, 'g> FlowDerivative<'a, 'g> {
    /// `rates` maps each moving symbol (by key) to its rate; all others stand still.
    pub fn new(rates: &'a Map<u32, Expr<'g>>) -> Self {
        Self { rates, done: Map::default() }
    }

    pub fn derivative(&mut self, e: Expr<'g>) -> Expr<'g> {
        let Self { rates, done } = self;
        for part in e.stages(|key| done.contains_key(&key)) {
            part.differentiate(rates, done);
        }
        e.differentiate(rates, done)
    }
}

impl<'g> Expr<'g> {
    /// ∂self/∂symbol.
    pub fn partial(self, symbol: Expr<'g>) -> Self {
        let (zero, one) = (self.graph.zero(), self.graph.one());
        if self.is_leaf() {
            return if self == symbol { one } else { zero };
        }
        self.derivative(&Map::from_iter([(symbol.id, one)]))
    }

    /// Derivative along a flow: `rates` maps each moving symbol (by key) to its rate; all others stand still.
    pub fn derivative(self, rates: &Map<u32, Expr<'g>>) -> Self {
        FlowDerivative::new(rates).derivative(self)
    }

    fn differentiate(self, rates: &Map<u32, Expr<'g>>, memo: &mut Map<u32, Expr<'g>>) -> Self {
        if let Some(&done) = memo.get(&self.id) {
            return done;
        }
        let graph = self.graph;
        let result = match self.view() {
            NodeView::Number(_) | NodeView::Opaque(_) => graph.zero(),
            NodeView::Symbol(_) => rates.get(&self.id).copied().unwrap_or_else(|| graph.zero()),
            NodeView::Sum(terms) => {
                let terms: Vec<_> = terms.into_iter().map(|(c, e)| (c, e.differentiate(rates, memo))).collect();
                graph.sum(terms)
            }
            NodeView::Product(factors) => {
                let mut terms = Vec::new();
                for (k, &(factor, exponent)) in factors.iter().enumerate() {
                    let rate = factor.differentiate(rates, memo);
                    if rate.is_zero() {
                        continue;
                    }
                    let rest = factors.iter().enumerate().map(|(j, &(f, n))| (f, if j == k { n - 1 } else { n }));
                    let rest = rest.chain(std::iter::once((rate, 1)));
                    terms.push((Rational::from_integer(i64::from(exponent)), graph.product(Rational::one(), rest)));
                }
                graph.sum(terms)
            }
            NodeView::Call(function, argument) => {
                let rate = argument.differentiate(rates, memo);
                if rate.is_zero() { rate } else { rate * self.slope(function, argument) }
            }
            NodeView::Binary(BinaryFunction::Atan2, y, x) => {
                let turned = x * y.differentiate(rates, memo) - y * x.differentiate(rates, memo);
                if turned.is_zero() { turned } else { turned * (x * x + y * y).group().recip() }
            }
            NodeView::Binary(BinaryFunction::Powf, base, exponent) => {
                let (rate, of_exponent) = (base.differentiate(rates, memo), exponent.differentiate(rates, memo));
                let slope = || exponent * base.binary(BinaryFunction::Powf, exponent - graph.one());
                let by_base = if rate.is_zero() { rate } else { rate * slope() };
                // Of 0 the power is 0, which the logarithm must not spoil.
                let least = graph.number(Rational::new(1, 1 << 62)).powi(2);
                let logarithm = || graph.call(Function::Ln, base.binary(BinaryFunction::Max, least));
                if of_exponent.is_zero() { by_base } else { by_base + of_exponent * self * logarithm() }
            }
            // Of the smaller or the larger: half the sum, and half the difference by which of them it is.
            NodeView::Binary(function, a, b) => {
                let (x, y) = (a.differentiate(rates, memo), b.differentiate(rates, memo));
                let side = graph.call(Function::Signum, if function == BinaryFunction::Max { a - b } else { b - a });
                ((x + y) + side * (x - y)).half()
            }
            NodeView::Own(function, arguments) => {
                let rates: Vec<_> = arguments.iter().map(|argument| argument.differentiate(rates, memo)).collect();
                let moving = rates.into_iter().enumerate().filter(|(_, rate)| !rate.is_zero());
                let terms = moving.map(|(k, rate)| rate * graph.own(function.derivative(k), &arguments));
                terms.reduce(|sum, term| sum + term).unwrap_or_else(|| graph.zero())
            }
            NodeView::Group(inner) => inner.differentiate(rates, memo),
        };
        memo.insert(self.id, result);
        result
    }

    /// The derivative of a function, which this is, by its argument.
    fn slope(self, function: Function, argument: Self) -> Self {
        let graph = self.graph;
        match function {
            Function::Sin => argument.cos(),
            Function::Cos => -argument.sin(),
            Function::Exp => self,
            Function::Ln => argument.recip(),
            Function::Sqrt => self.recip().half(),
            Function::Abs => graph.call(Function::Signum, argument),
            Function::Signum => graph.zero(),
            Function::Tanh => (graph.one() - self * self).group(),
        }
    }
}
