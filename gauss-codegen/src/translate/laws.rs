//! Constants of springs, stops and other elements, and masses of particles, for what `kernel()` checks and `warnings()`
//! finds.

use crate::algebra::Expr;
use crate::terms::LawKind;

/// Constants of an element, and what they are.
#[derive(Clone)]
pub struct Law<'g> {
    /// The field, or the element and the argument of its clause.
    pub label: String,
    pub kind: LawKind,
    /// One; of limits the lower and the upper.
    pub values: Vec<Expr<'g>>,
}
