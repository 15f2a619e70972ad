//! Frames that are one another's parents, and a particle whose parent is a point.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x),
    frame(a, parent = b),
    frame(b, parent = a),
    point(tip, body = a, at = [1, 0, 0]),
    particle(mass = m, position = [x, 0, 0], parent = tip),
)]
struct Scene {
    m: f64,
}

fn main() {}
