//! Elements of one name, of one kind and of two.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, theta, attitude: Rotation),
    body(arm, position = [x, 0, 0], rotation = rotation_z(theta)),
    body(gyro, parent = arm, rotation = attitude),
    frame(wall, position = [l * t, 0, 0]),
    point(tip, body = arm, at = [l, 0, 0]),
    force(pull, at = tip, value = [k, 0, 0]),
    force(pull, at = tip, value = [k, 0, 0]),
    torque(pull, body = arm, value = [0, 0, k]),
    spring(tip, from = [0, 0, 0], to = tip, stiffness = k),
    drag(tip, body = arm, linear = [k, 0, 0, 0, 0, 0]),
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
