//! `jet` in space needs to know the angles.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(chart = jet)]
struct Body {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
}

fn main() {}
