//! Inputs and definitions that are called like parameters, like the body and like one another; elements called like
//! time and like a function.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    chart = jet(euler_zyx),
    input(k, body, gust: Wrench),
    define(m = 2, gust = k),
    force(sin, at = [0, 0, 0], value = [k, body, gust]),
    torque(t, value = [k, 0, 0]),
)]
struct Body {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    j: Vector3<f64>,
    k: f64,
}

fn main() {}
