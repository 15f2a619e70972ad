//! Why a run has no derivatives.

use std::error::Error;
use std::fmt;

use gauss_runtime::error::ParameterError;
use gauss_runtime::integrate::IntegrationError;

/// Why a run has no derivatives.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum SensitivityError {
    /// No body has these numbers.
    Parameters(ParameterError),
    /// The run does not reach its end.
    Run(IntegrationError),
    /// The instants of the run are fewer than two, not finite, or not in order.
    Instants {
        /// The first one that is at fault, by its number; how many there are where these are too few.
        number: usize,
    },
    /// The run comes to its event, whose time has no derivative: its function touches zero, jumps over it, or the run
    /// starts there.
    NoDerivative {
        /// The time.
        time: f64,
        /// The rate of the function there, per unit of time.
        rate: f64,
    },
    /// The run is as it should be, and a derivative of it, or a cost, is not a number: a root at zero, or what was
    /// made of numbers on another thread.
    NonFinite {
        /// The time up to which there is no such.
        time: f64,
    },
    /// Gradients are sought within a gradient: a cost, or an input, asks for one.
    Nested,
}

impl fmt::Display for SensitivityError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Parameters(error) => error.fmt(f),
            Self::Run(error) => error.fmt(f),
            Self::Instants { number } => write!(
                f,
                "the instant with number {number} is missing, not finite, or not behind the one before it as the others \
                 are: a run has at least two, its start and its end"
            ),
            Self::NoDerivative { time, rate } => write!(
                f,
                "at t = {time} the function of the event passes through zero at the rate {rate:e}: it touches zero, jumps \
                 over it or is zero at the start, and the time of the event has no derivative"
            ),
            Self::NonFinite { time } => {
                write!(f, "a derivative or a cost is infinite or undefined behind t = {time}: is there a root at zero?")
            }
            Self::Nested => f.write_str("a gradient within a gradient: what a run is made of must not ask for one"),
        }
    }
}

impl Error for SensitivityError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        match self {
            Self::Parameters(error) => Some(error),
            Self::Run(error) => Some(error),
            _ => None,
        }
    }
}

impl From<ParameterError> for SensitivityError {
    fn from(error: ParameterError) -> Self {
        Self::Parameters(error)
    }
}

impl From<IntegrationError> for SensitivityError {
    fn from(error: IntegrationError) -> Self {
        Self::Run(error)
    }
}

/// A run of several that has no derivatives.
#[derive(Clone, Debug, PartialEq)]
pub struct EnsembleError {
    /// Its number, from 0: the first one of them.
    pub run: usize,
    /// Why.
    pub error: SensitivityError,
}

impl fmt::Display for EnsembleError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "run {}: {}", self.run, self.error)
    }
}

impl Error for EnsembleError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        Some(&self.error)
    }
}
