//! What acts beside weight and buoyancy.

pub mod accounts;
pub mod fields;
pub mod forces;
pub mod wrench;
