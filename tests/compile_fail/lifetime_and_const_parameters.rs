//! Parameters that a kernel cannot carry over.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
struct Body<'a, T, const N: usize> {
    #[gauss(mass)]
    mass: T,
    #[gauss(inertia)]
    inertia: T,
    stations: &'a [T; N],
}

fn main() {}
