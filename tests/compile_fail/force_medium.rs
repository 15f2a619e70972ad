//! A medium whose velocity is an input, or varies with the place.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    input(wind: Vector3),
    medium(velocity = wind + [body.position.x, 0, 0]),
    drag(linear = d),
)]
struct Body {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    j: Vector3<f64>,
    d: Matrix6<f64>,
}

fn main() {}
