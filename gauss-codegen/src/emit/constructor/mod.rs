//! `kernel()` of the user's struct: its parameters read, checked, and turned into constants.

pub mod file_values;
pub mod kernel;
pub mod laws;
pub mod locals;
pub mod mass_laws;
pub mod parameters;
