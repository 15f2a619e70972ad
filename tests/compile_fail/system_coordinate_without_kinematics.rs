//! A coordinate whose rate is not given.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, theta),
    speeds(v, omega),
    kinematics(x = v * cos(theta), theta = omega),
    body(position = [x, y, 0], rotation = rotation_z(theta)),
)]
struct Scene {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    j: Vector3<f64>,
}

fn main() {}
