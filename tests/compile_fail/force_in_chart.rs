//! What acts on one body in a chart: without a point, on another body, in other axes, on a rate.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    chart = hybrid,
    force(value = [k, 0, 0]),
    force(body = arm, at = [k, 0, 0], value = [k, 0, 0]),
    force(at = [k, 0, 0], value = [k, 0, 0], axes = world),
    force(at = body.position, value = [k, 0, 0], moment = k),
    torque(value = [0, 0, k], reaction = body),
    drive(theta = k),
)]
struct Body {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    j: Vector3<f64>,
    k: f64,
    #[gauss(damping)]
    c: f64,
}

fn main() {}
