//! Bounds of rounding are never below the true error: of each operation, of kernels on thousands of random scenes, and
//! on the reference scenes, their runs included. Truth is the same code in double-double numbers (31 digits), or exact
//! scaling where magnitudes leave their range.
//!
//! `cargo test -p gauss-tests --test bounds -- --nocapture` prints by how much bounds exceed errors.

#[path = "../common/mod.rs"]
#[macro_use]
mod common;

mod compare;
mod operations;
mod random;
mod references;
mod systems;
