//! Contacts as they are given.

use crate::algebra::{Expr, Substitution};

/// What may touch: a gap that is not negative, and slips along tangents.
#[derive(Clone)]
pub struct Contact<'g> {
    pub name: String,
    /// A function of t and q.
    pub gap: Expr<'g>,
    /// Functions of t, q and z, affine in z.
    pub slips: Vec<Expr<'g>>,
    /// μ, a function of t, q, z and inputs.
    pub friction: Option<Expr<'g>>,
    /// e, a constant.
    pub restitution: Option<Expr<'g>>,
    /// Which of the clauses it comes from.
    pub clause: usize,
}

impl<'g> Contact<'g> {
    /// With expressions in the place of speeds.
    pub fn in_speeds(&self, replacement: &Substitution<'g>) -> Self {
        let slips = self.slips.iter().map(|slip| replacement.of(*slip)).collect();
        Self { slips, friction: self.friction.map(|friction| replacement.of(friction)), ..self.clone() }
    }
}
