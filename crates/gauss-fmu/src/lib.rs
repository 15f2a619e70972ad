#![doc = include_str!("../README.md")]
#![deny(missing_docs)]

// `export` (what is refused, what is written where), `variables` (names, units, roles), `xml`, `code` (sizes, tables
// and functions in C of one scene), `units`, `binary` (the C compiler), `archive`. In `c`, C that every FMU has: `fmu`
// includes all others, `checks` (what `kernel()` checks), `contacts`, `motion` (rates, outputs, derivatives),
// `variables` (values by reference, and the life of an instance), `steps` (co-simulation), `fmi2` and `fmi3` (the
// functions of each version).
mod archive;
mod binary;
mod code;
mod error;
mod export;
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
