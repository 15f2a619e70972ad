//! Controllers that sample, as a run sees them.

use crate::integrate::problem::error::SamplingMistake;
use crate::integrate::problem::state::Sample;
use crate::system::GaussSystem;

/// A controller with its instants. Times are compared in the first lane.
pub trait Scheduled<S: GaussSystem> {
    /// Before a run from a time.
    ///
    /// # Errors
    /// [`SamplingMistake::Period`], [`SamplingMistake::Delay`].
    fn begin(&mut self, start: S::Scalar) -> Result<(), SamplingMistake>;

    /// The time between two samples.
    fn period(&self) -> f64;

    /// Samples a state, if it is an instant, and lets act what is to act there.
    ///
    /// # Errors
    /// [`SamplingMistake::Input`].
    fn tick(&mut self, now: &Sample<S>) -> Result<(), SamplingMistake>;

    /// When it samples, or another of its inputs acts, next.
    fn next(&self) -> S::Scalar;

    /// Returns the input that acts, added to the inputs that others hold.
    fn added_to(&self, others: Option<S::Input>) -> S::Input;
}
