//! Methods that a clause brings, called where the struct does not have it: each is told its clause.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(coordinates(x), particle(mass = mass, position = [x, 0, 0]))]
struct Cart {
    mass: f64,
}

type Numbers = SVector<f64, 1>;

fn methods(kernel: CartKernel, q: &Numbers, z: &Numbers, names: ()) {
    let _ = kernel.linearize(0.0, q, z, &());
    let _ = kernel.by_parameters(0.0, q, z, &());
    let _ = kernel.linearize_inverse(0.0, q, z, z, &());
    let _ = kernel.hessian(0.0, q, z, &(), &SVector::from([0.0, 1.0]));
    let _ = kernel.regressor(0.0, q, z, z);
    let _ = kernel.pose_of(names, 0.0, q);
    let _ = kernel.jacobian_rate_of(names, 0.0, q, z);
    let _ = kernel.center_of_mass(0.0, q);
    let _ = kernel.gravity_torques(0.0, q);
    let _ = kernel.reactions(0.0, q, z, &());
    let _ = kernel.reaction_under(names, 0.0, q, (z, z), &(), z);
    let _ = kernel.multipliers(0.0, q, z, &());
    let _ = kernel.gaps(0.0, q);
    let _ = kernel.powers(0.0, q, z, &());
    let _ = kernel.pose(0.0, q);
}

/// Of a reference the compiler tells no more than the bound, whose name is that of the clause.
fn by_reference(kernel: &CartKernel, q: &Numbers, z: &Numbers) {
    let _ = kernel.linearize(0.0, q, z, &());
}

fn bounds(kernel: &CartKernel, q: Numbers, z: Numbers) {
    let _ = Simulation::new(kernel).control(Adaptive::by(Rosenbrock, 1e-6, 1e-9)).run_to_end(q, z, 0.0..1.0);
    let _ = Simulation::new(kernel).taylor(1e-9, 1e-9).run_to_end(q, z, 0.0..1.0);
}

fn main() {}
