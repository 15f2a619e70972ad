//! Two clauses without a comma between them.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(chart = hybrid motion = free)]
struct Body {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
}

fn main() {}
