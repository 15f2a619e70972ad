//! The form of a role in place of the role.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
struct Body {
    #[gauss(mass)]
    mass: f64,
    #[gauss(principal)]
    inertia: Vector3<f64>,
}

fn main() {}
