//! States, their increments and inputs by name.

pub mod index;
pub mod input;
pub mod record;
pub mod state;
