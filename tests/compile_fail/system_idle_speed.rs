use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y),
    speeds(v, idle),
    kinematics(x = v, y = 2 * v + 0 * idle),
    particle(mass = m, position = [x, y, 0]),
)]
struct Idle {
    m: f64,
}

fn main() {}
