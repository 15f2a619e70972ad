//! Why a state has no coordinates in a chart.

use core::fmt;

use super::RotationChart;

/// A pose or a twist that a chart or a motion cannot express.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum ChartError {
    /// The rotation is a singular point of its coordinates (gimbal lock; half a turn for the Rodrigues vector).
    Singular {
        /// The coordinates.
        chart: RotationChart,
        /// The angle that is singular, in radians: the middle Euler angle, or the whole turn.
        angle: f64,
        /// Its distance from the singular value, in radians.
        distance: f64,
    },
    /// The axes of an Euler sequence do not exist or have equal neighbours.
    InvalidSequence {
        /// The axes as given.
        axes: [u8; 3],
    },
    /// The target motion cannot have this state.
    Inexpressible {
        /// The condition of the motion.
        rule: MotionRule,
        /// The quantity that should vanish: a length, a sine, or a component of the twist, in the user's units.
        value: f64,
    },
    /// The twist does not determine the speeds at this pose: the coordinates are singular there.
    Undetermined {
        /// [`RigidBodySystem::determinacy`](crate::system::RigidBodySystem::determinacy): 0 at the singularity.
        determinacy: f64,
    },
    /// A component of the state is infinite or NaN.
    NonFinite,
}

/// A condition that a motion sets on a state.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum MotionRule {
    /// A body with a fixed point has O at Ω: component `axis` of b must vanish.
    FixedPoint {
        /// Axis of the observer: 0, 1 or 2.
        axis: usize,
    },
    /// A body in the plane k₁k₂ has O in it: b₃ must vanish.
    InPlane,
    /// A body in the plane k₁k₂ keeps e₃ = k₃: the tilt, as a sine of its half, must vanish.
    Upright,
    /// Component `index` of the body twist (u₁, u₂, u₃, ω₁, ω₂, ω₃) is not a velocity of the target motion, and must
    /// equal what the target makes of it; the value is the difference.
    Twist {
        /// 0 … 5.
        index: usize,
    },
    /// The coordinates of the target must have the pose; the value is the difference, an angle or a length.
    Pose,
    /// The constraints of the target must hold; the value is their residual, or the distance of the state from them.
    Constraints,
    /// The elements of the target must have as many states; the value is how many more there are.
    States,
}

impl fmt::Display for MotionRule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::FixedPoint { axis } => {
                write!(f, "a body with a fixed point has O at the origin, so b{} must be 0", axis + 1)
            }
            Self::InPlane => f.write_str("a planar body has O in the plane k1 k2, so b3 must be 0"),
            Self::Upright => f.write_str("a planar body keeps e3 along k3, so the sine of half its tilt must be 0"),
            Self::Twist { index } => write!(
                f,
                "the target motion cannot have component {} of the body twist, so the excess must be 0",
                ["u1", "u2", "u3", "ω1", "ω2", "ω3"].get(*index).unwrap_or(&"?")
            ),
            Self::Pose => {
                f.write_str("no coordinates of the target with this pose were found, so the distance from it must be 0")
            }
            Self::Constraints => {
                f.write_str("the state must satisfy the constraints of the target, so their residual must be 0")
            }
            Self::States => f.write_str("elements of both must have as many states, so the difference must be 0"),
        }
    }
}

impl fmt::Display for ChartError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Singular { chart, angle, distance } => write!(
                f,
                "the chart {chart} is singular here: its angle {angle} rad is {distance:e} rad from the singularity; \
                 use another sequence of angles, or a chart without angles"
            ),
            Self::InvalidSequence { axes } => write!(
                f,
                "the axes {axes:?} are not a sequence of Euler angles: each is 0, 1 or 2, and neighbours differ"
            ),
            Self::Inexpressible { rule, value } => write!(f, "{rule}, but it is {value:e}"),
            Self::Undetermined { determinacy } => write!(
                f,
                "the twist does not determine the speeds here, to {determinacy:e} of their size: the coordinates are \
                 singular; use others, or a chart without angles"
            ),
            Self::NonFinite => f.write_str("the state has an infinite or undefined component"),
        }
    }
}

impl core::error::Error for ChartError {}
