//! Principal moments in a matrix.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
struct Body {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia = principal)]
    inertia: Matrix3<f64>,
}

fn main() {}
