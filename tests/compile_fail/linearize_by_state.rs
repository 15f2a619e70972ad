//! What stands in the brackets of `linearize`.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(linearize(state), regressor(mass), coordinates(theta), particle(mass = m, position = [sin(theta), 0, cos(theta)]))]
struct Pendulum {
    m: f64,
}

fn main() {}
