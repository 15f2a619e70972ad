//! Results of an integration: samples, and the states between them.

use core::fmt;

use alloc::rc::Rc;
use alloc::vec::Vec;

use crate::integrate::drive::control::{Control, DEFAULT_LIMIT, within_step};
use crate::integrate::drive::summary::Summary;
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::error::{IntegrationError, IntegrationErrorKind};
use crate::integrate::problem::state::{Sample, State, copy_and_debug};
use crate::real::Real;
use crate::system::GaussSystem;

/// A state in which a function passed through zero: see [`Simulation::event`](crate::integrate::Simulation::event).
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(
        deny_unknown_fields,
        bound(
            serialize = "S: GaussSystem<Scalar: serde::Serialize> + crate::description::DescribedSystem",
            deserialize = "S: GaussSystem<Scalar: serde::Deserialize<'de>> + crate::description::DescribedSystem"
        )
    )
)]
#[non_exhaustive]
pub struct EventSample<S: GaussSystem> {
    /// The number of the event, counted from 0 in the order in which events were added to the simulation.
    pub number: usize,
    /// The state; where it jumps, the one before.
    pub sample: Sample<S>,
}

copy_and_debug!(EventSample { number, sample });

/// Samples in the order of integration, at least one, and by [`at`](Self::at) any state between them.
///
/// It owns the samples, and borrows the kernel and all that the input refers to.
/// [`into_samples`](Self::into_samples) and tables (crate `gauss-tables`) stand alone.
#[doc(alias = "csv")]
#[doc(alias = "table")]
#[doc(alias = "plot")]
pub struct Trajectory<'k, S: GaussSystem> {
    samples: Vec<Sample<S>>,
    events: Vec<EventSample<S>>,
    held: Vec<HeldInput<S>>,
    stopped_by: Option<usize>,
    summary: Summary,
    between: Rc<dyn SampleInterpolation<S> + 'k>,
}

impl<S: GaussSystem> Clone for Trajectory<'_, S> {
    fn clone(&self) -> Self {
        let Self { samples, events, held, stopped_by, summary, between } = self;
        Self {
            samples: samples.clone(),
            events: events.clone(),
            held: held.clone(),
            stopped_by: *stopped_by,
            summary: *summary,
            between: Rc::clone(between),
        }
    }
}

impl<S: GaussSystem> fmt::Debug for Trajectory<'_, S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.iter()).finish()
    }
}

/// From when on controllers held which input.
pub(in crate::integrate) type HeldInput<S> = (<S as GaussSystem>::Scalar, <S as GaussSystem>::Input);

/// The record of a run.
pub(in crate::integrate) struct RunData<S: GaussSystem> {
    pub(in crate::integrate) samples: Vec<Sample<S>>,
    pub(in crate::integrate) events: Vec<EventSample<S>>,
    pub(in crate::integrate) held: Vec<HeldInput<S>>,
    pub(in crate::integrate) stopped_by: Option<usize>,
    pub(in crate::integrate) summary: Summary,
}

#[allow(clippy::len_without_is_empty)] // Never empty.
impl<'k, S: GaussSystem> Trajectory<'k, S> {
    /// The samples of a run that was made by a control, with all steps or not.
    pub(in crate::integrate) fn new<P, C>(kept: RunData<S>, problem: P, control: C, every_step: bool) -> Self
    where
        P: Problem<System = S> + 'k,
        C: Control<S> + 'k,
    {
        Self::made_by(kept, Rc::new(Maker { problem, control, every_step }))
    }

    /// The samples of a run, with what makes states between them.
    pub(in crate::integrate) fn made_by(kept: RunData<S>, between: Rc<dyn SampleInterpolation<S> + 'k>) -> Self {
        let RunData { samples, events, held, stopped_by, summary } = kept;
        Self { samples, events, held, stopped_by, summary, between }
    }

    /// The events in the order in which they happened. They are states of the run by themselves; only where the state
    /// jumps, or the run ended, are they samples of the trajectory too.
    #[must_use]
    pub fn events(&self) -> &[EventSample<S>] {
        &self.events
    }

