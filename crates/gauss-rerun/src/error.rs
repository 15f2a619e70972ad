//! Why a run is not recorded.

use std::error::Error;
use std::fmt;

use gauss_runtime::prelude::IntegrationError;
use rerun::RecordingStreamError;

/// Why a run is not recorded.
#[derive(Debug)]
#[non_exhaustive]
pub enum RecordError {
    /// A state between the samples cannot be computed.
    State(IntegrationError),
    /// No body has this name yet.
    UnknownBody(String),
    /// The error of the SDK.
    Stream(RecordingStreamError),
}

impl fmt::Display for RecordError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::State(error) => error.fmt(f),
            Self::UnknownBody(name) => write!(f, "no body is called `{name}`: `body` and `frames` name them"),
            Self::Stream(error) => write!(f, "Rerun: {error}"),
        }
    }
}

impl Error for RecordError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        match self {
            Self::State(error) => Some(error),
            Self::UnknownBody(_) => None,
            Self::Stream(error) => Some(error),
        }
    }
}

impl From<IntegrationError> for RecordError {
    fn from(error: IntegrationError) -> Self {
        Self::State(error)
    }
}

impl From<RecordingStreamError> for RecordError {
    fn from(error: RecordingStreamError) -> Self {
        Self::Stream(error)
    }
}
