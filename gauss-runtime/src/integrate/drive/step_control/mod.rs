//! Control of the lengths of steps: fixed, adaptive, with compensated rounding.

pub mod adaptive;
pub mod choice;
pub mod compensated;
pub mod control;
pub(in crate::integrate) mod cubic;
pub mod fixed;
pub mod logarithms;
pub mod looks;
pub mod step_length;
