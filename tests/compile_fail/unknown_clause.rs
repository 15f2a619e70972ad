//! A clause that the language does not have.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(integrator = rk4)]
struct Body {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
}

fn main() {}
