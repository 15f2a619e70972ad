//! Coordinates in a group belong to a later version.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose, x: f64),
    particle(mass = m, position = [x, 0, 0]),
)]
struct Scene {
    m: f64,
}

fn main() {}
