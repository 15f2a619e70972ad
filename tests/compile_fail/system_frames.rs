//! Frames have names of their own and no mass.

use gauss_runtime::prelude::*;

/// The mass data of a body.
struct RigidBody<T>(T);

#[derive(GaussDynamics)]
#[gauss(
    coordinates(a),
    body(arm, parent = hip, rotation = rotation_z(a)),
    frame(hip, mass = m, position = [l, 0, 0]),
    frame(arm),
    frame(position = [l, 0, 0]),
)]
struct Scene {
    #[gauss(body)]
    arm: RigidBody<f64>,
    m: f64,
    l: f64,
}

fn main() {}
