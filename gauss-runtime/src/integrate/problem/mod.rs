//! The problem that is integrated: a system in one of two forms, under an input; states, their derivatives, errors.

pub mod called_equations;
pub mod equations;
pub mod error;
pub mod form;
pub mod input;
#[cfg(feature = "alloc")]
pub mod sampled;
pub mod state;
