//! Clauses of a later version, on the struct and on a field.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x),
    particle(mass = m, position = [x, 0, 0]),
    input(thrust),
    damping = c * x,
)]
struct Scene {
    m: f64,
    #[gauss(force)]
    c: f64,
}

fn main() {}
