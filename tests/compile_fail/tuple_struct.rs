//! Fields without names.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
struct Body(f64, Vector3<f64>);

fn main() {}
