//! States of elements without a rate, with a rate that is no number, in places where none may stand.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x),
    particle(mass = m, position = [x, 0, 0]),
    states(
        force,
        heat = forse * rate(x),
        m = 1,
        seen = rate(heat),
        heat = 0,
        pull = [1, 0, 0]
    ),
    potential = heat * x,
    drive(x = force)
)]
struct Motor {
    m: f64,
}

fn main() {}
