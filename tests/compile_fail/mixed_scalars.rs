//! One scalar serves the whole body.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
struct Body {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
    #[gauss(center_of_mass)]
    center: Vector3<f32>,
}

fn main() {}
