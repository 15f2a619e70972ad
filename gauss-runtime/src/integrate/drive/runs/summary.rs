//! The end of a run: its state, its steps, and the event that ended it.

use core::fmt;
use core::ops::Deref;

use crate::integrate::drive::control::StepStatistics;
use crate::integrate::problem::state::Sample;
use crate::system::GaussSystem;

/// The steps of a run in numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Summary {
    /// Steps that were made.
    pub steps: u64,
    /// Steps that were tried and rejected.
    pub rejected: u64,
    /// Steps in which rounding is larger than the tolerance: these steps are as accurate as the number type allows.
    pub rounded: u64,
    /// The largest ratio of rounding to tolerance in any step; 0 where rounding never was larger.
    pub excess: f64,
    /// Jumps at events.
    pub jumps: u64,
}

impl Summary {
    /// Counts one more step.
    pub fn count(&mut self, taken: StepStatistics) {
        self.steps += 1;
        self.rejected += u64::from(taken.rejected);
        if taken.excess > 0.0 {
            self.rounded += 1;
            self.excess = self.excess.max(taken.excess);
        }
    }
}

impl fmt::Display for Summary {
    /// `217 steps, 3 rejected; in 40 of them rounding is up to 35 times the tolerance`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { steps, rejected, rounded, excess, jumps } = *self;
        let s = |n: u64| if n == 1 { "" } else { "s" };
        write!(f, "{steps} step{}, {rejected} rejected", s(steps))?;
        if jumps > 0 {
            write!(f, ", {jumps} jump{}", s(jumps))?;
        }
        if rounded > 0 {
            write!(f, "; in {rounded} of them rounding is up to {excess:.2} times the tolerance")?;
        }
        Ok(())
    }
}

/// The end of a run: a [`Sample`], with the summary of the run and the event that ended it.
#[non_exhaustive]
pub struct End<S: GaussSystem> {
    /// The last state.
    pub sample: Sample<S>,
    /// The event that ended the run, by its number; `None` where it went on to the end of the interval.
    pub stopped_by: Option<usize>,
    /// Its steps.
    pub summary: Summary,
}

crate::integrate::problem::state::copy_and_debug!(End { sample, stopped_by, summary });

impl<S: GaussSystem> Deref for End<S> {
    type Target = Sample<S>;

    fn deref(&self) -> &Sample<S> {
        &self.sample
    }
}
