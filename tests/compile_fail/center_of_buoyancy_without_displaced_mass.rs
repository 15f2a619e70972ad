//! A point at which nothing acts.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
struct Body {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
    #[gauss(gravity)]
    gravity: f64,
    #[gauss(center_of_buoyancy)]
    buoyancy: Vector3<f64>,
}

fn main() {}
