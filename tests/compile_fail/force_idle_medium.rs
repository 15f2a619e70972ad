//! A medium that nothing feels, and a definition that nothing uses.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    medium(velocity = [1, 0, 0]),
    define(u = body.relative_velocity),
    force(at = [0, 0, 0], value = -body.body_velocity),
)]
struct Body {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    j: Vector3<f64>,
}

fn main() {}