    /// The times and states of one event, by its number.
    pub fn events_of(&self, number: usize) -> impl Iterator<Item = &Sample<S>> {
        self.events.iter().filter(move |event| event.number == number).map(|event| &event.sample)
    }

    /// The event that ended the run, by its number; `None` where it went on to the end of the interval.
    #[must_use]
    pub fn stopped_by(&self) -> Option<usize> {
        self.stopped_by
    }

    /// The number of steps, and of those in which rounding was larger than the tolerance.
    #[must_use]
    pub fn summary(&self) -> &Summary {
        &self.summary
    }

    /// The number of samples, at least 1.
    #[must_use]
    pub fn len(&self) -> usize {
        self.samples.len()
    }

    /// The initial sample.
    #[must_use]
    pub fn first(&self) -> &Sample<S> {
        &self.samples[0]
    }

    /// The last sample.
    #[must_use]
    pub fn last(&self) -> &Sample<S> {
        &self.samples[self.samples.len() - 1]
    }

    /// Sample `n`, counted from 0.
    #[must_use]
    pub fn get(&self, n: usize) -> Option<&Sample<S>> {
        self.samples.get(n)
    }

    /// The samples in order.
    pub fn iter(&self) -> core::slice::Iter<'_, Sample<S>> {
        self.samples.iter()
    }

    /// The samples in order.
    #[must_use]
    pub fn samples(&self) -> &[Sample<S>] {
        &self.samples
    }

    /// The samples alone, which borrow nothing.
    #[must_use]
    pub fn into_samples(self) -> Vec<Sample<S>> {
        self.samples
    }

    /// The state at time `t`, which the method reaches from the last sample before it: by a shorter step, or where
    /// samples are several steps apart by a short run. So it has the error of the samples, whatever their distance,
    /// satisfies constraints as they do, and costs a step instead of memory. Where the state jumps at `t`, the one
    /// after it.
    ///
    /// For packs of numbers the first lane of the times decides from which sample to start.
    ///
    /// # Errors
    /// [`IntegrationErrorKind::OutsideRun`] when the run does not cover `t`; the error of the step to `t` when that
    /// step cannot be made.
    pub fn at(&self, t: S::Scalar) -> Result<Sample<S>, IntegrationError> {
        let Some(before) = self.last_before(t) else {
            return Err(self.between.refuse(self.last(), IntegrationErrorKind::OutsideRun { time: t.lane(0) }));
        };
        let from = &self.samples[before];
        // The last one has none behind it.
        if from.t == t || before + 1 == self.samples.len() {
            Ok(*from)
        } else {
            self.between.reach(from, t, &self.held)
        }
    }

    /// The states at given times, in any order: [`at`](Self::at) each of them.
    ///
    /// # Errors
    /// The error of [`at`](Self::at) for the first time whose state cannot be found.
    pub fn at_times(&self, times: impl IntoIterator<Item = S::Scalar>) -> Result<Vec<Sample<S>>, IntegrationError> {
        times.into_iter().map(|t| self.at(t)).collect()
    }

    /// The input that acted at a time of the run in a state: that of [`Simulation::input`], or what controllers that
    /// [sample](crate::integrate::Simulation::sampled) held, at an instant where that changes the one from there on.
    /// For tables and curves: `run.table().column("push", |s| run.input(s.t, &s.q, &s.z)[0])`.
    ///
    /// [`Simulation::input`]: crate::integrate::Simulation::input
    pub fn input(&self, t: S::Scalar, q: &S::Configuration, z: &S::Speeds) -> S::Input {
        self.between.input(&self.held, t, q, z)
    }

    /// Whether the input that controllers hold changes at this time.
    pub(crate) fn samples_at(&self, t: S::Scalar) -> bool {
        self.held.get(acting(&self.held, t)).is_some_and(|(since, _)| since.lane(0) == t.lane(0))
    }

    /// The number of the last sample that is not behind `t`, if the trajectory covers it.
    fn last_before(&self, t: S::Scalar) -> Option<usize> {
        let time = t.lane(0);
        let (first, last) = (self.first().t.lane(0), self.last().t.lane(0));
        let backward = last < first;
        let inside = if backward { last <= time && time <= first } else { first <= time && time <= last };
        let not_behind =
            |sample: &Sample<S>| if backward { sample.t.lane(0) >= time } else { sample.t.lane(0) <= time };
        inside.then(|| self.samples.partition_point(not_behind) - 1)
    }
}

