//! Rust that is no arithmetic: all of it is reported.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y),
    speeds(v, w),
    kinematics(x = if x == 0 { v } else { w }, y = v ^ 2),
    particle(mass = m as f64, position = [x, y..1, (x, y)]),
    potential = 1e999 * x,
)]
struct Scene {
    m: f64,
}

fn main() {}
