//! Inputs that are no functions of time and state, or that give something else.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(coordinates(x), particle(mass = mass, position = [x, 0, 0]), input(push), drive(x = push))]
struct Cart {
    mass: f64,
}

fn main() {
    let kernel = Cart { mass: 1.0 }.kernel().unwrap();
    let (q, z) = (SVector::from([0.0]), SVector::from([0.0]));
    let run = Simulation::new(&kernel).adaptive(1e-9, 1e-9);
    let _ = run.input(|_t, _q, _z| 1.0).run(q, z, 0.0..1.0);
    let _ = run.input(|_t| SVector::from([1.0])).run(q, z, 0.0..1.0);
    let _ = run.input_from(2.0).run(q, z, 0.0..1.0);
    // With types it may stand alone.
    let push = |_t: f64, _q: &_, _z: &_| SVector::from([1.0]);
    let _ = run.input(push).run(q, z, 0.0..1.0);
}
