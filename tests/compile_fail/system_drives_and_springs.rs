//! Drives of what is no scalar coordinate, and springs without an end or with what varies.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, theta, attitude: Rotation),
    body(arm, position = [x, 0, 0], rotation = rotation_z(theta)),
    body(gyro, parent = arm, rotation = attitude),
    frame(wall, position = [l * t, 0, 0]),
    point(tip, body = arm, at = [l, 0, 0]),
    drive(servo),
    drive(servo, thta = k),
    drive(attitude = k),
    drive(x = k, x = [k, 0, 0]),
    spring(to = tip, stiffness = k),
    spring(from = tip, to = wall.position, stiffness = theta, lenght = l),
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
