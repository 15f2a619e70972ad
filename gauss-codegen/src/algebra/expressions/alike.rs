//! Expressions that are alike: made in the same way of symbols that are said to be alike.
//!
//! Where several orders are as good, sums and products of limbs that are alike have to be written in the same one. So
//! each expression has the rank of the first that is alike to it, and orders go by ranks, then by what was made first.
//! Where no symbols are alike, a rank is the expression's own key.

use super::graph::{Expr, Graph};
use super::node::{Id, Node};
use crate::algebra::map::{Key, joined};

impl Graph {
    /// Says what a symbol is alike to, before anything is made of it.
    pub fn declare_alike(&self, symbol: Expr<'_>, class: u64) {
        self.some_are_alike.set(true);
        let rank = self.first_of(joined(1, class), symbol.id);
        self.set_rank(symbol.id, rank);
    }

    /// Whether some symbols are alike.
    pub fn has_alike(&self) -> bool {
        self.some_are_alike.get()
    }

    /// The rank of a new node; `rank` gives those of its parts.
    pub(super) fn rank_of(&self, node: &Node, id: Id, rank: impl Fn(Id) -> Id) -> Id {
        if !self.some_are_alike.get() {
            return id;
        }
        let rank = |id: Id| u64::from(rank(id));
        // The order of parts says nothing: mixed before they are added.
        let mixed = |a: u64, b: u64| joined(joined(12, a), b) ^ joined(joined(13, b), a) >> 17;
        let word = match node {
            Node::Number(_) | Node::Symbol(_) => return id,
            Node::Sum(terms) => {
                joined(4, terms.iter().fold(0, |sum: u64, &(c, id)| sum.wrapping_add(mixed(rank(id), c.word()))))
            }
            Node::Product(factors) => {
                joined(5, factors.iter().fold(0, |sum: u64, &(id, n)| sum.wrapping_add(mixed(rank(id), n as u64))))
            }
            Node::Call(function, id) => joined(joined(6, function.word()), rank(*id)),
            Node::Binary(function, a, b) => joined(joined(joined(7, *function as u64), rank(*a)), rank(*b)),
            Node::Own(function, ids) => ids.iter().fold(joined(8, function.word()), |word, id| joined(word, rank(*id))),
            Node::Group(id) => joined(9, rank(*id)),
            Node::Opaque(id) => joined(10, rank(*id)),
        };
        self.first_of(word, id)
    }

    fn first_of(&self, word: u64, id: Id) -> Id {
        *self.ranks.borrow_mut().entry(word).or_insert(id)
    }
}

impl Expr<'_> {
    /// The same of expressions that are alike.
    pub fn rank(self) -> u32 {
        self.graph.rank(self.id)
    }
}
