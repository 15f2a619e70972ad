//! Which integrator is the cheapest for a scene: [`Tune`] measures it on the scene itself.
//!
//! | module | holds |
//! |---|---|
//! | [`measure`] | [`Tune`], an extension of [`Simulation`](gauss_runtime::integrate::Simulation); what it found, [`Tuned`] |
//! | [`method`] | [`Method`], [`EitherForm`]: methods and forms of the equations that are chosen at run time |

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod measure;
pub mod method;

pub use measure::{Candidate, Measured, Tune, TuneError, Tuned};
pub use method::{EitherForm, Method};

/// The example of the README is a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
