//! Methods that are chosen when a program runs: one table of them.

pub mod control;
pub mod error;
pub mod method;
pub mod step;

#[cfg(test)]
mod tests;
