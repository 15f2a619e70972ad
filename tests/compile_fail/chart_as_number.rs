//! A literal where a word is expected.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(chart = 3)]
struct Body {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
}

fn main() {}
