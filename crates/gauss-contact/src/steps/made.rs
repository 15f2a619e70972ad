//! The record of a run in steps.

use alloc::vec;
use alloc::vec::Vec;
use core::fmt;
use core::ops::Deref;

use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::integrate::Sample;

use crate::error::{ContactError, ContactErrorKind};
use crate::history::{Passage, StateJump};
use crate::mode::Mode;
use crate::sensors::ContactForces;

use super::report::StepReport;
use super::stepper::ContactStepper;

/// The end of a step.
#[non_exhaustive]
pub struct StepSample<K: ContactSystem<Scalar = f64>> {
    /// The state.
    pub state: Sample<K>,
    /// The impulses of the step, row by row.
    pub impulses: K::ContactRows,
    /// The modes of the contacts in it.
    pub modes: Vec<Mode>,
    /// Report of the step, with how the laws were solved.
    pub report: StepReport,
}

// Written by hand: deriving would ask the same of the kernel, which is only named here.
impl<K: ContactSystem<Scalar = f64>> Clone for StepSample<K> {
    fn clone(&self) -> Self {
        let Self { state, impulses, modes, report } = self;
        Self { state: *state, impulses: *impulses, modes: modes.clone(), report: *report }
    }
}

impl<K: ContactSystem<Scalar = f64>> fmt::Debug for StepSample<K> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { state, impulses, modes, report } = self;
        let mut out = f.debug_struct("StepSample");
        out.field("state", state).field("impulses", impulses).field("modes", modes).field("report", report).finish()
    }
}

impl<K: ContactSystem<Scalar = f64>> StepSample<K> {
    /// The mean forces of the step, with what sensors at the contacts of the kernel measure.
    pub fn forces<'k>(&self, kernel: &'k K) -> ContactForces<'k, K> {
        ContactForces::new(kernel, self.state.t, self.state.q, self.report.mean(&self.impulses))
    }

    /// After a jump of the state, with the modes before it: a step of no length.
    pub(super) fn jumped(state: Sample<K>, modes: Vec<Mode>) -> Self {
        Self { state, impulses: K::ContactRows::zero(), modes, report: StepReport::default() }
    }

    /// After a step.
    pub(crate) fn of(stepper: &ContactStepper<'_, K>) -> Self {
        let state = state(stepper);
        let (impulses, modes) = (*stepper.impulses(), stepper.modes().into());
        Self { state, impulses, modes, report: stepper.report() }
    }
}

/// State of a stepper.
fn state<K: ContactSystem<Scalar = f64>>(stepper: &ContactStepper<'_, K>) -> Sample<K> {
    let (t, q, z) = (stepper.time(), *stepper.configuration(), *stepper.speeds());
    Sample { t, q, z, p: stepper.kernel.momentum(t, &q, &z) }
}

/// The statistics of the steps of a run with a tolerance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct StepStatistics {
    /// Steps that were kept, each made of two halves.
    pub accepted: u64,
    /// Steps that were too long.
    pub rejected: u64,
    /// Kept steps in which a contact changed what it does.
    pub changes: u64,
    /// Number of these that are off by more than the tolerance: they have the shortest length.
    pub beyond: u64,
    /// The largest estimate of the others, over the tolerance; at most 1.
    pub largest: f64,
    /// The largest estimate of those beyond it.
    pub largest_beyond: f64,
}

/// A run in steps: the ends of all steps ([`samples`](Self::samples), which it can be used as), and states and forces
/// at any time.
#[non_exhaustive]
pub struct SteppedRun<'k, K: ContactSystem<Scalar = f64>> {
    pub(crate) kernel: &'k K,
    /// The state before the first step.
    pub start: Sample<K>,
    /// The ends of the steps; of steps with a tolerance each report has the estimate of its step. Where an event makes
    /// the state jump there are two at its time: the end of a step, and the state after the jump, with no impulses.
    pub samples: Vec<StepSample<K>>,
    /// Statistics of all steps with a tolerance.
    pub statistics: StepStatistics,
    /// The states in which functions that the run was given ([`ContactSteps::event`](super::ContactSteps::event))
    /// passed through zero, in order of time, as accurate as states between the ends of steps are.
    pub passages: Vec<Passage<K>>,
    /// The jumps of the state by events that the run was given ([`ContactSteps::then`](super::ContactSteps::then)), in
    /// order of time.
    pub state_jumps: Vec<StateJump<K>>,
    /// The function that ended the run, by its number; `None` where it went on to the end of the interval.
    pub stopped_by: Option<usize>,
    /// Modes before the first step.
    open: Vec<Mode>,
}

