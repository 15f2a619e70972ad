//! What coordinates and speeds do not solve by themselves.

pub mod constraint;
pub mod elimination;
pub mod multipliers;
