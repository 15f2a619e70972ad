//! A particle without a mass, and a misspelt argument.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x),
    particle(position = [x, 0, 0]),
    particle(mass = m, positon = [x, 0, 0]),
)]
struct Scene {
    m: f64,
}

fn main() {}
