//! Contacts as they are given.

use crate::algebra::{Expr, Substitution};

/// What may touch: a gap that is not negative, and slips along tangents; or dry friction, which has no gap.
#[derive(Clone)]
pub struct Contact<'g> {
    pub name: String,
    /// A function of t and q; `None` of dry friction.
    pub gap: Option<Expr<'g>>,
    /// Functions of t, q and z, affine in z.
    pub slips: Vec<Expr<'g>>,
    /// Of each slip μ, or the bound of dry friction: functions of t, q, z and inputs.
    pub friction: Vec<Expr<'g>>,
    /// e, a constant.
    pub restitution: Option<Expr<'g>>,
    /// Where it is, if that is known.
    pub frame: Option<ContactFrame<'g>>,
    /// Which of the clauses it comes from.
    pub clause: usize,
}

/// Functions of t and q, components along the observer's axes.
#[derive(Clone)]
pub struct ContactFrame<'g> {
    /// Where it touches, from Ω: of an open contact the point of the first body that would.
    pub point: [Expr<'g>; 3],
    /// The normal, then the tangents of the slips; of length one.
    pub axes: Vec<[Expr<'g>; 3]>,
}

impl<'g> Contact<'g> {
    /// With expressions in the place of speeds.
    pub fn in_speeds(&self, replacement: &Substitution<'g>) -> Self {
        let replaced = |all: &[Expr<'g>]| all.iter().map(|e| replacement.of(*e)).collect();
        Self { slips: replaced(&self.slips), friction: replaced(&self.friction), ..self.clone() }
    }
}
