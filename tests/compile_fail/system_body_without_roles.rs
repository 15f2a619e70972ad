//! The unnamed body takes its mass data from the fields.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x),
    body(position = [x, 0, 0]),
)]
struct Scene {
    m: f64,
}

fn main() {}
