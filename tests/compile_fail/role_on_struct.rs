//! A role above the struct.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(mass)]
struct Body {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
}

fn main() {}
