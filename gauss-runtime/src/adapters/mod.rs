//! Kernels in integrators of other crates: a kernel, a form and an input as `ẋ = f(t, x)` on flat vectors.
//!
//! | file | holds |
//! |---|---|
//! | [`flat`] | [`FlatSystem`]: the right-hand side, and what takes states to vectors and back |
//! | [`jacobian`] | [`JacobianProduct`]: ∂f/∂x times a vector, for implicit methods |
//! | `differential_equations` | the trait `ODE` of `differential-equations` (feature `differential-equations`) |
//! | `ode_solvers` | the trait `System` of `ode_solvers` (feature `ode_solvers`) |
//! | `diffsol` | a problem of `diffsol` (feature `diffsol`) |
//!
//! The integrators of [`integrate`](crate::integrate) keep the group, are faster, and say why they stop; these are for methods
//! that they do not have, and for programs that are built on one of those crates already. For any other crate [`FlatSystem`] has
//! all that is needed.

pub mod flat;
pub mod jacobian;
mod ways;

#[cfg(feature = "differential-equations")]
pub mod differential_equations;
#[cfg(feature = "diffsol")]
pub mod diffsol;
#[cfg(feature = "ode_solvers")]
pub mod ode_solvers;

pub use flat::FlatSystem;
pub use jacobian::JacobianProduct;
pub use ways::{Differences, Given};

#[cfg(test)]
mod tests;
