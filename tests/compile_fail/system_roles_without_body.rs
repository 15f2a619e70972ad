//! Roles of a body where there are only particles.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x),
    particle(mass = m, position = [x, 0, 0]),
)]
struct Scene {
    #[gauss(mass)]
    m: f64,
    #[gauss(gravity)]
    g: f64,
}

fn main() {}
