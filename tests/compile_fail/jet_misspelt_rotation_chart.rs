//! A misspelt rotation chart.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(chart = jet(rodriguez))]
struct Body {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
}

fn main() {}
