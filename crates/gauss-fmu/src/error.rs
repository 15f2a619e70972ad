//! Errors that stand in the way of an FMU.

use std::fmt;
use std::io;

use gauss_jit::{KernelError, Mistakes};

/// An FMU that cannot be written. Nothing is left of it.
#[derive(Debug)]
#[non_exhaustive]
pub enum FmuError {
    /// Mistakes of the scene.
    Scene(Mistakes),
    /// Parameters that are not given, given twice, or those of no body: each with its field.
    Parameters(KernelError),
    /// A clause that FMI has no counterpart for.
    NoCounterpart(String),
    /// A start value of what is no state, or no number.
    Start(String),
    /// A name that is no identifier of C.
    Name(String),
    /// The C compiler refuses the code: a mistake of this crate.
    Compiler(String),
    /// An error of the operating system.
    Io(io::Error),
}

impl fmt::Display for FmuError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            FmuError::Scene(mistakes) => mistakes.fmt(f),
            FmuError::Parameters(error) => error.fmt(f),
            FmuError::NoCounterpart(text) | FmuError::Start(text) => f.write_str(text),
            FmuError::Name(name) => {
                write!(f, "`{name}` names no binary of an FMU: letters, digits and `_`, no digit first")
            }
            FmuError::Compiler(text) => write!(f, "the C compiler refuses the code, a mistake of Gauss: {text}"),
            FmuError::Io(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for FmuError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            FmuError::Scene(error) => Some(error),
            FmuError::Parameters(error) => Some(error),
            FmuError::Io(error) => Some(error),
            _ => None,
        }
    }
}

impl From<io::Error> for FmuError {
    fn from(error: io::Error) -> Self {
        FmuError::Io(error)
    }
}
