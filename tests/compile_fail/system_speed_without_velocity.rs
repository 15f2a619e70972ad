//! A speed that no rate depends on.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y),
    speeds(v, w),
    kinematics(x = v, y = 2 * v),
    particle(mass = m, position = [x, y, 0]),
)]
struct Scene {
    m: f64,
}

fn main() {}
