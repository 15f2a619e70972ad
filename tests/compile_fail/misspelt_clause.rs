//! A misspelt clause.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(moton = planar)]
struct Body {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
}

fn main() {}
