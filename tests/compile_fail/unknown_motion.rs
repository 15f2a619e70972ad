//! A motion that is no motion.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(motion = floating)]
struct Body {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
}

fn main() {}
