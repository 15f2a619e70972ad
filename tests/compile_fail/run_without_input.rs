//! The scene has an input, and the run none.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(coordinates(x), particle(mass = mass, position = [x, 0, 0]), input(push), drive(x = push))]
struct Cart {
    mass: f64,
}

fn main() {
    let kernel = Cart { mass: 1.0 }.kernel().unwrap();
    let (q, z) = (SVector::from([0.0]), SVector::from([0.0]));
    let _ = Simulation::new(&kernel).adaptive(1e-9, 1e-9).run(q, z, 0.0..1.0);
    let _ = Simulation::new(&kernel).adaptive(1e-9, 1e-9).run_to_end(q, z, 0.0..1.0);
    // Neither steps nor inputs.
    let _ = Simulation::new(&kernel).attempt(q, z, 0.0..1.0);
}
