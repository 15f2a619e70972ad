//! Expressions as a reader wants them: multiplied out where that is short.

use crate::algebra::{Expr, Polynomial};

/// Terms up to which a quantity is multiplied out to see how long it is.
pub const LIMIT: usize = 400;
/// Terms up to which a row is worth reading.
const READABLE: usize = 24;

/// The normal form of an expression if it is short enough to read.
pub fn readable<'g>(e: Expr<'g>) -> Option<Polynomial<'g>> {
    e.expand(LIMIT).filter(|p| p.len() <= READABLE)
}

/// An expression as a computer wants it: multiplied out where that is short, but for sums as they are written, and with cosines that keep
/// their digits near quarter turns.
pub fn compact(e: Expr<'_>) -> Expr<'_> {
    short(e).unwrap_or(e)
}

/// The same, where it is short.
pub fn short(e: Expr<'_>) -> Option<Expr<'_>> {
    let terms = e.expand_around_sums(LIMIT).filter(|p| p.len() <= READABLE)?;
    Some(terms.collect_with_cosines())
}

/// An expression as a reader wants it.
pub fn tidy(e: Expr<'_>) -> Expr<'_> {
    if e.is_leaf() {
        return e;
    }
    readable(e).map_or(e, |p| p.collect())
}

/// Row by row.
pub fn sums<'g>(a: &[Expr<'g>], b: &[Expr<'g>]) -> Vec<Expr<'g>> {
    a.iter().zip(b).map(|(a, b)| *a + *b).collect()
}
