//! A limit is a positive integer.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x),
    particle(mass = m, position = [x, 0, 0]),
    limit = 0,
)]
struct Scene {
    m: f64,
}

fn main() {}
