//! Events within a step: zeros of functions of the state, and jumps there.

#[cfg(feature = "alloc")]
pub mod each;
pub mod event;
pub(in crate::integrate) mod leaving;
pub mod search;
pub(in crate::integrate) mod zero;
