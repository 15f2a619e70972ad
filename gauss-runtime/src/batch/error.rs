//! States of a batch that did not reach the end.

use alloc::vec::Vec;
use core::fmt;

use crate::integrate::IntegrationErrorKind;

/// A state that did not reach the end: the batch holds the last good one, at `time`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct StateError {
    /// The number of the state.
    pub state: usize,
    /// The last time that it reached.
    pub time: f64,
    /// What went wrong in the step from there.
    pub kind: IntegrationErrorKind,
}

impl fmt::Display for StateError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "state {} stopped at t = {}: {}", self.state, self.time, self.kind)
    }
}

impl core::error::Error for StateError {}

/// Some states of a batch did not reach the end; all others did.
#[derive(Clone, Debug, PartialEq)]
pub struct BatchError {
    /// Which, by their numbers; at least one.
    pub failures: Vec<StateError>,
}

impl fmt::Display for BatchError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut failures = self.failures.iter();
        if let Some(first) = failures.next() {
            first.fmt(f)?;
        }
        match failures.len() {
            0 => Ok(()),
            1 => f.write_str("; and one more"),
            others => write!(f, "; and {others} more"),
        }
    }
}

impl core::error::Error for BatchError {}
