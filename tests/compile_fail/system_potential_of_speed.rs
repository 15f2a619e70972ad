//! A potential that depends on a speed.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x),
    speeds(v),
    kinematics(x = v),
    particle(mass = m, position = [x, 0, 0]),
    potential = c * v * x,
)]
struct Scene {
    m: f64,
    c: f64,
}

fn main() {}
