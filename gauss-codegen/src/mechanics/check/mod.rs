//! Every scene against the definition (3.1).

mod agreement;
mod contact_forces;
#[cfg(test)]
pub mod definition;
pub mod dependent;
pub mod faults;
pub mod reactions;
pub mod witness;
