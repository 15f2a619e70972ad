//! A mass of six by six.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
struct Body {
    #[gauss(mass)]
    mass: Matrix6<f64>,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
}

fn main() {}
