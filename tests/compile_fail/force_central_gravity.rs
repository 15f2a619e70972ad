//! Central gravity without its parameter, to a center that moves, under the name of another element.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    central_gravity(center = [0, 0, 0]),
    central_gravity(mu = body.position.x),
    central_gravity(sun, mu = k, center = body.position),
    central_gravity(mu = k, centre = [0, 0, 0]),
    force(sun, at = [0, 0, 0], value = [k, 0, 0]),
)]
struct Body {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    j: Vector3<f64>,
    k: f64,
}

fn main() {}
