//! Every body has a mass.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
struct Body {
    #[gauss(inertia)]
    inertia: Vector3<f64>,
}

fn main() {}
