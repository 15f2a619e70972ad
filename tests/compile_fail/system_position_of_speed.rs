//! Where a body is depends on coordinates, not on speeds.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x),
    speeds(v),
    kinematics(x = v),
    body(position = [x + v, 0, 0], rotation = rotation_z(v)),
)]
struct Scene {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    j: Vector3<f64>,
}

fn main() {}
