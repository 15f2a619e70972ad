//! Charts and motions are for one body.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    chart = hybrid,
    motion = planar,
    coordinates(x),
    particle(mass = m, position = [x, 0, 0]),
)]
struct Scene {
    m: f64,
}

fn main() {}