impl<K: ContactSystem<Scalar = f64>> fmt::Debug for SteppedRun<'_, K> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { start, samples, statistics, stopped_by, .. } = self;
        let mut out = f.debug_struct("SteppedRun");
        out.field("start", start).field("samples", samples).field("statistics", statistics);
        out.field("stopped_by", stopped_by).finish_non_exhaustive()
    }
}

impl<K: ContactSystem<Scalar = f64>> Deref for SteppedRun<'_, K> {
    type Target = [StepSample<K>];

    fn deref(&self) -> &[StepSample<K>] {
        &self.samples
    }
}

impl<K: ContactSystem<Scalar = f64>> IntoIterator for SteppedRun<'_, K> {
    type Item = StepSample<K>;
    type IntoIter = vec::IntoIter<StepSample<K>>;

    fn into_iter(self) -> Self::IntoIter {
        self.samples.into_iter()
    }
}

impl<'a, K: ContactSystem<Scalar = f64>> IntoIterator for &'a SteppedRun<'_, K> {
    type Item = &'a StepSample<K>;
    type IntoIter = core::slice::Iter<'a, StepSample<K>>;

    fn into_iter(self) -> Self::IntoIter {
        self.samples.iter()
    }
}

impl<'k, K: ContactSystem<Scalar = f64>> SteppedRun<'k, K> {
    /// Before the first step.
    pub(crate) fn begun(kernel: &'k K, (t, q, z): (f64, K::Configuration, K::Speeds)) -> Self {
        let q = q.renormalise();
        let start = Sample { t, q, z, p: kernel.momentum(t, &q, &z) };
        let (samples, passages, statistics) = (Vec::new(), Vec::new(), StepStatistics::default());
        let open = vec![Mode::Open; kernel.contacts().len()];
        Self { kernel, start, samples, statistics, passages, state_jumps: Vec::new(), stopped_by: None, open }
    }

    /// The state at a time; where a step ends there, its end, where the state jumps, the one after it. Between the ends
    /// of steps it is as accurate as these are, and the gap of a closed contact, zero at both, is off by as much. In a
    /// step with an impact speeds jump at half of it, as the step itself has it: when the impact is, is not known.
    ///
    /// # Errors
    /// `OutsideRun` where the run does not cover the time.
    pub fn at(&self, t: f64) -> Result<Sample<K>, ContactError> {
        let step = self.step_at(t)?;
        let later = self.samples.partition_point(|step| step.state.t <= t);
        if let Some(last) = later.checked_sub(1).map(|last| &self.samples[last]).filter(|last| last.state.t == t) {
            return Ok(last.state);
        }
        let Some(after) = self.samples.get(step) else { return Ok(self.start) };
        Ok(between(self.kernel, self.before(step), after, t))
    }

    /// The states at some times, such as those of a table or a page.
    ///
    /// # Errors
    /// `OutsideRun` where the run does not cover one of them.
    pub fn at_times(&self, times: impl IntoIterator<Item = f64>) -> Result<Vec<Sample<K>>, ContactError> {
        times.into_iter().map(|t| self.at(t)).collect()
    }

