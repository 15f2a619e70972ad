//! What a run with contacts hands out.

use alloc::rc::Rc;
use alloc::vec::Vec;

use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::integrate::{IntegrationErrorKind, Sample, Trajectory};

use crate::dense::value;
use crate::error::{ContactError, ContactErrorKind};
use crate::history::{ContactEvent, SolveRecord};
use crate::mode::{InMode, Mode};
use crate::sensors::{ContactForce, ContactForces};

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
    pub(crate) input: InputOf<'k, K>,
}

fn sample<K: ContactSystem>(sample: &Sample<InMode<'_, K>>) -> Sample<K> {
    let Sample { t, q, z, p } = *sample;
    Sample { t, q, z, p }
}

impl<'k, K: ContactSystem> ContactTrajectory<'k, K> {
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

    /// The contact forces at a time, all rows: normal, then tangents, then the spin, contact by contact; of dry
    /// friction and rolling resistance tangents alone. Where contacts depend on one another they are those of least
    /// `Σ D_ii λ_i²`; the motion is the same for all others.
    ///
    /// # Errors
    /// Where the run does not cover the time.
    pub fn forces(&self, t: K::Scalar) -> Result<K::ContactRows, ContactError> {
        let segment = self.segment_at(t)?;
        let state = segment.trajectory.at(t).map_err(|error| integration(value(t), error))?;
        let input = (self.input)(t, &state.q, &state.z);
        let loads = segment.system.loads(t, &state.q, &state.z, &input);
        let mut forces = K::ContactRows::zero();
        loads.forces.iter().enumerate().for_each(|(row, force)| forces.set_component(row, *force));
        Ok(forces)
    }

    /// The contact forces at a time as vectors: of each closed contact whose place is known
    /// ([`contact_frame`](ContactSystem::contact_frame)) its number, where it is, and the force on its first body
    /// there, along the observer's axes.
    ///
    /// # Errors
    /// Where the run does not cover the time.
    pub fn force_vectors(&self, t: K::Scalar) -> Result<Vec<ContactForce<K::Scalar>>, ContactError> {
        let (sensors, modes) = (self.sensors(t)?, self.modes(t)?);
        let closed = modes.iter().enumerate().filter(|(_, mode)| mode.is_closed());
        Ok(closed.filter_map(|(contact, _)| sensors.in_world(contact).ok()).collect())
    }

    /// What sensors at the contacts measure at a time: forces, the wrench on a body, the centre of pressure.
    ///
    /// # Errors
    /// Where the run does not cover the time.
    pub fn sensors(&self, t: K::Scalar) -> Result<ContactForces<'k, K>, ContactError> {
        Ok(ContactForces::new(self.segment_at(t)?.system.kernel, t, self.at(t)?.q, self.forces(t)?))
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
