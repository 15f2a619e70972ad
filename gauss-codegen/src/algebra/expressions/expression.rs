//! Properties of an expression, and expressions made from it.

use crate::algebra::expressions::function::{BinaryFunction, Function};
use crate::algebra::expressions::graph::{Expr, Graph, NodeView, ZERO};
use crate::algebra::expressions::node::{Id, Node};
use crate::algebra::rational::Rational;

impl<'g> Expr<'g> {
    pub fn graph(self) -> &'g Graph {
        self.graph
    }

    /// The index of the node: a name for maps, smaller for what was built earlier.
    pub fn key(self) -> u32 {
        self.id
    }

    pub fn view(self) -> NodeView<'g> {
        let at = |id| self.graph.expr(id);
        match self.graph.node(self.id) {
            Node::Number(value) => NodeView::Number(value),
            Node::Symbol(symbol) => NodeView::Symbol(symbol),
            Node::Sum(terms) => NodeView::Sum(terms.iter().map(|&(c, id)| (c, at(id))).collect()),
            Node::Product(factors) => NodeView::Product(factors.iter().map(|&(id, n)| (at(id), n)).collect()),
            Node::Call(function, id) => NodeView::Call(function, at(id)),
            Node::Binary(function, a, b) => NodeView::Binary(function, at(a), at(b)),
            Node::Own(function, ids) => NodeView::Own(function, function.of(&ids).iter().copied().map(at).collect()),
            Node::Group(id) => NodeView::Group(at(id)),
            Node::Opaque(id) => NodeView::Opaque(at(id)),
        }
    }

    pub fn as_number(self) -> Option<Rational> {
        match self.graph.node(self.id) {
            Node::Number(value) => Some(value),
            _ => None,
        }
    }

    pub fn is_zero(self) -> bool {
        self.id == ZERO
    }

    pub fn powi(self, exponent: i32) -> Self {
        self.graph.product(Rational::one(), [(self, exponent)])
    }

    pub fn recip(self) -> Self {
        self.powi(-1)
    }

    pub fn scale(self, factor: Rational) -> Self {
        if self.id == ZERO || factor.is_one() {
            return self;
        }
        let mut terms = Vec::new();
        self.graph.push_term(&mut terms, factor, self.id);
        self.graph.collected_sum(terms)
    }

    /// self + factor · other.
    pub(super) fn plus_multiple(self, factor: Rational, other: Self) -> Self {
        if other.id == ZERO {
            return self;
        }
        if self.id == ZERO {
            return other.scale(factor);
        }
        let mut terms = Vec::with_capacity(4);
        self.graph.push_term(&mut terms, Rational::one(), self.id);
        self.graph.push_term(&mut terms, factor, other.id);
        self.graph.collected_sum(terms)
    }

    pub fn half(self) -> Self {
        self.scale(Rational::new(1, 2))
    }

    pub fn sin(self) -> Self {
        self.graph.call(Function::Sin, self)
    }

    pub fn cos(self) -> Self {
        self.graph.call(Function::Cos, self)
    }

    pub fn exp(self) -> Self {
        self.graph.call(Function::Exp, self)
    }

    pub fn ln(self) -> Self {
        self.graph.call(Function::Ln, self)
    }

    pub fn sqrt(self) -> Self {
        self.graph.call(Function::Sqrt, self)
    }

    pub fn abs(self) -> Self {
        self.graph.call(Function::Abs, self)
    }

    /// √((1 − x)(1 + x)): the other leg of a right triangle with the hypotenuse 1; no digits cancel where the triangle
    /// is thin.
    pub fn leg(self) -> Self {
        let one = self.graph.one();
        ((one - self).group() * (one + self).group()).sqrt()
    }

    pub fn binary(self, function: BinaryFunction, other: Self) -> Self {
        self.graph.intern(Node::Binary(function, self.id, other.id))
    }

    /// The same value as a quantity of its own: sums around it do not take it apart, so it is computed once. Factors
    /// that all its terms share are pulled out first, which lets a mass cancel later.
    pub fn group(self) -> Self {
        let Node::Sum(terms) = self.graph.node(self.id) else { return self };
        if terms.len() < 2 {
            return self;
        }
        let common = self.graph.common_factors(&terms);
        let content = self.graph.shared_content(&terms);
        if common.is_empty() && content.is_one() {
            return self.graph.intern(Node::Group(self.id));
        }
        let common: Vec<_> = common.into_iter().map(|(id, n)| (self.graph.expr(id), n)).collect();
        let divisor = self.graph.product(content, common.iter().copied());
        let inverse = divisor.recip();
        let primitive = self.graph.sum(terms.iter().map(|&(c, id)| (c, self.graph.expr(id) * inverse)));
        divisor * self.graph.intern(Node::Group(primitive.id))
    }

    /// The same value as a group, whatever it is; for passes that rebuild expressions.
    pub fn group_as_is(self) -> Self {
        match self.graph.node(self.id) {
            Node::Sum(terms) if terms.len() > 1 => self.graph.intern(Node::Group(self.id)),
            _ => self,
        }
    }

    /// True when it is its own normal form for a reason that can be seen: a sum of products of symbols.
    pub fn is_normal(self) -> bool {
        let leaf = |id: Id| matches!(self.graph.node(id), Node::Symbol(_) | Node::Opaque(_));
        let monomial = |id: Id| match self.graph.node(id) {
            Node::Product(factors) => factors.iter().all(|&(f, _)| leaf(f)),
            Node::Number(_) => true,
            _ => leaf(id),
        };
        match self.graph.node(self.id) {
            Node::Sum(terms) => terms.iter().all(|&(_, id)| monomial(id)),
            _ => monomial(self.id),
        }
    }

    /// The largest power, of either sign, among the factors of a product.
    pub fn largest_exponent(self) -> u32 {
        match self.graph.node(self.split_coefficient().1.id) {
            Node::Product(factors) => factors.iter().map(|(_, n)| n.unsigned_abs()).max().unwrap_or(0),
            _ => 1,
        }
    }

    /// A number times something without one: `6·a·b` is 6 and `a·b`.
    pub fn split_coefficient(self) -> (Rational, Self) {
        match self.graph.node(self.id) {
            Node::Number(value) => (value, self.graph.one()),
            Node::Sum(terms) if terms.len() == 1 => (terms[0].0, self.graph.expr(terms[0].1)),
            _ => (Rational::one(), self),
        }
    }

    /// The same constant as a quantity of its own that even the normal form does not look into.
    pub fn opaque(self) -> Self {
        match self.graph.node(self.id) {
            Node::Number(_) | Node::Symbol(_) | Node::Opaque(_) => self,
            _ => self.graph.intern(Node::Opaque(self.id)),
        }
    }

    /// True of symbols and numbers.
    pub fn is_leaf(self) -> bool {
        self.graph.is_leaf(self.id)
    }

    /// True when every symbol in it is constant.
    pub fn is_constant(self) -> bool {
        self.graph.is_constant(self.id)
    }
}
