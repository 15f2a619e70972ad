//! Bodies with constant inertia: their free motion, exactly or by an integrable discretisation, and splitting methods
//! that put kicks of force between.
//!
//! | file | holds |
//! |---|---|
//! | [`inertia`] | principal axes, and the increment that a free motion makes |
//! | [`free_flow`] | [`FreeFlow`]: the exact motion over any span of time; `in_lanes`: of several bodies |
//! | [`top_flow`] | [`TopFlow`]: the same for a heavy body of revolution about a point of its axis |
//! | [`moser_veselov`] | [`MoserVeselov`]: the discrete Moser–Veselov method with its corrections to order 10 |
//! | [`scheme`] | [`Scheme`]: lengths of kicks and drifts, orders 2 to 8 |
//! | [`splitting`] | [`Splitting`]: a step for a kernel |
//! | [`configuration`](mod@configuration) | what a splitting needs to know of attitudes and poses |

#![no_std]
#![forbid(unsafe_code)]
#![deny(missing_docs)]

#[cfg(test)]
extern crate std;

pub mod configuration;
mod corrections;
mod elliptic;
pub mod free_flow;
mod in_lanes;
pub mod inertia;
pub mod moser_veselov;
pub mod scheme;
pub mod splitting;
pub mod top_flow;
mod top_orbit;

pub use configuration::{BodyConfiguration, SplittingError};
pub use free_flow::FreeFlow;
pub use inertia::{FreeMotion, PrincipalAxes, Turn};
pub use moser_veselov::MoserVeselov;
pub use scheme::Scheme;
pub use splitting::Splitting;
pub use top_flow::{TopError, TopFlow};

/// The example of the README is a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
