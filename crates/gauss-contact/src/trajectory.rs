//! Trajectory of a run with contacts.

use alloc::rc::Rc;
use alloc::vec::Vec;

use gauss_runtime::contact::ContactSystem;
use gauss_runtime::integrate::{IntegrationErrorKind, Sample, Trajectory};
use gauss_runtime::real::Real;

use crate::dense::value;
use crate::error::{ContactError, ContactErrorKind};
use crate::history::{ContactEvent, Passage, SampledGap, SolveRecord, StateJump};
use crate::mode::{InMode, Mode};
use crate::sensors::ContactForces;

/// The input as a function of time and state.
pub(crate) type InputOf<'k, K> = Rc<
    dyn Fn(
            <K as gauss_runtime::system::GaussSystem>::Scalar,
            &<K as gauss_runtime::system::GaussSystem>::Configuration,
            &<K as gauss_runtime::system::GaussSystem>::Speeds,
        ) -> <K as gauss_runtime::system::GaussSystem>::Input
        + 'k,
>;

/// A part of a run between two events, in which all contacts keep their modes.
pub struct Segment<'k, K: ContactSystem> {
    pub(crate) system: InMode<'k, K>,
    pub(crate) trajectory: Trajectory<'k, InMode<'k, K>>,
}

impl<'k, K: ContactSystem> Segment<'k, K> {
    /// The modes of the contacts.
    #[must_use]
    pub fn modes(&self) -> &[Mode<K::Scalar>] {
        self.system.modes()
    }

    /// The motion: states and, by [`at`](Trajectory::at), those between them.
    #[must_use]
    pub fn trajectory(&self) -> &Trajectory<'k, InMode<'k, K>> {
        &self.trajectory
    }
}

/// A run with contacts: segments between events, and what happened at the events.
///
/// Consecutive segments share a time: the first ends in the state before the event, the next one starts in that after
/// it.
pub struct ContactTrajectory<'k, K: ContactSystem> {
    pub(crate) segments: Vec<Segment<'k, K>>,
    pub(crate) events: Vec<ContactEvent>,
    pub(crate) solves: Vec<SolveRecord>,
    pub(crate) sampled: Vec<SampledGap>,
    pub(crate) passages: Vec<Passage<K>>,
    pub(crate) state_jumps: Vec<StateJump<K>>,
    pub(crate) stopped_by: Option<usize>,
    pub(crate) input: InputOf<'k, K>,
}

fn sample<K: ContactSystem>(sample: &Sample<InMode<'_, K>>) -> Sample<K> {
    let Sample { t, q, z, p } = *sample;
    Sample { t, q, z, p }
}

impl<'k, K: ContactSystem> ContactTrajectory<'k, K> {
    /// Before the first segment.
    pub(crate) fn begun(input: InputOf<'k, K>) -> Self {
        let (segments, events, solves, sampled) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        let (passages, state_jumps) = (Vec::new(), Vec::new());
        Self { segments, events, solves, sampled, passages, state_jumps, stopped_by: None, input }
    }

    /// Keeps the times in which gaps were sampled alone, up to the end of a segment.
    pub(crate) fn keep_sampled(&mut self, sampled: &[SampledGap], end: f64) {
        for &gap in sampled.iter().filter(|gap| gap.start < end) {
            let gap = SampledGap { end: gap.end.min(end), ..gap };
            match self.sampled.iter_mut().rev().find(|last| last.contact == gap.contact) {
                Some(last) if last.end == gap.start => last.end = gap.end,
                _ => self.sampled.push(gap),
            }
        }
    }

    /// The segments in order; none where the run ended before its first step.
    #[must_use]
    pub fn segments(&self) -> &[Segment<'k, K>] {
        &self.segments
    }

    /// The history of the contacts, in order of time.
    #[must_use]
    pub fn events(&self) -> &[ContactEvent] {
        &self.events
    }

    /// The time of an event with its derivatives, where numbers carry any: [`ContactEvent::time`] is its value.
    #[must_use]
    pub fn time_of(&self, event: &ContactEvent) -> K::Scalar {
        let ends = |segment: &Segment<'k, K>| [segment.trajectory.first().t, segment.trajectory.last().t];
        let times = self.segments.iter().flat_map(ends);
        let found = times.into_iter().find(|t| value(*t) == event.time);
        found.unwrap_or_else(|| K::Scalar::from_f64(event.time))
    }

