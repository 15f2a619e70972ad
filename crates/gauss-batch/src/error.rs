//! States of a batch that did not reach the end.

use alloc::vec::Vec;
use core::fmt;

use crate::lanes::RunError;

/// Some states of a batch did not reach the end; all others did.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct BatchError {
    /// Which, by their numbers; at least one.
    pub failures: Vec<RunError>,
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
