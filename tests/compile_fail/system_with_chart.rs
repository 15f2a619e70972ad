//! A chart without the mass data of the body that moves in it.

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
