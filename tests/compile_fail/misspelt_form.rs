//! A misspelt form of a role.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
struct Body {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia = princpal)]
    inertia: Vector3<f64>,
}

fn main() {}
