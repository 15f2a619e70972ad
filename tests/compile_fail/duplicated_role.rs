//! One role on two fields.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
struct Body {
    #[gauss(mass)]
    dry: f64,
    #[gauss(mass)]
    wet: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
}

fn main() {}
