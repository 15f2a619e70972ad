//! What acts, without anything that has mass.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(force(at = [0, 0, 0], value = [k, 0, 0]))]
struct Scene {
    k: f64,
}

fn main() {}
