//! Kernels of [`gauss_runtime`] in other crates: in their integrators, with their scalars, in their types.
//!
//! | file | holds |
//! |---|---|
//! | [`flat`] | [`FlatSystem`]: the right-hand side, and what takes states to vectors and back |
//! | [`jacobian`] | [`JacobianProduct`]: ∂f/∂x times a vector, for implicit methods |
//! | `differential_equations` | the trait `ODE` of `differential-equations` (feature `differential-equations`) |
//! | `ode_solvers` | the trait `System` of `ode_solvers` (feature `ode_solvers`) |
//! | `diffsol` | a problem of `diffsol` (feature `diffsol`) |
//! | `dual` | the dual numbers of `num-dual` as scalars (feature `num-dual`) |
//! | `linear` | `linearize`: A and B of any system at dual numbers, such as one in contact (feature `num-dual`) |
//! | `interchange` | poses in the types of `mint` and `glam` (features `mint`, `glam030` to `glam033`) |
//!
//! The integrators of [`integrate`](gauss_runtime::integrate) keep the group, are faster, and say why they stop; these
//! are for methods that they do not have, and for programs that are built on one of those crates already. For any other
//! crate [`FlatSystem`] has all that is needed.

#![no_std]
#![forbid(unsafe_code)]
#![deny(missing_docs)]
#![cfg_attr(docsrs, feature(doc_cfg))]

extern crate alloc;
#[cfg(test)]
extern crate std;

#[cfg(feature = "num-dual")]
pub mod dual;
pub mod flat;
#[cfg(feature = "mint")]
pub mod interchange;
pub mod jacobian;
#[cfg(feature = "num-dual")]
pub mod linear;
mod ways;

#[cfg(feature = "differential-equations")]
pub mod differential_equations;
#[cfg(feature = "diffsol")]
pub mod diffsol;
#[cfg(feature = "ode_solvers")]
pub mod ode_solvers;

#[cfg(feature = "num-dual")]
pub use dual::DualNumber;
pub use flat::FlatSystem;
pub use jacobian::JacobianProduct;
#[cfg(feature = "num-dual")]
pub use linear::linearize;
pub use ways::{Differences, JacobianFunction};

/// The example of the README is a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
