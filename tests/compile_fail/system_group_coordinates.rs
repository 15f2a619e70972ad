//! Kinds of coordinates and speeds, misspelt or of another language.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pos, attitude: Quaternion, x: f64),
    speeds(u: Vector3<f64>, w: Rotation, v),
    kinematics(pose = twist(u, w), x = v),
    body(position = pose.position, rotation = pose.rotation),
)]
struct Scene {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    j: Vector3<f64>,
}

fn main() {}
