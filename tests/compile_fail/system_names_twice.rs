//! Names that are taken.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, x, t, m),
    speeds(v, y, sin),
    kinematics(x = v, y = v),
    particle(mass = 1, position = [x, 0, 0]),
)]
struct Scene {
    m: f64,
}

fn main() {}
