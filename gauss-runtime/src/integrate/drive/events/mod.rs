//! Events within a step: zeros of functions of the state, and jumps there.

pub(in crate::integrate) mod derivative;
#[cfg(feature = "alloc")]
pub mod each;
pub mod event;
pub(in crate::integrate) mod jump;
pub(in crate::integrate) mod leaving;
pub mod search;
pub(in crate::integrate) mod zero;
