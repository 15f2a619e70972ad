//! A clause given twice, in two attributes.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(chart = hybrid)]
#[gauss(chart = right_invariant)]
struct Body {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
}

fn main() {}
