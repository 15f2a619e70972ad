//! A string where a bare word is meant.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(chart = "hybrid")]
struct Body {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
}

fn main() {}
