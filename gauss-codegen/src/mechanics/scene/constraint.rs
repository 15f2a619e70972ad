//! Constraints as they are given: what is zero.

use crate::algebra::Expr;

/// Kinds of functions that a constraint holds at zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ConstraintKind {
    /// A function of t and q.
    Position,
    /// A function of t, q and z.
    Velocity,
}

/// One scalar constraint.
#[derive(Clone, Copy)]
pub struct Constraint<'g> {
    pub kind: ConstraintKind,
    /// φ.
    pub value: Expr<'g>,
    /// Which of the clauses it comes from.
    pub clause: usize,
}
