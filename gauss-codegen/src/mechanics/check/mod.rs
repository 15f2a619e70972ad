//! Every scene against the definition (3.1).

#[cfg(test)]
pub mod definition;
pub mod dependent;
pub mod faults;
pub mod witness;
