//! The equations of motion, their constraints, and their power series.

pub mod constrained;
pub mod contact;
pub mod gauss_system;
pub mod taylor;
