//! A misspelt role is suggested, and not missing as well.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
struct Body {
    #[gauss(mas)]
    mass: f64,
    #[gauss(inerta)]
    inertia: Vector3<f64>,
    #[gauss(centre_of_mass)]
    center: Vector3<f64>,
}

fn main() {}
