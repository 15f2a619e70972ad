//! The only body, spoken of without a name.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(a),
    body(rotation = rotation_z(a)),
    point(tip, body = body, at = [1, 0, 0]),
    potential = body.position.z,
)]
struct Scene {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    j: Vector3<f64>,
}

fn main() {}
