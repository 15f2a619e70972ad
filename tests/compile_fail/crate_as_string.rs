//! The path to the runtime is a path.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(crate = "gauss_runtime")]
struct Body {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
}

fn main() {}
