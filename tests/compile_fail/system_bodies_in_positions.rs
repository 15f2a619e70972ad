//! Bodies are placed by parents, and kinematics do without bodies.

use gauss_runtime::prelude::*;

/// The mass data of a body.
struct RigidBody<T>(T);

#[derive(GaussDynamics)]
#[gauss(
    coordinates(a, b),
    speeds(v, w),
    kinematics(a = v, b = w * upper.position.x),
    body(upper, rotation = rotation_z(a)),
    body(lower, position = upper.position + tip, rotation = upper.rotation * rotation_z(b)),
    point(tip, body = upper, at = [1, 0, 0]),
)]
struct Scene {
    #[gauss(body)]
    upper: RigidBody<f64>,
    #[gauss(body)]
    lower: RigidBody<f64>,
}

fn main() {}
