//! A clause of the struct on a field.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
struct Body {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: f64,
    #[gauss(chart = hybrid)]
    stiffness: f64,
}

fn main() {}
