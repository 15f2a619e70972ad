//! Forces and inputs of one body in a chart, and forces on a field.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(chart = hybrid, input(thrust), force(at = [0, 0, 0], value = [thrust, 0, 0]))]
struct Body {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    j: Vector3<f64>,
    #[gauss(damping)]
    c: f64,
}

fn main() {}