    /// The states in which functions that the run was given ([`ContactRun::event`](crate::ContactRun::event)) passed
    /// through zero, in order of time.
    #[must_use]
    pub fn passages(&self) -> &[Passage<K>] {
        &self.passages
    }

    /// The jumps of the state by events that the run was given ([`ContactRun::then`](crate::ContactRun::then)), in
    /// order of time.
    #[must_use]
    pub fn state_jumps(&self) -> &[StateJump<K>] {
        &self.state_jumps
    }

    /// The function that ended the run ([`ContactRun::until`](crate::ContactRun::until)), by its number; `None` where
    /// it went on to the end of the interval.
    #[must_use]
    pub fn stopped_by(&self) -> Option<usize> {
        self.stopped_by
    }

    /// The times in which a gap was looked at by samples alone: all of the run where it depends on the time itself. In
    /// all others no first touch is missed, whatever steps there were: the gap was larger than what bounds of its rate
    /// allow it to fall by, or smooth between the ends of some 128th of a step.
    #[must_use]
    pub fn sampled_gaps(&self) -> &[SampledGap] {
        &self.sampled
    }

    /// The residuals of every solution of the laws, in order of time.
    #[must_use]
    pub fn solves(&self) -> &[SolveRecord] {
        &self.solves
    }

    /// The last sample; `None` where the run ended before its first step.
    #[must_use]
    pub fn last(&self) -> Option<Sample<K>> {
        self.segments.last().map(|segment| sample(segment.trajectory.last()))
    }

    /// The samples of all segments in order: two at the time of an event.
    pub fn iter(&self) -> impl Iterator<Item = Sample<K>> {
        self.segments.iter().flat_map(|segment| segment.trajectory.iter().map(sample))
    }

    /// The state at a time, as accurate as the samples; at an event, the one after it.
    ///
    /// # Errors
    /// Where the run does not cover the time.
    pub fn at(&self, t: K::Scalar) -> Result<Sample<K>, ContactError> {
        self.segment_at(t)?.trajectory.at(t).map(|state| sample(&state)).map_err(|error| integration(value(t), error))
    }

    /// The states at some times, such as those of a table or a page.
    ///
    /// # Errors
    /// Where the run does not cover one of them.
    pub fn at_times(&self, times: impl IntoIterator<Item = K::Scalar>) -> Result<Vec<Sample<K>>, ContactError> {
        times.into_iter().map(|t| self.at(t)).collect()
    }

    /// The forces at contacts at a time, with what sensors there measure: rows, vectors, the wrench on a body, the
    /// centre of pressure. Where contacts depend on one another they are those of least `Σ D_ii λ_i²`, or, where these
    /// break a law that others keep, those that keep the laws with the most to spare; the motion is the same for all.
    ///
    /// # Errors
    /// Where the run does not cover the time.
    pub fn forces(&self, t: K::Scalar) -> Result<ContactForces<'k, K>, ContactError> {
        let segment = self.segment_at(t)?;
        let state = segment.trajectory.at(t).map_err(|error| integration(value(t), error))?;
        let input = (self.input)(t, &state.q, &state.z);
        Ok(segment.system.contact_forces(t, &state.q, &state.z, &input))
    }

    /// The modes of the contacts at a time; at an event, those after it.
    ///
    /// # Errors
    /// Where the run does not cover the time.
    pub fn modes(&self, t: K::Scalar) -> Result<&[Mode<K::Scalar>], ContactError> {
        self.segment_at(t).map(Segment::modes)
    }

    fn segment_at(&self, t: K::Scalar) -> Result<&Segment<'k, K>, ContactError> {
        let time = value(t);
        let behind = self.segments.partition_point(|segment| value(segment.trajectory.first().t) <= time);
        let found = behind.checked_sub(1).map(|n| &self.segments[n]);
        found.filter(|segment| time <= value(segment.trajectory.last().t)).ok_or(ContactError {
            contact: None,
            time,
            kind: ContactErrorKind::OutsideRun,
        })
    }
}

pub(crate) fn integration(time: f64, error: gauss_runtime::integrate::IntegrationError) -> ContactError {
    let kind = match error.kind {
        IntegrationErrorKind::OutsideRun { .. } => ContactErrorKind::OutsideRun,
        _ => ContactErrorKind::Integration(error),
    };
    ContactError { contact: None, time, kind }
}
