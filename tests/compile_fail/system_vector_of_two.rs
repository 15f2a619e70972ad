//! A vector in the plane still has three components.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y),
    particle(mass = m, position = [x, y]),
)]
struct Scene {
    m: f64,
}

fn main() {}
