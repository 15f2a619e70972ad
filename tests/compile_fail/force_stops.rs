//! Stops without limits, without a width, along nothing and along two things.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    stop(along = body.position.z, stiffness = k, width = k),
    stop(along = body.position.z, least = 0, stiffness = k),
    stop(least = 0, stiffness = k, width = k),
    stop(along = body.position.z, from = body.position, least = 0, stiffness = k, width = k),
    stop(along = body.position.z, most = body.position.x, stiffness = k, width = k),
    spring(along = body.velocity.x, stiffness = k),
    spring(along = clamp(body.position.x, 0, 1), stiffness = k, lenght = k),
)]
struct Body {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    j: Vector3<f64>,
    k: f64,
}

fn main() {}
