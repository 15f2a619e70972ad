//! Which integrator is the cheapest for a scene: [`Tune`] measures it on the scene itself.
//!
//! | module | holds |
//! |---|---|
//! | [`measure`] | [`Tune`], an extension of [`Simulation`](gauss_runtime::integrate::Simulation) |
//! | [`tuned`] | [`Tuned`], what it found; [`Candidate`], [`Measured`], [`TuneError`] |
//! | [`method`] | [`Method`], [`EitherForm`]: methods and forms of the equations that are chosen at run time |

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod measure;
pub mod method;
pub mod tuned;

/// [`Tune`] is for simulations alone, so that functions can be added to it.
mod sealed {
    pub trait Sealed {}

    impl<P, C, O, E> Sealed for gauss_runtime::integrate::Simulation<P, C, O, E> {}
}

pub use measure::Tune;
pub use method::{EitherForm, Method};
pub use tuned::{Candidate, Measured, TuneError, Tuned};

/// The example of the README is a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
