//! Inputs where nothing is known of them, one that is declared twice, and one that is not declared.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, theta, attitude: Rotation),
    body(arm, position = [x, 0, 0], rotation = rotation_z(theta)),
    body(gyro, parent = arm, rotation = attitude),
    frame(wall, position = [l * t, 0, 0]),
    point(tip, body = arm, at = [l, 0, 0]),
    input(thrust, k, wind: Vector),
    input(rudder),
    potential = thrust * x,
    force(at = [thrust, 0, 0], value = wind + [throst, 0, 0]),
    drive(theta = rate(thrust)),
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
