//! Power series of what arrives at run time or is not smooth, and `taylor` with a value.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(taylor, input(thrust), force(body = body, value = [thrust, 0, 0]))]
struct Driven {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    j: Vector3<f64>,
}

#[derive(GaussDynamics)]
#[gauss(taylor, drag(quadratic = d))]
struct Dragged {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    j: Vector3<f64>,
    d: Vector6<f64>,
}

#[derive(GaussDynamics)]
#[gauss(taylor, coordinates(x), particle(mass = m, position = [x, 0, 0]), drive(x = -signum(rate(x))))]
struct Rubbed {
    m: f64,
}

#[derive(GaussDynamics)]
#[gauss(taylor = 12, taylor)]
struct Valued {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    j: Vector3<f64>,
}

fn main() {}
