//! Constants of springs, stops and other elements, and masses of particles, for what `kernel()` checks and `warnings()` finds.

use crate::algebra::Expr;

/// Constants of an element, and what they are.
#[derive(Clone)]
pub struct Law<'g> {
    /// The field, or the element and the argument of its clause.
    pub label: String,
    pub kind: LawKind,
    /// One; of limits the lower and the upper.
    pub values: Vec<Expr<'g>>,
}

/// What constants of an element are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LawKind {
    /// Of a spring or a stop.
    Stiffness,
    /// Of a stop.
    Width,
    /// Of a stop, both of them.
    Limits,
    /// A coefficient of a spring or a stop.
    Damping,
    /// An armature, or the level of dry friction.
    NonNegative,
    /// The mass of a particle.
    MassInSum,
    /// A whole dissipation function, of the state too.
    Dissipation,
    /// A gravitational parameter.
    Attraction,
}
