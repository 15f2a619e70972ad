//! Case and underscores are forgiven in suggestions.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(chart = LeftInvariant)]
struct Body {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
}

fn main() {}
