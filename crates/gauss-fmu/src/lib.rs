#![doc = include_str!("../README.md")]
#![deny(missing_docs)]

mod archive;
mod binary;
mod code;
mod error;
mod export;
mod tangent;
mod units;
mod variables;
mod xml;

pub use error::FmuError;
pub use export::{Fmu, Report};

/// Relative tolerance of co-simulation where an experiment gives none.
pub const TOLERANCE: f64 = 1e-8;

/// A version of FMI.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Version {
    /// FMI 2.0.
    #[default]
    Two,
    /// FMI 3.0.
    Three,
}

impl Version {
    fn number(self) -> u8 {
        match self {
            Version::Two => 2,
            Version::Three => 3,
        }
    }
}
