//! Attributes that say nothing.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss()]
struct Body {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
    #[gauss]
    stiffness: f64,
}

fn main() {}
