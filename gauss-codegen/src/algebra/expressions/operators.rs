//! Sums and products of expressions as operators.

use std::iter::Sum;
use std::ops::{Add, Mul, Neg, Sub};

use crate::algebra::expressions::graph::{Expr, ONE, ZERO};
use crate::algebra::rational::Rational;

impl<'g> Add for Expr<'g> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.plus_multiple(Rational::one(), other)
    }
}

impl<'g> Sub for Expr<'g> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.plus_multiple(Rational::from_integer(-1), other)
    }
}

impl<'g> Mul for Expr<'g> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        // Most products of mechanics are with zeros and ones of rotations and unit vectors.
        match (self.id, other.id) {
            (ZERO, _) | (_, ONE) => return self,
            (_, ZERO) | (ONE, _) => return other,
            _ => {}
        }
        let (mut coefficient, mut factors) = (Rational::one(), Vec::with_capacity(4));
        self.graph.push_factor(&mut coefficient, &mut factors, self.id, 1);
        self.graph.push_factor(&mut coefficient, &mut factors, other.id, 1);
        self.graph.collected_product(coefficient, factors)
    }
}

impl Neg for Expr<'_> {
    type Output = Self;
    fn neg(self) -> Self {
        self.scale(Rational::from_integer(-1))
    }
}

/// Sum of a non-empty sequence; an empty one has no graph to live in.
impl<'g> Sum for Expr<'g> {
    fn sum<I: Iterator<Item = Self>>(mut terms: I) -> Self {
        let first = terms.next().expect("a sum of expressions has at least one term");
        let mut flat = Vec::new();
        first.graph.push_term(&mut flat, Rational::one(), first.id);
        for term in terms {
            first.graph.push_term(&mut flat, Rational::one(), term.id);
        }
        first.graph.collected_sum(flat)
    }
}
