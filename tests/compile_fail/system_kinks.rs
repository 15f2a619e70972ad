//! Functions whose derivative jumps, where derivatives are taken, and potentials of velocities.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, theta, attitude: Rotation),
    body(arm, position = [x, 0, 0], rotation = rotation_z(theta)),
    body(gyro, parent = arm, rotation = attitude),
    frame(wall, position = [l * t, 0, 0]),
    point(tip, body = arm, at = [l, 0, 0]),
    potential = k * abs(x) + rate(x),
    constraint(position = max(x, theta)),
    damping = k * rate(x).abs(),
    drive(theta = rate(min(theta, k)) + abs(theta)),
)]
struct Scene {
    #[gauss(body)]
    arm: RigidBody<f64>,
    #[gauss(body)]
    gyro: RigidBody<f64>,
    l: f64,
    k: f64,
}

fn main() {}
