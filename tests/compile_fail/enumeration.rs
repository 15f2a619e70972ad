//! An enum has no parameters.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
enum Body {
    Heavy,
    Light,
}

fn main() {}
