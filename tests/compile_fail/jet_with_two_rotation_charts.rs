//! A jet chart has one set of angles.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(chart = jet(euler_zyx, rodrigues))]
struct Body {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
}

fn main() {}
