//! Long sums and products: `a + b + c + …` as a tree whose depth is the logarithm of its length.

use proc_macro2::Span;

use crate::model::scene::expression::{BinaryOperator, Expression, ExpressionKind};

/// Operators of a chain that are read from left to right, one within the other.
const SHORT: usize = 16;

/// An operator, where it stands, and what comes after it.
pub type Link = (BinaryOperator, Span, Expression);

/// The value of a chain of operators: factors before terms, as they bind.
pub fn joined(first: Expression, links: Vec<Link>) -> Expression {
    if links.len() <= SHORT {
        return links.into_iter().fold(first, binary);
    }
    let is_sum = |(operator, ..): &Link| matches!(operator, BinaryOperator::Add | BinaryOperator::Subtract);
    let (terms, factors): (Vec<Link>, Vec<Link>) = links.into_iter().partition(is_sum);
    sum(product(first, factors), terms)
}

fn binary(left: Expression, (operator, span, right): Link) -> Expression {
    Expression { kind: ExpressionKind::Binary(operator, Box::new(left), Box::new(right)), span }
}

fn sum(first: Expression, mut terms: Vec<Link>) -> Expression {
    if terms.len() <= SHORT {
        return terms.into_iter().fold(first, binary);
    }
    let mut later = terms.split_off(terms.len() / 2);
    let (operator, span, head) = later.remove(0);
    // What is subtracted changes the signs within.
    if operator == BinaryOperator::Subtract {
        for (operator, ..) in &mut later {
            *operator = match operator {
                BinaryOperator::Add => BinaryOperator::Subtract,
                _ => BinaryOperator::Add,
            };
        }
    }
    binary(sum(first, terms), (operator, span, sum(head, later)))
}

/// Numerators over denominators.
fn product(first: Expression, factors: Vec<Link>) -> Expression {
    if factors.len() <= SHORT {
        return factors.into_iter().fold(first, binary);
    }
    let (mut below, above): (Vec<Link>, Vec<Link>) =
        factors.into_iter().partition(|(operator, ..)| *operator == BinaryOperator::Divide);
    let above = multiplied(first, above);
    if below.is_empty() {
        return above;
    }
    let (operator, span, head) = below.remove(0);
    below.iter_mut().for_each(|(operator, ..)| *operator = BinaryOperator::Multiply);
    binary(above, (operator, span, multiplied(head, below)))
}

fn multiplied(first: Expression, mut factors: Vec<Link>) -> Expression {
    if factors.len() <= SHORT {
        return factors.into_iter().fold(first, binary);
    }
    let mut later = factors.split_off(factors.len() / 2);
    let (operator, span, head) = later.remove(0);
    binary(multiplied(first, factors), (operator, span, multiplied(head, later)))
}
