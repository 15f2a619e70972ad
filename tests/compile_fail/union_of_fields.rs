//! A union has no parameters.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
union Body {
    mass: f64,
    weight: f64,
}

fn main() {}
