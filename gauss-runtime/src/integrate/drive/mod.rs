//! Runs over an interval: the choice of steps, events, constraints, and the record of a run.
//!
//! A control of your own ([`Control`](control::Control)) is made of the same parts as those of this crate: checks
//! before a run ([`control`]), errors in tolerances ([`tolerance`]), lengths of steps ([`choice`], [`step_length`]),
//! constraints ([`projection`]), and why a run cannot go on ([`cause`], [`pace`]). Runs in lanes, in the crate
//! `gauss-batch`, are such controls.
//!
//! The files are in four rooms, each of which knows those before it: `acceptance` (tolerances, constraints, causes of
//! failure), `step_control`, `events`, `runs`.

mod acceptance;
mod events;
mod runs;
mod step_control;

pub use acceptance::{cause, pace, projection, tolerance};
pub use events::{bounded, event, schedule, search};
pub(in crate::integrate) use events::{departure, jump, watched, zero};
#[cfg(feature = "alloc")]
pub use events::{each, task};
#[cfg(feature = "alloc")]
pub use runs::{RunRecord, boxed, trajectory};
pub use runs::{interval, observer, run, simulation, stepper, summary};
pub(in crate::integrate) use step_control::cubic;
pub use step_control::{adaptive, choice, compensated, control, fixed, logarithms, looks, step_length};
