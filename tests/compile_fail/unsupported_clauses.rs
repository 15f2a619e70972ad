//! Clauses of a later version, on the struct and on a field.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(coordinates(x, y, theta), potential = m * g * y)]
struct Body {
    #[gauss(body)]
    first: Matrix3<f64>,
}

fn main() {}
