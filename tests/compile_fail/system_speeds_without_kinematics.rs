//! Speeds that nothing is said about.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y),
    speeds(v, w),
    particle(mass = m, position = [x, y, 0]),
)]
struct Scene {
    m: f64,
}

fn main() {}
