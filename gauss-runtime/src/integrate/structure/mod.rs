//! Methods that preserve the structure of the motion: symmetry in time, the symplectic form, momenta, the energy.

pub mod collocation;
pub mod composition;
pub mod energy_momentum;
pub mod variational;

#[cfg(all(test, feature = "alloc"))]
mod collocation_tests;
