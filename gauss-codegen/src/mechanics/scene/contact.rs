//! Contacts as they are given.
//!
//! Friction of drilling is a slip more: the angular velocity about the normal times a radius.

use crate::algebra::{Expr, Substitution};

/// A contact: a gap that is not negative, and slips along tangents; or dry friction, which has no gap.
#[derive(Clone)]
pub struct Contact<'g> {
    pub name: String,
    /// A function of t and q; `None` of dry friction and of rolling resistance.
    pub gap: Option<Expr<'g>>,
    /// Functions of t, q and z, affine in z.
    pub slips: Vec<Expr<'g>>,
    /// Whether the last of the slips is that of drilling.
    pub drills: bool,
    /// Coefficient μ of each slip, or the bound of dry friction, or ρ: functions of t, q, z and inputs.
    pub friction: Vec<Expr<'g>>,
    /// Number of the contact whose normal force bounds rolling resistance; it comes before this one.
    pub rolls_on: Option<usize>,
    /// e, a constant.
    pub restitution: Option<Expr<'g>>,
    /// Point and axes, if these are known.
    pub frame: Option<ContactFrame<'g>>,
    /// Names of the bodies that touch, where they are known: of the one that has the point, and of the other.
    pub bodies: [Option<String>; 2],
    /// Which of the clauses it comes from.
    pub clause: usize,
}

/// Functions of t and q, components along the observer's axes.
#[derive(Clone)]
pub struct ContactFrame<'g> {
    /// Point of contact, from Ω: of an open contact the point of the first body that would touch.
    pub point: [Expr<'g>; 3],
    /// The normal, then the tangents of the slips, without drilling; of length one.
    pub axes: Vec<[Expr<'g>; 3]>,
}

impl<'g> Contact<'g> {
    /// The contact with expressions in the place of speeds.
    pub fn in_speeds(&self, replacement: &Substitution<'g>) -> Self {
        let replaced = |all: &[Expr<'g>]| all.iter().map(|e| replacement.of(*e)).collect();
        Self { slips: replaced(&self.slips), friction: replaced(&self.friction), ..self.clone() }
    }
}
