//! Normal forms with squares of cosines in the place of `1 − sin²`, whose digits cancel near quarter turns.

use crate::algebra::expressions::function::Function;
use crate::algebra::expressions::graph::{Expr, Graph, NodeView};
use crate::algebra::expressions::node::{Id, Node};
use crate::algebra::map::Map;
use crate::algebra::normal_form::polynomial::{Monomial, Polynomial};
use crate::algebra::rational::Rational;

impl<'g> Polynomial<'g> {
    /// Back to an expression as [`collect`](Self::collect), with `cos²` for `1 − sin²` in sums and in denominators.
    pub fn collect_with_cosines(&self) -> Expr<'g> {
        let mut terms = self.clone();
        terms.restore_cosines();
        let mut denominators = Map::default();
        for monomial in terms.terms.keys() {
            for &(atom, _) in monomial.factors.iter().filter(|&&(_, exponent)| exponent < 0) {
                denominators.or_insert_with(atom, || restored(self.graph, atom));
            }
        }
        let one = Rational::one();
        let factor = |(e, n): (Expr<'g>, i32)| (denominators.get(&e.id).copied().flatten().unwrap_or(e), n);
        let variable = |e: Expr<'g>| match e.view() {
            NodeView::Product(factors) => self.graph.product(one, factors.into_iter().map(factor)),
            _ => e,
        };
        let groups = terms.by_variable_monomials().into_iter();
        self.graph.sum(groups.map(|(constant, e)| (one, constant.to_expr().group() * variable(e))))
    }

    /// `m − m sin²` becomes `m cos²`, again and again.
    fn restore_cosines(&mut self) {
        while let Some((with_square, without, sine)) = self.pair() {
            let coefficient = self.terms[&without];
            self.terms.remove(&with_square);
            self.terms.remove(&without);
            let NodeView::Call(_, argument) = self.graph.expr(sine).view() else { return };
            let cosine = self.graph.call(Function::Cos, argument);
            self.add_term(without.times(&Monomial::new(vec![(cosine.id, 2)])), coefficient);
        }
    }

    /// Two monomials that differ by the square of a sine, with opposite coefficients.
    fn pair(&self) -> Option<(Monomial, Monomial, Id)> {
        let is_sine = |id: Id| matches!(self.graph.node(id), Node::Call(Function::Sin, _));
        self.terms.iter().rev().find_map(|(monomial, coefficient)| {
            monomial.factors.iter().filter(|&&(atom, n)| n >= 2 && is_sine(atom)).find_map(|&(sine, _)| {
                let without = monomial.over(&Monomial::new(vec![(sine, 2)]))?;
                let other = self.terms.get(&without)?;
                (*other == -*coefficient).then(|| (monomial.clone(), without, sine))
            })
        })
    }
}

/// A sum that is divided by.
fn restored(graph: &Graph, atom: Id) -> Option<Expr<'_>> {
    /// Terms of a denominator that is looked at.
    const LIMIT: usize = 64;
    let sum = graph.expr(atom);
    let NodeView::Sum(_) = sum.view() else { return None };
    let mut terms = sum.expand_around_sums(LIMIT)?;
    terms.restore_cosines();
    Some(terms.collect())
}
