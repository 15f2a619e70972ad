//! Runs over an interval: the choice of steps, events, constraints, and the record of a run.

pub mod adaptive;
#[cfg(feature = "alloc")]
pub mod boxed;
pub(in crate::integrate) mod cause;
pub mod compensated;
pub mod control;
pub mod event;
pub mod fixed;
pub(in crate::integrate) mod leaving;
pub(in crate::integrate) mod logarithms;
pub mod observer;
pub(in crate::integrate) mod pace;
pub(crate) mod projection;
pub(in crate::integrate) mod run;
pub mod search;
pub mod simulation;
pub(in crate::integrate) mod step_length;
pub mod summary;
pub(in crate::integrate) mod tolerance;
#[cfg(feature = "alloc")]
pub mod trajectory;
pub(in crate::integrate) mod zero;
