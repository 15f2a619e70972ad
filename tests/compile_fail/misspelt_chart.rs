//! A misspelt chart: the nearest one is suggested.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(chart = hybird)]
struct Body {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
}

fn main() {}
