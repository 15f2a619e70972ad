//! The shape behind an alias must be said.

use gauss_runtime::prelude::*;

type Tensor = Matrix3<f64>;

#[derive(GaussDynamics)]
struct Body {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: Tensor,
}

fn main() {}
