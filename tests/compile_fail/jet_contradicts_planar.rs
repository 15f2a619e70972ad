//! Three angles contradict planar motion.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(chart = jet(euler_zyx), motion = planar)]
struct Body {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
}

fn main() {}
