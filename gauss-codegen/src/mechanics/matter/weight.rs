//! Weight and buoyancy of a body as a resultant and a moment.

use crate::algebra::Expr;

use crate::mechanics::kinematics::vector::{Axes, Frame, Triple, Vector, cross, dot, scale, subtract};
use crate::mechanics::matter::body::Body;

/// Weight and buoyancy, or the weight of matter alone: resultant `effective_mass ĝ` and torque about O
/// `effective_moment × ĝ`.
#[derive(Clone, Copy)]
pub struct Weight<'g> {
    pub gravity: Triple<'g>,
    pub effective_mass: Expr<'g>,
    /// Body axes.
    pub effective_moment: Triple<'g>,
}

impl<'g> Weight<'g> {
    pub fn new(body: &Body<'g>) -> Option<Self> {
        let gravity = body.gravity?;
        let (mut effective_mass, mut effective_moment) = (body.mass, body.first_moment());
        if let Some((mass, center)) = body.displaced {
            effective_mass = effective_mass - mass;
            effective_moment = subtract(&effective_moment, &scale(mass, &center));
        }
        Some(Self { gravity, effective_mass, effective_moment })
    }

    /// Weight of all matter, in a field that is uniform over it.
    pub fn of_matter(body: &Body<'g>, field: Triple<'g>) -> Self {
        Self { gravity: field, effective_mass: body.mass, effective_moment: body.first_moment() }
    }

    pub fn resultant(&self, frame: &Frame<'g>) -> Vector<'g> {
        frame.space_vector(self.gravity).times(self.effective_mass)
    }

    /// M_O with components in the given axes, turned where that is least work.
    pub fn torque(&self, frame: &Frame<'g>, axes: Axes) -> Triple<'g> {
        let arm = frame.resolve(&frame.body_vector(self.effective_moment), axes);
        cross(&arm, &frame.resolve(&frame.space_vector(self.gravity), axes))
    }

    /// U with R = −∂U/∂b.
    pub fn potential(&self, frame: &Frame<'g>, position: &Triple<'g>) -> Expr<'g> {
        let gravity = frame.space_vector(self.gravity);
        let height = self.effective_mass * dot(&self.gravity, position);
        -(height + frame.dot(&frame.body_vector(self.effective_moment), &gravity))
    }
}
