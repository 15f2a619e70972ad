//! Added mass and displaced mass of a body with a name.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(
        hull, position = pose.position, rotation = pose.rotation,
        added_mass = c, displaced_mass = 2, center_of_buoyancy = l,
    ),
)]
struct Scene {
    #[gauss(body)]
    hull: RigidBody<f64>,
    l: f64,
    c: Vector3<f64>,
}

fn main() {}
