//! Two bodies that are each other's parent.

use gauss_runtime::prelude::*;

/// The mass data of a body.
struct RigidBody<T>(T);

#[derive(GaussDynamics)]
#[gauss(
    coordinates(a, b),
    body(upper, parent = lower, rotation = rotation_x(a)),
    body(lower, parent = upper, rotation = rotation_x(b)),
)]
struct Scene {
    #[gauss(body)]
    upper: RigidBody<f64>,
    #[gauss(body)]
    lower: RigidBody<f64>,
}

fn main() {}
