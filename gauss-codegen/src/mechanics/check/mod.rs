//! Every scene against the definition (3.1).

#[cfg(test)]
pub mod definition;
pub mod witness;
