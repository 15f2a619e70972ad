//! A mistake in one clause hides none in the next.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(chart = "hybrid", motion = fixed_pont, mass, chart = jet(euler_zyy))]
struct Body {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
}

fn main() {}
