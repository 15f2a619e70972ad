//! No fields at all.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
struct Body;

fn main() {}
