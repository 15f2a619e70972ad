//! States carried from one kernel to another.

use nalgebra::Isometry3;

use super::rotation::coordinates_of_rotation;
use super::{Chart, ChartError, MotionRule, RotationChart};
use crate::configuration::{Configuration, VectorSpace};
use crate::real::Real;
use crate::system::RigidBodySystem;
use crate::triple::norm;

/// The state (q, z) of one kernel in the variables of another: same pose, same body twist of O, up to rounding (divided by
/// the distance from a singularity of the coordinates, which at √ε is refused).
///
/// Both kernels should describe the same body with the same O; nothing else is asked of them, so this also converts between
/// a velocity chart of the free motion and any chart of a planar motion or of one with a fixed point. Poses and twists of
/// the supported charts do not depend on time; they are evaluated at t = 0.
///
/// # Errors
/// - [`ChartError::Singular`] when the pose is a singular point of the target's coordinates;
/// - [`ChartError::Inexpressible`] when the target motion cannot have the pose or the twist beyond rounding;
/// - [`ChartError::NonFinite`] when the state has an infinite or undefined component.
pub fn convert<A, B>(
    from: &A,
    q: &A::Configuration,
    z: &A::Speeds,
    to: &B,
) -> Result<(B::Configuration, B::Speeds), ChartError>
where
    A: RigidBodySystem,
    B: RigidBodySystem<Scalar = A::Scalar>,
{
    let t = A::Scalar::zero();
    let (pose, twist) = (from.pose(t, q), from.body_twist(t, q, z));
    if !Configuration::is_finite(&pose) || !VectorSpace::is_finite(&twist) {
        return Err(ChartError::NonFinite);
    }
    let configuration = to.configuration(&pose)?;
    refuse_near_singularity(to, &configuration, &pose)?;
    let speeds = to.speeds(t, &configuration, &twist);
    if !configuration.is_finite() || !speeds.is_finite() {
        return Err(ChartError::NonFinite);
    }

    // Projecting on the target's twists and going back must change nothing but the last digits. Their unit is set by the
    // largest number on the way: the twist, z itself (large near gimbal lock), and b × ω (large far from Ω).
    let back = to.body_twist(t, &configuration, &speeds);
    let [_, _, _, wx, wy, wz] = twist.data.0[0];
    let lever = norm(&pose.translation.vector.data.0[0]) * norm(&[wx, wy, wz]);
    let scale = twist.max_norm().max(speeds.max_norm()).max(z.max_norm()).max(lever);
    let allowed = 64.0 * A::Scalar::EPSILON * scale;
    for index in 0..6 {
        let excess = twist.component(index) - back.component(index);
        for lane in 0..A::Scalar::LANES {
            let value = excess.lane(lane);
            // Written so that a NaN is refused too.
            if !matches!(
                value.abs().partial_cmp(&allowed),
                Some(core::cmp::Ordering::Less | core::cmp::Ordering::Equal)
            ) {
                return Err(ChartError::Inexpressible { rule: MotionRule::Twist { index }, value });
            }
        }
    }
    Ok((configuration, speeds))
}

/// Velocities lose digits like 1/distance: at a regularity of √ε half of them are gone.
fn refuse_near_singularity<B: RigidBodySystem>(
    to: &B,
    q: &B::Configuration,
    pose: &Isometry3<B::Scalar>,
) -> Result<(), ChartError> {
    let Chart::Jet(chart) = B::CHART else { return Ok(()) };
    let regularity = to.regularity(B::Scalar::zero(), q);
    for lane in 0..B::Scalar::LANES {
        let distance = regularity.lane(lane).abs();
        if distance <= Real::sqrt(B::Scalar::EPSILON) {
            // Near a singularity its sine is the angle. Euler angles are singular in the middle one.
            let angle = match chart {
                RotationChart::Euler(_) => coordinates_of_rotation(chart, &pose.rotation)?[1].lane(lane),
                _ => core::f64::consts::PI - distance,
            };
            return Err(ChartError::Singular { chart, angle, distance });
        }
    }
    Ok(())
}
