//! A field that is the mass of one particle and the length of a rod.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    regressor,
    coordinates(theta),
    particle(mass = m, position = [m * sin(theta), 0, -m * cos(theta)]),
)]
struct Confused {
    m: f64,
}

fn main() {}
