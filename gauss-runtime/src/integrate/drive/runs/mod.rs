//! Runs from beginning to end, their samples and results.

#[cfg(feature = "alloc")]
pub mod boxed;
pub(in crate::integrate) mod interval;
pub mod observer;
pub mod run;
#[cfg(feature = "alloc")]
mod sampling;
pub mod simulation;
pub mod summary;
#[cfg(feature = "alloc")]
pub mod trajectory;