    /// The forces at contacts at a time: the mean ones of the step that it is in, or that ends there. They act where
    /// contacts are at the time.
    ///
    /// # Errors
    /// `OutsideRun` where the run does not cover the time.
    pub fn forces(&self, t: f64) -> Result<ContactForces<'k, K>, ContactError> {
        let step = self.samples.get(self.step_at(t)?);
        let rows = step.map_or_else(K::ContactRows::zero, |step| step.report.mean(&step.impulses));
        Ok(ContactForces::new(self.kernel, t, self.at(t)?.q, rows))
    }

    /// The modes of contacts in the step that a time is in, or that ends there.
    ///
    /// # Errors
    /// `OutsideRun` where the run does not cover the time.
    pub fn modes(&self, t: f64) -> Result<&[Mode], ContactError> {
        Ok(self.samples.get(self.step_at(t)?).map_or(&self.open, |step| &step.modes))
    }

    /// The middles of all steps with an impact, where [`at`](Self::at) has speeds jump, and the times of jumps by
    /// events.
    #[must_use]
    pub fn jumps(&self) -> Vec<f64> {
        let strikes = |(_, step): &(usize, &StepSample<K>)| step.report.impacts > 0;
        let middle = |(n, step): (usize, &StepSample<K>)| half(self.before(n).t, step.state.t);
        let jumps = self.state_jumps.iter().map(|jump| jump.before.t);
        let mut times: Vec<f64> = self.samples.iter().enumerate().filter(strikes).map(middle).chain(jumps).collect();
        times.sort_by(f64::total_cmp);
        times.dedup();
        times
    }

    /// Forgets all steps but the last.
    pub(super) fn forget(&mut self) {
        if let Some(last) = self.samples.len().checked_sub(1).filter(|last| *last > 0) {
            self.start = self.samples[last - 1].state;
            self.samples.drain(..last);
        }
    }

    /// The state before a step.
    pub(super) fn before(&self, step: usize) -> &Sample<K> {
        step.checked_sub(1).and_then(|last| self.samples.get(last)).map_or(&self.start, |last| &last.state)
    }

    /// The last state.
    pub(super) fn last_state(&self) -> Sample<K> {
        *self.before(self.samples.len())
    }

    /// The number of the step that a time is in, or that ends there; of the start the first one.
    fn step_at(&self, t: f64) -> Result<usize, ContactError> {
        let last = self.samples.last().map_or(self.start.t, |step| step.state.t);
        if self.start.t <= t && t <= last {
            return Ok(self.samples.partition_point(|step| step.state.t < t));
        }
        Err(ContactError { contact: None, time: t, kind: ContactErrorKind::OutsideRun })
    }
}

/// The middle between two times.
fn half(from: f64, to: f64) -> f64 {
    from + 0.5 * (to - from)
}

/// The state within a step. Between impacts places are cubic in time by the speeds at both ends, and speeds change
/// evenly; with an impact places go half of the way with the speeds before it (J. J. Moreau), and speeds jump there.
pub(super) fn between<K: ContactSystem<Scalar = f64>>(
    kernel: &K,
    before: &Sample<K>,
    after: &StepSample<K>,
    t: f64,
) -> Sample<K> {
    let end = &after.state;
    let h = end.t - before.t;
    if t == end.t || h <= 0.0 {
        return *end;
    }
    if t == before.t {
        return *before;
    }
    let (part, whole) = ((t - before.t) / h, before.q.difference(&end.q));
    let first = kernel.kinematics(before.t, &before.q, &before.z).scale(h);
    let (way, z) = if after.report.impacts == 0 {
        let last = kernel.kinematics(end.t, &end.q, &end.z);
        let last = K::Configuration::dexp_inv(&whole, &last).scale(h);
        let (left, square) = (1.0 - part, part * part);
        let way = first.scale(part * left * left).add_scaled(square * (3.0 - 2.0 * part), &whole);
        let way = way.add_scaled(-square * left, &last);
        (way, before.z.scale(left).add_scaled(part, &end.z))
    } else if t < half(before.t, end.t) {
        (first.scale(part), before.z)
    } else {
        (first.scale(1.0 - part).add_scaled(2.0 * part - 1.0, &whole), end.z)
    };
    let q = before.q.retract(&way).renormalise();
    Sample { t, q, z, p: kernel.momentum(t, &q, &z) }
}
