//! The multiplied-out normal form of expressions, and forms in which less cancels.

pub mod cosines;
pub mod differences;
#[cfg(test)]
pub mod ideal;
pub mod polynomial;
