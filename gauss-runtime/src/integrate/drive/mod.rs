//! What drives a method over an interval: the choice of steps, events, constraints, and what is kept of a run.

pub mod compensated;
pub mod control;
#[cfg(feature = "alloc")]
pub mod dense;
pub mod event;
pub(in crate::integrate) mod projection;
pub mod simulation;
pub(in crate::integrate) mod step_length;
#[cfg(feature = "alloc")]
pub mod trajectory;
