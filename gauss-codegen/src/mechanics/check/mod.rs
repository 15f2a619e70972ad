//! Every scene against the definition (3.1).

mod agreement;
#[cfg(test)]
pub mod definition;
pub mod dependent;
pub mod faults;
pub mod let_go;
mod pushed;
pub mod witness;
