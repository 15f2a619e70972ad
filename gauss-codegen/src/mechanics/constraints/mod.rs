//! Constraints that coordinates and speeds do not solve by themselves, and contacts.

pub mod contact_rows;
pub mod multipliers;
