//! Expressions with symbols replaced.

use std::cell::RefCell;

use crate::algebra::expressions::graph::Expr;
use crate::algebra::expressions::node::{Id, Node};
use crate::algebra::map::Map;
use crate::algebra::rational::Rational;

impl<'g> Expr<'g> {
    /// Rebuilds the expression with some symbols replaced. Groups stay groups.
    pub fn substitute(self, replacement: &Map<u32, Expr<'g>>) -> Self {
        let mut memo = Map::default();
        let leaf = |symbol: Self| replacement.get(&symbol.id).copied();
        for part in self.stages(|_| false) {
            part.rebuild(&mut memo, &leaf);
        }
        self.rebuild(&mut memo, &leaf)
    }

    fn rebuild(self, memo: &mut Map<Id, Expr<'g>>, leaf: &impl Fn(Expr<'g>) -> Option<Expr<'g>>) -> Self {
        if let Some(&done) = memo.get(&self.id) {
            return done;
        }
        let graph = self.graph;
        let at = |id: Id| graph.expr(id);
        // What holds nothing that is replaced stays as it is.
        let result = match graph.node(self.id) {
            Node::Number(_) => self,
            Node::Symbol(_) => leaf(self).unwrap_or(self),
            Node::Sum(terms) => {
                let mut flat = Vec::with_capacity(terms.len());
                let mut changed = false;
                for &(c, id) in terms.iter() {
                    let term = at(id).rebuild(memo, leaf).id;
                    changed |= term != id;
                    graph.push_term(&mut flat, c, term);
                }
                if changed { graph.collected_sum(flat) } else { self }
            }
            Node::Product(factors) => {
                let (mut coefficient, mut flat) = (Rational::one(), Vec::with_capacity(factors.len()));
                let mut changed = false;
                for &(id, n) in factors.iter() {
                    let factor = at(id).rebuild(memo, leaf).id;
                    changed |= factor != id;
                    graph.push_factor(&mut coefficient, &mut flat, factor, n);
                }
                if changed { graph.collected_product(coefficient, flat) } else { self }
            }
            Node::Call(function, argument) => graph.call(function, at(argument).rebuild(memo, leaf)),
            Node::Binary(function, a, b) => at(a).rebuild(memo, leaf).binary(function, at(b).rebuild(memo, leaf)),
            Node::Own(function, ids) => {
                let arguments: Vec<_> = function.of(&ids).iter().map(|&id| at(id).rebuild(memo, leaf)).collect();
                graph.own(function, &arguments)
            }
            Node::Group(inner) => at(inner).rebuild(memo, leaf).group(),
            Node::Opaque(inner) => at(inner).rebuild(memo, leaf).opaque(),
        };
        memo.insert(self.id, result);
        result
    }
}

/// Symbols to be replaced in many expressions, with what has been rebuilt so far.
pub struct Substitution<'g> {
    replacement: Map<u32, Expr<'g>>,
    rebuilt: RefCell<Map<Id, Expr<'g>>>,
}

impl<'g> Substitution<'g> {
    /// Substitutes symbols, by their keys.
    pub fn new(replacement: Map<u32, Expr<'g>>) -> Self {
        Self { replacement, rebuilt: RefCell::default() }
    }

    /// Substitutes parts that are no symbols, by their keys.
    pub(in crate::algebra) fn of_parts(parts: Map<Id, Expr<'g>>) -> Self {
        Self { replacement: Map::default(), rebuilt: RefCell::new(parts) }
    }

    /// The expression with the symbols replaced. Groups stay groups.
    pub fn of(&self, e: Expr<'g>) -> Expr<'g> {
        let mut rebuilt = self.rebuilt.borrow_mut();
        let leaf = |symbol: Expr<'g>| self.replacement.get(&symbol.id).copied();
        for part in e.stages(|key| rebuilt.contains_key(&key)) {
            part.rebuild(&mut rebuilt, &leaf);
        }
        e.rebuild(&mut rebuilt, &leaf)
    }
}
