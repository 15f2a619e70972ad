//! Nothing that could move.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x),
    potential = k * x * x / 2,
)]
struct Scene {
    k: f64,
}

fn main() {}
