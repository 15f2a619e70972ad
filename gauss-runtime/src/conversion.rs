//! States carried from one kernel to another.

use nalgebra::Isometry3;

use crate::chart::rotation::coordinates_of_rotation;
use crate::chart::{Chart, ChartError, MotionRule, RotationChart};
use crate::configuration::{Configuration, VectorSpace};
use crate::real::Real;
use crate::system::RigidBodySystem;
use crate::triple::norm;

/// The state (q, z) of one kernel in the variables of another: same pose, same body twist of O, up to rounding (divided
/// by the distance from a singularity of the coordinates, which at √ε is refused).
///
/// Both kernels should describe the same body with the same O. They may differ in all else, so this also converts
/// between a velocity chart of the free motion and any chart of a planar motion or of one with a fixed point, and
/// between charts and coordinates of a scene's own. At t = 0, which only matters where something is moved as a function
/// of time: [`convert_at`]. States of elements are carried over one by one, in their order.
///
/// # Errors
/// - [`ChartError::Singular`] and [`ChartError::Undetermined`] when the pose is a singular point of the target's
///   coordinates;
/// - [`ChartError::Inexpressible`] when the target motion cannot have the pose or the twist beyond rounding, or has not
///   as many states of elements;
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
    convert_at(A::Scalar::zero(), from, q, z, to)
}

/// [`convert`] at time t, where something is moved as a function of time.
///
/// # Errors
/// Those of [`convert`].
pub fn convert_at<A, B>(
    t: A::Scalar,
    from: &A,
    q: &A::Configuration,
    z: &A::Speeds,
    to: &B,
) -> Result<(B::Configuration, B::Speeds), ChartError>
where
    A: RigidBodySystem,
    B: RigidBodySystem<Scalar = A::Scalar>,
{
    if A::STATES != B::STATES {
        let value = B::STATES as f64 - A::STATES as f64;
        return Err(ChartError::Inexpressible { rule: MotionRule::States, value });
    }
    let (pose, twist) = (from.pose(t, q), from.body_twist(t, q, z));
    if !Configuration::is_finite(&pose) || !VectorSpace::is_finite(&twist) {
        return Err(ChartError::NonFinite);
    }
    let configuration = with_states::<A, B>(to.configuration_at(t, &pose)?, q);
    refuse_near_singularity(t, to, &configuration, &pose)?;
    refuse_undetermined(to.determinacy(t, &configuration))?;
    let speeds = to.speeds(t, &configuration, &twist);
    if !configuration.is_finite() || !speeds.is_finite() {
        return Err(ChartError::NonFinite);
    }
    let (configuration, speeds) = admitted(t, to, configuration, speeds, &pose)?;

    // Projecting on the target's twists and going back must change nothing but the last digits. Their unit is set by
    // the largest number on the way: the twist, z itself (large near gimbal lock), and b × ω (large far from Ω).
    let back = to.body_twist(t, &configuration, &speeds);
    let [_, _, _, wx, wy, wz] = twist.data.0[0];
    let lever = norm(&pose.translation.vector.data.0[0]) * norm(&[wx, wy, wz]);
    let scale = twist.max_norm().max(speeds.max_norm()).max(z.max_norm()).max(lever);
    for index in 0..6 {
        let excess = twist.component(index) - back.component(index);
        refuse_beyond(64.0 * A::Scalar::EPSILON * scale, excess, MotionRule::Twist { index })?;
    }
    Ok((configuration, speeds))
}

/// The configuration with the states of elements of another one, which are the last components of both.
fn with_states<A, B>(configuration: B::Configuration, other: &A::Configuration) -> B::Configuration
where
    A: RigidBodySystem,
    B: RigidBodySystem<Scalar = A::Scalar>,
{
    if B::STATES == 0 {
        return configuration;
    }
    let (mut own, other) = (configuration.components(), other.components());
    let last = |dimension: usize, k: usize| dimension - B::STATES + k;
    for k in 0..B::STATES {
        let state = other.component(last(<A::Configuration as Configuration>::Components::DIM, k));
        own.set_component(last(<B::Configuration as Configuration>::Components::DIM, k), state);
    }
    B::Configuration::from_components(&own)
}

/// Refuses a value that is larger than rounding.
fn refuse_beyond<T: Real>(allowed: f64, value: T, rule: MotionRule) -> Result<(), ChartError> {
    for lane in 0..T::LANES {
        let value = value.lane(lane);
        // Written so that a NaN is refused too.
        if !matches!(value.abs().partial_cmp(&allowed), Some(core::cmp::Ordering::Less | core::cmp::Ordering::Equal)) {
            return Err(ChartError::Inexpressible { rule, value });
        }
    }
    Ok(())
}

/// The state that the constraints of the target admit: this one up to rounding, or none.
fn admitted<B: RigidBodySystem>(
    t: B::Scalar,
    to: &B,
    configuration: B::Configuration,
    speeds: B::Speeds,
    pose: &Isometry3<B::Scalar>,
) -> Result<(B::Configuration, B::Speeds), ChartError> {
    if !B::CONSTRAINED {
        return Ok((configuration, speeds));
    }
    let rule = MotionRule::Constraints;
    let projected = to.project(t, &configuration, &speeds);
    let (configuration, speeds) =
        projected.map_err(|error| ChartError::Inexpressible { rule, value: error.residual })?;
    let moved = Configuration::difference(&to.pose(t, &configuration), pose);
    let scale = 1.0 + norm(&pose.translation.vector.data.0[0]);
    for index in 0..6 {
        refuse_beyond(64.0 * B::Scalar::EPSILON * scale, moved.component(index), rule)?;
    }
    Ok((configuration, speeds))
}

/// Speeds lose digits like its reciprocal, as near the singularity of a chart.
fn refuse_undetermined<T: Real>(determinacy: T) -> Result<(), ChartError> {
    for lane in 0..T::LANES {
        let determinacy = determinacy.lane(lane);
        if determinacy <= Real::sqrt(T::EPSILON) {
            return Err(ChartError::Undetermined { determinacy });
        }
    }
    Ok(())
}

/// Velocities lose digits like 1/distance: at a regularity of √ε half of them are gone.
fn refuse_near_singularity<B: RigidBodySystem>(
    t: B::Scalar,
    to: &B,
    q: &B::Configuration,
    pose: &Isometry3<B::Scalar>,
) -> Result<(), ChartError> {
    let Chart::Jet(chart) = B::CHART else { return Ok(()) };
    let regularity = to.regularity(t, q);
    for lane in 0..B::Scalar::LANES {
        let regularity = regularity.lane(lane).abs();
        if regularity <= Real::sqrt(B::Scalar::EPSILON) {
            // Near a singularity the sine of an angle is the angle. Euler angles are singular in the middle one; for a
            // Rodrigues vector it is half the distance.
            let (angle, distance) = match chart {
                RotationChart::Euler(_) => (coordinates_of_rotation(chart, &pose.rotation)?[1].lane(lane), regularity),
                _ => (core::f64::consts::PI - 2.0 * regularity, 2.0 * regularity),
            };
            return Err(ChartError::Singular { chart, angle, distance });
        }
    }
    Ok(())
}
