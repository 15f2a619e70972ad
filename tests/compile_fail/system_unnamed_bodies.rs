//! Of several bodies each needs a name.

use gauss_runtime::prelude::*;

/// The mass data of a body.
struct RigidBody<T>(T);

#[derive(GaussDynamics)]
#[gauss(
    coordinates(a, b),
    body(rotation = rotation_x(a)),
    body(lower, rotation = rotation_x(b)),
)]
struct Scene {
    #[gauss(body)]
    lower: RigidBody<f64>,
}

fn main() {}
