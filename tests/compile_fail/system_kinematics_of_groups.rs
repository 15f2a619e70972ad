//! Poses change by twists, rotations by angular velocities.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose, attitude: Rotation, x),
    speeds(u: Vector3, w: Vector3, v),
    kinematics(pose = u, attitude = v, x = twist(u, w)),
    body(position = pose.position, rotation = pose.rotation * attitude),
)]
struct Scene {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    j: Vector3<f64>,
}

fn main() {}
