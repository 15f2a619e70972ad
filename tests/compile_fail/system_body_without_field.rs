//! A body whose field is misspelt, and one whose field has no role.

use gauss_runtime::prelude::*;

/// The mass data of a body.
struct RigidBody<T>(T);

#[derive(GaussDynamics)]
#[gauss(
    coordinates(a, b),
    body(uper, rotation = rotation_x(a)),
    body(lower, rotation = rotation_x(b)),
)]
struct Scene {
    #[gauss(body)]
    upper: RigidBody<f64>,
    lower: RigidBody<f64>,
}

fn main() {}
