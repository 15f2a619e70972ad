//! What a chart says already, said once more.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    chart = hybrid,
    speeds(v: Vector3, w: Vector3),
    kinematics(pose = twist(v, w)),
    body(position = [0, 0, l], rotation = rotation_z(l)),
)]
struct Body {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    j: Vector3<f64>,
    l: f64,
}

fn main() {}
