//! Expressions as a reader wants them: multiplied out where that is short.

use crate::algebra::{Expr, Polynomial};

/// Terms up to which a quantity is multiplied out to see how long it is.
pub const LIMIT: usize = 400;
/// Terms up to which a row is worth reading.
pub const READABLE: usize = 24;
/// Terms up to which it is multiplied out for readers. What is longer on the way is hardly ever short in the end, and
/// to find that out of the rows of an arm took a seventh of its derivation.
const ON_THE_WAY: usize = 4 * READABLE;

/// The normal form of an expression if it is short enough to read.
pub fn readable<'g>(e: Expr<'g>) -> Option<Polynomial<'g>> {
    e.expand(ON_THE_WAY).filter(|p| p.len() <= READABLE)
}

/// An expression as a reader wants it.
pub fn legible(e: Expr<'_>) -> Expr<'_> {
    if e.is_leaf() { e } else { readable(e).map_or(e, |p| p.collect()) }
}

/// An expression as a computer wants it: multiplied out where that is short, but for sums as they are written, and with
/// cosines that keep their digits near quarter turns.
pub fn compact(e: Expr<'_>) -> Expr<'_> {
    short(e).unwrap_or(e)
}

/// The same, where it is short.
pub fn short(e: Expr<'_>) -> Option<Expr<'_>> {
    let terms = e.expand_around_sums(LIMIT).filter(|p| p.len() <= READABLE)?;
    Some(terms.collect_with_cosines())
}

/// An expression multiplied out where that is short: zero where it vanishes, unless that takes very long to see.
pub fn tidy(e: Expr<'_>) -> Expr<'_> {
    if e.is_leaf() {
        return e;
    }
    e.expand(LIMIT).filter(|p| p.len() <= READABLE).map_or(e, |p| p.collect())
}

/// Row by row.
pub fn sums<'g>(a: &[Expr<'g>], b: &[Expr<'g>]) -> Vec<Expr<'g>> {
    a.iter().zip(b).map(|(a, b)| *a + *b).collect()
}
