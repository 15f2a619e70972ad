//! A scalar that no field shows.

use gauss_runtime::prelude::*;

type Mass = f64;
type Tensor = Matrix3<f64>;

#[derive(GaussDynamics)]
struct Body {
    #[gauss(mass)]
    mass: Mass,
    #[gauss(inertia = full)]
    inertia: Tensor,
}

fn main() {}
