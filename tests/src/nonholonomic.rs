//! What the tests of nonholonomic systems share beside the laws of all systems.

use gauss_runtime::prelude::*;

use crate::laws::{Flow, Sizes, System};
use crate::trajectory::{Seen, rows};

/// R by rows, b, u and ω in body axes, by their names in the references; ḃ is given in observer's axes, ω in the
/// body's.
#[must_use]
pub fn rigid_state(pose: &Isometry3<f64>, velocity: Vector3<f64>, omega: Vector3<f64>) -> Seen {
    let list = |v: Vector3<f64>| v.iter().copied().collect::<Vec<_>>();
    vec![
        ("R", rows(&pose.rotation)),
        ("b", list(pose.translation.vector)),
        ("body_u", list(pose.rotation.inverse() * velocity)),
        ("body_omega", list(omega)),
    ]
}

/// [`rigid_state`] of a twist.
#[must_use]
pub fn state_of_twist(pose: &Isometry3<f64>, twist: &SVector<f64, 6>) -> Seen {
    let (u, omega) = (Vector3::new(twist[0], twist[1], twist[2]), Vector3::new(twist[3], twist[4], twist[5]));
    rigid_state(pose, pose.rotation * u, omega)
}

/// (u, ω) in body axes of ḃ and ω in observer's axes.
#[must_use]
pub fn twist(rotation: &UnitQuaternion<f64>, velocity: Vector3<f64>, omega: Vector3<f64>) -> SVector<f64, 6> {
    let (u, w) = (rotation.inverse() * velocity, rotation.inverse() * omega);
    SVector::from([u.x, u.y, u.z, w.x, w.y, w.z])
}

/// The method of order 8 with steps that leave errors near rounding.
#[must_use]
pub fn precise() -> Adaptive {
    Adaptive::new(1e-14, 1e-14)
}

/// T + V grows at this rate along the motion: the power of constraints that do work.
///
/// # Panics
/// When it does not.
#[track_caller]
pub fn gains_energy<S: System>(kernel: &S, t: f64, q: &S::Configuration, z: &S::Speeds, power: f64) {
    let sizes = Sizes::of(kernel, t, q, z);
    let found = Flow::new(kernel, t, q, z).rate(|t, q, z| vec![kernel.energy(t, q, z)])[0];
    // Differences over 1/200 of the time of a radian, with weights that add up to 2.1; their truncation; and what ż is
    // off by.
    let difference = 420.0 * sizes.velocity * sizes.rounding + 1e-12;
    let conditioned = sizes.rounding * sizes.mass * sizes.acceleration * z.max_norm();
    let allowed = difference * sizes.energy + conditioned;
    assert!((found - power).abs() <= allowed, "power {found}, not {power}, allowed {allowed:e}");
}

/// [`gains_energy`] for constraints that are affine in z: λ·(φ(z) − φ(0)), which is zero when they are linear.
///
/// # Panics
/// When it does not.
#[track_caller]
pub fn gains_energy_by_constraints<S>(kernel: &S, t: f64, q: &S::Configuration, z: &S::Speeds)
where
    S: System + ConstrainedSystem,
{
    let still = kernel.velocity_residual(t, q, &S::Speeds::zero());
    let imposed = kernel.velocity_residual(t, q, z).add_scaled(-1.0, &still);
    let multipliers = kernel.multipliers(t, q, z, &());
    let power = (0..S::Multipliers::DIM).map(|k| multipliers.component(k) * imposed.component(k)).sum();
    gains_energy(kernel, t, q, z, power);
}
