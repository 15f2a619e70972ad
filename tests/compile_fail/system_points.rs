//! Points are fixed in a body that there is.

use gauss_runtime::prelude::*;

/// The mass data of a body.
struct RigidBody<T>(T);

#[derive(GaussDynamics)]
#[gauss(
    coordinates(a),
    body(arm, rotation = rotation_z(a)),
    point(tip, body = amr, at = [l, 0, 0]),
    point(hand, body = arm, at = [l * cos(a), 0, 0]),
    point(arm, body = arm),
)]
struct Scene {
    #[gauss(body)]
    arm: RigidBody<f64>,
    l: f64,
}

fn main() {}
