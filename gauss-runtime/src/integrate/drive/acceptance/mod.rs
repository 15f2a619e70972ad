//! Conditions for the acceptance of a step: its error, the constraints, and the prospect of the run.

pub mod cause;
pub mod pace;
pub mod projection;
pub mod tolerance;
