//! Speeds that are not there, or that nothing is solved for.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y),
    speeds(v, omega),
    kinematics(x = v, y = omega),
    particle(mass = m, position = [x, y, 0]),
    independent(v, omga, v, x),
)]
struct Scene {
    m: f64,
}

fn main() {}
