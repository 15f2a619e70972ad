//! States and inputs by name.

pub mod input;
pub mod record;
pub mod state;
