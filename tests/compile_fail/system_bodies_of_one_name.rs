//! Two bodies of one name, so that the other field has no clause.

use gauss_runtime::prelude::*;

/// The mass data of a body.
struct RigidBody<T>(T);

#[derive(GaussDynamics)]
#[gauss(
    coordinates(a, b),
    body(upper, rotation = rotation_x(a)),
    body(upper, rotation = rotation_x(b)),
)]
struct Scene {
    #[gauss(body)]
    upper: RigidBody<f64>,
    #[gauss(body)]
    lower: RigidBody<f64>,
}

fn main() {}
