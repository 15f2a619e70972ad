//! A chart that is no chart: the valid ones are listed.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(chart = polar)]
struct Body {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
}

fn main() {}
