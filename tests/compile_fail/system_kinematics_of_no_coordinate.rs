//! Kinematics for a speed, for a misspelt coordinate, and twice for one.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, theta),
    speeds(v, omega),
    kinematics(x = v, thta = omega, v = 1, x = omega),
    particle(mass = m, position = [x, theta, 0]),
)]
struct Scene {
    m: f64,
}

fn main() {}
