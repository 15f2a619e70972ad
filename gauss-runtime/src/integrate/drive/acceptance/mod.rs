//! What a step is held to: its error, the constraints, and the prospect of the run.

pub mod cause;
pub mod pace;
pub mod projection;
pub mod tolerance;
