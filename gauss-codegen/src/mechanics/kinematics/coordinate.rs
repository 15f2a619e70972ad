//! Coordinates of the configuration: numbers, rotations and poses.

use crate::algebra::Expr;

use crate::mechanics::kinematics::vector::Triple;

/// One coordinate of the configuration.
#[derive(Clone)]
pub enum Coordinate<'g> {
    Scalar(Expr<'g>),
    /// R, by its entries.
    Rotation([Triple<'g>; 3]),
    /// (R, b).
    Pose([Triple<'g>; 3], Triple<'g>),
    /// SE(2), in the plane k₁k₂: cos θ and sin θ, b₁ and b₂. Its rate is (u₁, u₂, ω).
    Plane {
        turn: [Expr<'g>; 2],
        position: [Expr<'g>; 2],
    },
}

impl<'g> Coordinate<'g> {
    /// Number of components of its rate.
    pub fn size(&self) -> usize {
        match self {
            Coordinate::Scalar(_) => 1,
            Coordinate::Rotation(_) | Coordinate::Plane { .. } => 3,
            Coordinate::Pose(..) => 6,
        }
    }

    /// Number of the coordinate that a component of the rates of all belongs to.
    pub fn of_component(all: &[Self], component: usize) -> usize {
        let mut end = 0;
        let ends = all.iter().map(|coordinate| {
            end += coordinate.size();
            end
        });
        ends.take_while(|end| *end <= component).count()
    }

    /// R, where its entries are symbols.
    pub fn rotation(&self) -> Option<&[Triple<'g>; 3]> {
        match self {
            Coordinate::Scalar(_) | Coordinate::Plane { .. } => None,
            Coordinate::Rotation(rotation) | Coordinate::Pose(rotation, _) => Some(rotation),
        }
    }
}
