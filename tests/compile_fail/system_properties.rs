//! What bodies, poses and points have, and what they have not.

use gauss_runtime::prelude::*;

/// The mass data of a body.
struct RigidBody<T>(T);

#[derive(GaussDynamics)]
#[gauss(
    coordinates(a, pose: Pose),
    body(arm, position = pose.position, rotation = pose.rotation),
    point(tip, body = arm, at = [a, 0, 0]),
    particle(mass = m, position = arm.positon + tip.position),
    potential = arm.velocity.x + pose.x + arm.x + a.rotation,
)]
struct Scene {
    #[gauss(body)]
    arm: RigidBody<f64>,
    m: f64,
}

fn main() {}
