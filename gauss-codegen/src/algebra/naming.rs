//! Expressions for readers: parts under the names that their author gave them, quarter turns, and how long it all is.

use crate::algebra::expressions::function::Function;
use crate::algebra::expressions::graph::{Expr, Graph};
use crate::algebra::expressions::node::{Id, Node};
use crate::algebra::expressions::substitute::Substitution;
use crate::algebra::map::Map;
use crate::algebra::parts::leaves_of;
use crate::algebra::rational::Rational;

impl Graph {
    /// Results of some work, as far as the graph had them before; it has nothing more afterwards.
    pub fn existing<'g>(&'g self, work: impl FnOnce() -> Vec<Expr<'g>>) -> Vec<Option<Expr<'g>>> {
        let before = self.nodes().len() as Id;
        let ids: Vec<Id> = self.aside(|| work().into_iter().map(|e| e.id).collect());
        ids.into_iter().map(|id| (id < before).then(|| self.expr(id))).collect()
    }
}

impl<'g> Expr<'g> {
    /// The expression with symbols in the places of parts, each wherever it is a term, a factor or an argument as it
    /// was written, or a multiple of that.
    pub fn with_named(self, named: &[(Self, Self)]) -> Self {
        let graph = self.graph;
        let mut by_part: Map<Id, Self> = Map::default();
        for &(part, name) in named {
            let id = graph.ungrouped(part.id);
            if part.is_leaf() {
                continue;
            }
            by_part.or_insert_with(id, || name);
            // As a factor a sum is without what its coefficients have in common.
            if let Node::Sum(terms) = graph.node(id) {
                let scale = graph.content(&terms).recip();
                let primitive = graph.sum(terms.iter().map(|&(c, id)| (scale * c, graph.expr(id))));
                by_part.or_insert_with(primitive.id, || name.scale(scale));
            }
        }
        Substitution::of_parts(by_part).of(self)
    }

    /// The expression with symbols read as so many quarters of a turn, wherever they are within a sine or a cosine.
    pub fn with_quarter_turns(self, quarters: &[(Self, i64)]) -> Self {
        let graph = self.graph;
        let parts = |graph: &Graph, id: Id| graph.node(id).children();
        let mut turned: Map<Id, Self> = Map::default();
        for id in graph.reached(&[self.id], parts) {
            if let Node::Call(function @ (Function::Sin | Function::Cos), argument) = graph.node(id)
                && let Some(value) = graph.expr(argument).turned(function, quarters)
            {
                turned.insert(id, value);
            }
        }
        if turned.iter().next().is_none() { self } else { Substitution::of_parts(turned).of(self) }
    }

    /// Sine or cosine of it, if it has such symbols.
    fn turned(self, function: Function, quarters: &[(Self, i64)]) -> Option<Self> {
        let graph = self.graph;
        let argument = graph.expr(graph.ungrouped(self.id));
        let terms = match graph.node(argument.id) {
            Node::Sum(terms) => terms.to_vec(),
            _ => vec![(Rational::one(), argument.id)],
        };
        let (mut turns, mut rest, mut found) = (0, Vec::new(), false);
        for (c, id) in terms {
            let known = quarters.iter().find(|(symbol, _)| symbol.id == id);
            match (known, c.parts()) {
                (Some((_, quarters)), Some((times, 1))) => {
                    turns += times * quarters;
                    found = true;
                }
                _ => rest.push((c, graph.expr(id))),
            }
        }
        let rest = graph.sum(rest);
        let [sin, cos] = [rest.sin(), rest.cos()];
        let turns = if function == Function::Cos { turns + 1 } else { turns };
        found.then(|| match turns.rem_euclid(4) {
            0 => sin,
            1 => cos,
            2 => -sin,
            _ => -cos,
        })
    }

    /// Whether a symbol is in it.
    pub fn contains(self, symbol: Self) -> bool {
        let parts = |graph: &Graph, id: Id| graph.node(id).children();
        self.graph.reached(&[self.id], parts).contains(&symbol.id)
    }

    /// Symbols, numbers and functions that it has when it is written out.
    pub fn leaves(self) -> u64 {
        leaves_of(self)
    }

    /// Terms that it has when it is multiplied out, before any cancel; arguments of functions are not.
    pub fn terms_multiplied_out(self) -> f64 {
        let graph = self.graph;
        let parts = |graph: &Graph, id: Id| graph.node(id).children();
        let mut terms: Map<Id, f64> = Map::default();
        for id in graph.reached(&[self.id], parts) {
            let count = match graph.node(id) {
                Node::Number(_) | Node::Symbol(_) | Node::Call(..) | Node::Binary(..) | Node::Own(..) => 1.0,
                Node::Sum(of) => of.iter().map(|(_, id)| terms[id]).sum(),
                Node::Product(of) => of.iter().map(|(id, n)| if *n > 0 { terms[id].powi(*n) } else { 1.0 }).product(),
                Node::Group(inner) | Node::Opaque(inner) => terms[&inner],
            };
            terms.insert(id, count);
        }
        terms[&self.id]
    }
}
