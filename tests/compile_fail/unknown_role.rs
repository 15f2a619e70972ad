//! A role that the language does not have: the valid ones are listed.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
struct Body {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
    #[gauss(flywheel)]
    momentum: f64,
}

fn main() {}
