//! Errors of a playback.

use std::error::Error;
use std::{fmt, io};

/// Why there is no page: every mistake that was made on the way to it.
#[derive(Debug)]
#[non_exhaustive]
pub enum PlaybackError {
    /// Names that no body has, or that two have; points that are not finite. One sentence each.
    Mistakes(Vec<String>),
    /// The file cannot be written.
    Io(io::Error),
}

impl fmt::Display for PlaybackError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            PlaybackError::Mistakes(all) => f.write_str(&all.join("; ")),
            PlaybackError::Io(error) => write!(f, "the page cannot be written: {error}"),
        }
    }
}

impl Error for PlaybackError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        match self {
            PlaybackError::Mistakes(_) => None,
            PlaybackError::Io(error) => Some(error),
        }
    }
}

impl From<io::Error> for PlaybackError {
    fn from(error: io::Error) -> Self {
        PlaybackError::Io(error)
    }
}