impl<'a, S: GaussSystem> IntoIterator for &'a Trajectory<'_, S> {
    type Item = &'a Sample<S>;
    type IntoIter = core::slice::Iter<'a, Sample<S>>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

/// The computation of states between samples.
pub(in crate::integrate) trait SampleInterpolation<S: GaussSystem> {
    /// The state at a time, from the sample before it, with what controllers held in the run.
    fn reach(&self, from: &Sample<S>, t: S::Scalar, held: &[HeldInput<S>]) -> Result<Sample<S>, IntegrationError>;

    /// The input at a time in a state.
    fn input(&self, held: &[HeldInput<S>], t: S::Scalar, q: &S::Configuration, z: &S::Speeds) -> S::Input;

    /// The error for a state that cannot be found.
    fn refuse(&self, near: &Sample<S>, kind: IntegrationErrorKind) -> IntegrationError;
}

/// The problem and the control of a run, from which states between samples are made.
pub(in crate::integrate) struct Maker<P, C> {
    pub(in crate::integrate) problem: P,
    pub(in crate::integrate) control: C,
    /// Whether neighbouring samples are one step apart.
    pub(in crate::integrate) every_step: bool,
}

impl<P, C> Maker<P, C> {
    /// A step from a sample, or where samples are several steps apart a short run.
    fn step<S: GaussSystem>(&self, from: &Sample<S>, t: S::Scalar) -> Result<Sample<S>, IntegrationError>
    where
        P: Problem<System = S>,
        C: Control<S>,
    {
        let Self { problem, control, every_step } = self;
        let state = problem.state(from.t, from.q, &from.z);
        if !every_step {
            let nobody = &mut |_: &State<S>, _: &_, _| core::ops::ControlFlow::Continue(());
            return control.drive(problem, state, t, DEFAULT_LIMIT, nobody).map(|end| problem.sample(&end));
        }
        within_step(problem, control, &state, t)
    }
}

/// The number of the input that is held at a time.
fn acting<T: Real, I>(held: &[(T, I)], t: T) -> usize {
    held.partition_point(|(since, _)| since.lane(0) <= t.lane(0)).saturating_sub(1)
}

impl<S: GaussSystem, P: Problem<System = S>, C: Control<S>> SampleInterpolation<S> for Maker<P, C> {
    fn reach(&self, from: &Sample<S>, t: S::Scalar, held: &[HeldInput<S>]) -> Result<Sample<S>, IntegrationError> {
        let Some(cell) = self.problem.held() else { return self.step(from, t) };
        let mut state = *from;
        // Samples may be several instants apart.
        for (n, &(since, input)) in held.iter().enumerate().skip(acting(held, from.t)) {
            if since.lane(0) >= t.lane(0) {
                break;
            }
            let until = held.get(n + 1).map_or(t, |&(next, _)| if next.lane(0) < t.lane(0) { next } else { t });
            let before = cell.replace(input);
            let reached = self.step(&state, until);
            cell.set(before);
            state = reached?;
        }
        Ok(state)
    }

    fn input(&self, held: &[HeldInput<S>], t: S::Scalar, q: &S::Configuration, z: &S::Speeds) -> S::Input {
        match (self.problem.held(), held.get(acting(held, t))) {
            (Some(cell), Some(&(_, input))) => {
                let before = cell.replace(input);
                let acts = self.problem.input(t, q, z);
                cell.set(before);
                acts
            }
            _ => self.problem.input(t, q, z),
        }
    }

    fn refuse(&self, near: &Sample<S>, kind: IntegrationErrorKind) -> IntegrationError {
        IntegrationError::at(&self.problem, &self.problem.state(near.t, near.q, &near.z), kind)
    }
}

#[cfg(test)]
#[path = "between_tests.rs"]
mod tests;
