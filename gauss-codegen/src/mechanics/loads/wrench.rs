//! Wrenches about O of a link, each part in the axes where it arises.

use crate::algebra::{Expr, Graph};

use crate::mechanics::kinematics::vector::Vector;

/// A resultant and a torque about O.
#[derive(Clone, Copy)]
pub struct Wrench<'g> {
    pub force: Vector<'g>,
    pub torque: Vector<'g>,
}

impl<'g> Wrench<'g> {
    pub fn zero(graph: &'g Graph) -> Self {
        let zero = [graph.zero(); 3];
        let none = Vector { body: zero, space: zero };
        Self { force: none, torque: none }
    }

    pub fn map(&self, f: impl Fn(Expr<'g>) -> Expr<'g>) -> Self {
        Self { force: self.force.map(&f), torque: self.torque.map(&f) }
    }

    pub fn plus(&self, other: &Self) -> Self {
        Self { force: self.force.plus(&other.force), torque: self.torque.plus(&other.torque) }
    }
}
