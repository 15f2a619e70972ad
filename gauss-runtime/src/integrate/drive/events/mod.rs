//! Events within a step: zeros of functions of the state, and jumps there.

pub mod bounded;
pub(in crate::integrate) mod departure;
pub(in crate::integrate) mod derivative;
#[cfg(feature = "alloc")]
pub mod each;
pub mod event;
pub(in crate::integrate) mod jump;
pub mod schedule;
pub mod search;
#[cfg(feature = "alloc")]
pub mod task;
pub(in crate::integrate) mod watched;
pub(in crate::integrate) mod zero;
