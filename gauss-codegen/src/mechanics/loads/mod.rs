//! Loads other than weight and buoyancy.

pub mod account;
pub mod fields;
pub mod forces;
pub mod motion_symbols;
pub mod wrench;
