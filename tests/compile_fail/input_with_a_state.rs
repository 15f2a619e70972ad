//! A control law that adds up an integral: the words are the compiler's, since closures are its own. The line of the bound
//! says what is meant; where the closure stands within the call, the compiler shows nothing but the closure.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(coordinates(x), particle(mass = mass, position = [x, 0, 0]), input(push), drive(x = push))]
struct Cart {
    mass: f64,
}

type Numbers = SVector<f64, 1>;

fn kept(kernel: &CartKernel, start: Numbers) {
    let mut integral = 0.0;
    let law = |_: f64, q: &Numbers, _: &Numbers| {
        integral += q[0];
        SVector::from([-integral])
    };
    let _ = Simulation::new(kernel).input(law);
    let _ = start;
}

fn within_the_call(kernel: &CartKernel, start: Numbers) {
    let mut integral = 0.0;
    let run = Simulation::new(kernel).adaptive(1e-9, 1e-9).input(|_, q, _| {
        integral += q[0];
        SVector::from([-integral])
    });
    let _ = run.run_to_end(start, start, 0.0..1.0);
}

fn main() {}
