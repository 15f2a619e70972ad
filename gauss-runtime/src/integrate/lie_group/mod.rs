//! Methods in the algebra of the configurations: Runge–Kutta–Munthe-Kaas, commutator-free, and the derivatives of a
//! step.

pub mod commutator_free;
pub mod discrete;
pub mod rkmk;
