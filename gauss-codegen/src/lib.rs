//! The library behind `#[derive(GaussDynamics)]`: tokens of a struct in, Rust code of its kernel out.
#![doc = include_str!("../README.md")]
#![warn(missing_docs)]

mod algebra;
mod derivation;
mod emit;
mod expand;
mod kernel;
mod lowering;
mod mechanics;
mod mistakes;
mod model;
mod translate;

pub use emit::fallback;
pub use expand::expand;
