//! An array is none of the shapes of an inertia.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
struct Body {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: [f64; 3],
}

fn main() {}
