//! A name that is misspelt, and one that is nothing like any other.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, theta),
    particle(mass = m, position = [x, thta, 0]),
    potential = stiffness * x * x,
)]
struct Scene {
    m: f64,
}

fn main() {}
