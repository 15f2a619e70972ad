//! Runs from beginning to end, their samples and results.

#[cfg(feature = "alloc")]
pub mod boxed;
pub mod interval;
pub mod observer;
#[cfg(feature = "alloc")]
mod record;
pub mod run;
#[cfg(feature = "alloc")]
mod sampling;
pub mod simulation;
pub mod stepper;
pub mod summary;
#[cfg(feature = "alloc")]
pub mod trajectory;

#[cfg(feature = "alloc")]
pub use record::RunRecord;
