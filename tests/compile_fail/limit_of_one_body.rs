//! A limit below what one body needs.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    limit = 100,
)]
struct Scene {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    j: Vector3<f64>,
}

fn main() {}
