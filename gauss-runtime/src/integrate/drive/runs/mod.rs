//! Runs from beginning to end, their samples and results.

#[cfg(feature = "alloc")]
pub mod boxed;
pub mod observer;
pub mod run;
pub mod simulation;
pub mod summary;
#[cfg(feature = "alloc")]
pub mod trajectory;
