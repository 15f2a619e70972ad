//! Drags without coefficients, with too few, of the wrong shape and of another scalar.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    drag(),
    drag(body = body),
    drag(linear = [k, k, k]),
    drag(linear = j),
    drag(quadratic = 2 * d),
    drag(quadratic = e),
    drag(linear = damping),
)]
struct Body {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    j: Vector3<f64>,
    k: f64,
    d: Matrix6<f64>,
    e: Vector6<f32>,
}

fn main() {}
