//! A clause without its value.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(chart)]
struct Body {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
}

fn main() {}
