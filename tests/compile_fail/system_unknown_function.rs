//! A misspelt function, one that there is not, and wrong arguments.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y),
    particle(mass = m, position = [x.sine(), gamma(y), sin(x, y)]),
    potential = x.powi(y) + powi(x, 1.5),
)]
struct Scene {
    m: f64,
}

fn main() {}
