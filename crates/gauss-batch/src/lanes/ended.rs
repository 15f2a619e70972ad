//! Ends of the runs of an ensemble.

use alloc::vec::Vec;
use core::fmt;

use gauss_runtime::integrate::drive::summary::Summary;
use gauss_runtime::integrate::problem::error::IntegrationErrorKind;

use super::system::{SingleConfiguration, SingleSpeeds};

/// A run of an ensemble that has come to its end, in configurations Q and speeds Z of one lane; the state there is
/// among the [`States`](crate::States).
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Ended<Q, Z> {
    /// The time of the last state: the end of the interval, or that of the event that ended the run.
    pub time: f64,
    /// The event that ended the run, by its number; `None` where it went on to the end of the interval.
    pub stopped_by: Option<usize>,
    /// Its steps.
    pub summary: Summary,
    /// The events that were met, in their order.
    pub events: Vec<EventState<Q, Z>>,
}

/// An event in a run of an ensemble.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct EventState<Q, Z> {
    /// The number of the event.
    pub event: usize,
    /// Time.
    pub t: f64,
    /// Configuration.
    pub q: Q,
    /// Quasi-velocities.
    pub z: Z,
}

/// Outcome of one run of an ensemble.
pub type RunOutcome<S> = Result<Ended<SingleConfiguration<S>, SingleSpeeds<S>>, RunError>;

/// A state that did not reach the end: the batch holds the last good one, at `time`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct RunError {
    /// The number of the state.
    pub state: usize,
    /// The last time that it reached.
    pub time: f64,
    /// Cause of the failure in the step from there.
    pub kind: IntegrationErrorKind,
}

impl RunError {
    /// The state of this number stopped at `time`.
    #[must_use]
    pub(crate) const fn new(state: usize, time: f64, kind: IntegrationErrorKind) -> Self {
        Self { state, time, kind }
    }
}

impl fmt::Display for RunError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "state {} stopped at t = {}: {}", self.state, self.time, self.kind)
    }
}

impl core::error::Error for RunError {}
