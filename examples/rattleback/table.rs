//! The same stone on a table with Coulomb's friction: a contact, in place of the constraint that it rolls.

use gauss_contact::{ContactError, ContactRun, ContactTrajectory};
use gauss_runtime::prelude::*;

use crate::stone::{AXES, pose};

/// An ellipsoid of semi-axes `a` about O, on the table z = 0 or above it. That it rolls is not said.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(stone, position = pose.position, rotation = pose.rotation),
    contact(table, point = stone.position, semi_axes = [a.x, a.y, a.z], friction = mu),
)]
pub struct OnTable {
    #[gauss(body)]
    pub stone: RigidBody<f64>,
    pub a: Vector3<f64>,
    pub mu: f64,
    #[gauss(gravity)]
    pub g: f64,
}

pub type Run<'k> = ContactTrajectory<'k, OnTableKernel>;

/// Five seconds of a stone that rolls at first, spun about the vertical.
///
/// # Errors
/// Where the laws of contact have no motion.
pub fn spun(
    kernel: &OnTableKernel,
    attitude: UnitQuaternion<f64>,
    spin: f64,
    tolerance: f64,
) -> Result<Run<'_>, ContactError> {
    let place = pose(&(attitude, SVector::zeros()));
    let (up, axes) = (attitude.inverse() * Vector3::z(), Vector3::from(AXES));
    // In body axes: from the point that touches to O, whose velocity is that of a body that turns about this point.
    let arm = axes.component_mul(&axes).component_mul(&up) / place.translation.z;
    let w = Vector3::new(0.0, 0.0, spin);
    let u = w.cross(&arm);
    let z = SVector::from([u.x, u.y, u.z, w.x, w.y, w.z]);
    ContactRun::new(kernel).adaptive(tolerance, tolerance).run(place, z, 0.0..5.0)
}

/// The angular velocity about the vertical, rad/s.
pub fn vertical(s: &Sample<OnTableKernel>) -> f64 {
    (s.q.rotation * Vector3::new(s.z[3], s.z[4], s.z[5])).z
}

/// Friction over the normal force.
///
/// # Errors
/// Where the run does not cover the time.
pub fn obliquity(run: &Run<'_>, t: f64) -> Result<f64, ContactError> {
    let forces = *run.forces(t)?;
    Ok(forces[1].hypot(forces[2]) / forces[0])
}
