//! It is not said how the simulation steps.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
struct Body {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
}

fn main() {
    let kernel = Body { mass: 1.0, inertia: Vector3::new(1.0, 1.0, 1.0) }.kernel().unwrap();
    let (pose, twist) = (Isometry3::identity(), Vector6::zeros());
    let _ = Simulation::new(&kernel).run(pose, twist, 0.0..1.0);
}
