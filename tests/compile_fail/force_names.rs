//! Inputs and definitions that are called like parameters, like the body and like one another.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    chart = jet(euler_zyx),
    input(k, body, gust: Wrench),
    define(m = 2, gust = k),
    force(j, at = [0, 0, 0], value = [k, body, gust]),
)]
struct Body {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    j: Vector3<f64>,
    k: f64,
}

fn main() {}
