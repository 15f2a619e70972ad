//! Runs over an interval: the choice of steps, events, constraints, and the record of a run.
//!
//! A control of your own ([`Control`](control::Control)) is made of the same parts as those of this crate: checks
//! before a run ([`control`]), errors in tolerances ([`tolerance`]), lengths of steps ([`step_length`]), constraints
//! ([`projection`]), and why a run cannot go on ([`cause`], [`pace`]). Runs in lanes, in the crate `gauss-batch`, are
//! such controls.

pub mod adaptive;
#[cfg(feature = "alloc")]
pub mod boxed;
pub mod cause;
pub mod compensated;
pub mod control;
#[cfg(feature = "alloc")]
pub mod each;
pub mod event;
pub mod fixed;
pub(in crate::integrate) mod leaving;
pub mod logarithms;
pub mod observer;
pub mod pace;
pub mod projection;
pub mod run;
pub mod search;
pub mod simulation;
pub mod step_length;
pub mod summary;
pub mod tolerance;
#[cfg(feature = "alloc")]
pub mod trajectory;
pub(in crate::integrate) mod zero;
