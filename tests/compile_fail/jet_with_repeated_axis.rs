//! Two turns in a row about one axis are one turn.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(chart = jet(euler_zzx))]
struct Body {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
}

fn main() {}
