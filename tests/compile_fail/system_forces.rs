//! Forces without a point, on no body, in no axes; torques at a point and against themselves.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, theta, attitude: Rotation),
    body(arm, position = [x, 0, 0], rotation = rotation_z(theta)),
    body(gyro, parent = arm, rotation = attitude),
    frame(wall, position = [l * t, 0, 0]),
    point(tip, body = arm, at = [l, 0, 0]),
    point(rim, body = gyro, at = [l, 0, 0]),
    force(value = [k, 0, 0]),
    force(at = tip),
    force(body = arn, value = [k, 0, 0]),
    force(body = arm, at = rim, value = [k, 0, 0]),
    force(body = arm, value = k, axes = gyro),
    force(at = tip, value = [k, 0, 0], axes = body),
    force(at = theta, value = [k, 0, 0], moment = k),
    torque(body = arm, at = tip, value = [0, 0, k]),
    torque(body = arm, value = [0, 0, k], reaction = arm),
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
