//! A body is placed, but by names that are not declared.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    body(position = [x, y, 0], rotation = rotation_z(theta)),
)]
struct Scene {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    j: Vector3<f64>,
}

fn main() {}
