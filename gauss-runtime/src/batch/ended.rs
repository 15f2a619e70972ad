//! How runs of an ensemble end.

use alloc::vec::Vec;

use super::error::StateError;
use super::packs::{SingleConfiguration, SingleSpeeds};
use crate::integrate::Summary;

/// A run of an ensemble that has come to its end, in configurations Q and speeds Z of one lane; the state there is among the
/// [`States`](super::States).
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

/// How one run of an ensemble ended.
pub type HowItEnded<S> = Result<Ended<SingleConfiguration<S>, SingleSpeeds<S>>, StateError>;
