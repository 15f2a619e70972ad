//! Nodes that expressions are made of, with their children by index.

use std::rc::Rc;

use crate::algebra::expressions::function::{BinaryFunction, Function, MOST_VARIABLES, OwnFunction};
use crate::algebra::map::{Key, joined};
use crate::algebra::rational::Rational;

/// Index of a node in its graph. Children always have smaller indices than their parents.
pub(in crate::algebra) type Id = u32;

#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::algebra) enum Node {
    Number(Rational),
    Symbol(u32),
    /// Σ cᵢ eᵢ, sorted by index, coefficients nonzero; a constant term is a multiple of the number one.
    Sum(Rc<[(Rational, Id)]>),
    /// Π eᵢ^nᵢ, sorted by index, exponents nonzero; no numbers and no products among the factors.
    Product(Rc<[(Id, i32)]>),
    Call(Function, Id),
    Binary(BinaryFunction, Id, Id),
    /// A function of the user's own, with arguments that are filled up with the last one.
    Own(OwnFunction, [Id; MOST_VARIABLES]),
    /// A sum that is to be computed once under a name: transparent for mathematics, a barrier for flattening.
    Group(Id),
    /// A constant that is to be computed once and never looked into again, not even by the normal form.
    Opaque(Id),
}

impl Node {
    /// Number of its parts.
    pub(super) fn edges(&self) -> usize {
        match self {
            Node::Sum(terms) => terms.len(),
            Node::Product(factors) => factors.len(),
            _ => 1,
        }
    }
}

impl Key for Node {
    fn word(&self) -> u64 {
        match self {
            Node::Number(value) => value.word(),
            Node::Symbol(symbol) => 1 << 32 | u64::from(*symbol),
            Node::Sum(terms) => {
                let mut word = 2;
                for (c, id) in terms.iter() {
                    word = joined(word, c.word() ^ (*id as u64) << 32);
                }
                word
            }
            Node::Product(factors) => {
                let mut word = 3;
                for (id, n) in factors.iter() {
                    word = joined(word, *n as u64 ^ (*id as u64) << 32);
                }
                word
            }
            Node::Call(function, id) => (4 + function.word()) << 32 | u64::from(*id),
            Node::Binary(function, a, b) => (64 + *function as u64) << 48 | u64::from(*a) << 24 ^ u64::from(*b),
            Node::Own(function, ids) => {
                ids.iter().fold(joined(130, function.word()), |word, id| joined(word, u64::from(*id)))
            }
            Node::Group(id) => 128 << 32 | u64::from(*id),
            Node::Opaque(id) => 129 << 32 | u64::from(*id),
        }
    }
}

impl Node {
    /// Nodes that it is made of.
    pub(in crate::algebra) fn children(&self) -> Vec<Id> {
        match self {
            Node::Number(_) | Node::Symbol(_) => Vec::new(),
            Node::Sum(terms) => terms.iter().map(|&(_, id)| id).collect(),
            Node::Product(factors) => factors.iter().map(|&(id, _)| id).collect(),
            Node::Call(_, id) | Node::Group(id) | Node::Opaque(id) => vec![*id],
            Node::Binary(_, a, b) => vec![*a, *b],
            Node::Own(function, ids) => function.of(ids).to_vec(),
        }
    }
}
