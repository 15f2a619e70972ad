//! Scalars, vectors and rotations where others belong.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, theta),
    body(position = x, rotation = theta),
    potential = k * a + x + a * a,
)]
struct Scene {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    j: Vector3<f64>,
    k: f64,
    a: Vector3<f64>,
}

fn main() {}
