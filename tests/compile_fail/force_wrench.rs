//! Wrenches that are taken for vectors, act nowhere or are empty.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    input(gust: Wrench),
    force(at = [0, 0, 0], value = gust),
    torque(value = gust.moment),
    wrench(),
    wrench(at = [0, 0, 0], torque = gust.torque),
    wrench(force = gust.torque.x),
    wrench(force = body.force),
)]
struct Body {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    j: Vector3<f64>,
}

fn main() {}
