//! Every mistake of a system is reported in one compilation.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, theta, x),
    speeds(v),
    kinematics(x = v * cos(thta)),
    body(position = [x, 0], rotation = theta, parent = other),
    potential = k * v,
)]
struct Scene {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    j: Matrix6<f64>,
}

fn main() {}
