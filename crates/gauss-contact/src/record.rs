//! One record of runs with contacts, from which tables, pages and plots are made.

use alloc::vec::Vec;

use gauss_runtime::contact::ContactSystem;
use gauss_runtime::integrate::{RunRecord, Sample};

use crate::changeover::{ChangingTrajectory, RunPart};
use crate::dense::value;
use crate::error::{ContactError, ContactErrorKind};
use crate::history::{Passage, StateJump};
use crate::mode::Mode;
use crate::sensors::ContactForces;
use crate::steps::SteppedRun;
use crate::trajectory::ContactTrajectory;

/// The record of a run with contacts, from event to event ([`ContactTrajectory`]), in steps ([`SteppedRun`]) or both
/// ([`ChangingTrajectory`]): states in order and between them ([`RunRecord`]), with what contacts did.
pub trait ContactRecord<'k, K: ContactSystem>: RunRecord<K, Error = ContactError> {
    /// The forces at contacts at a time: rows, vectors, wrenches, centres of pressure. In a step they are the mean ones
    /// over it.
    ///
    /// # Errors
    /// Where the run does not cover the time.
    fn forces(&self, t: K::Scalar) -> Result<ContactForces<'k, K>, ContactError>;

    /// The modes of contacts at a time; at an event, those after it.
    ///
    /// # Errors
    /// Where the run does not cover the time.
    fn modes(&self, t: K::Scalar) -> Result<&[Mode<K::Scalar>], ContactError>;

    /// The states in which functions that the run was given passed through zero, in order of time.
    fn passages(&self) -> Vec<Passage<K>>;

    /// The jumps of the state by events that the run was given, in order of time.
    fn state_jumps(&self) -> Vec<StateJump<K>>;

    /// The function that ended the run, by its number; `None` where it went on to the end of the interval.
    fn stopped_by(&self) -> Option<usize>;
}

impl<K: ContactSystem> RunRecord<K> for ContactTrajectory<'_, K> {
    type Error = ContactError;

    fn states(&self) -> Vec<Sample<K>> {
        self.iter().collect()
    }

    fn span(&self) -> Option<(K::Scalar, K::Scalar)> {
        let (first, last) = (self.segments().first()?, self.segments().last()?);
        Some((first.trajectory().first().t, last.trajectory().last().t))
    }

    fn state_at(&self, t: K::Scalar) -> Result<Sample<K>, ContactError> {
        self.at(t)
    }

    fn jumps(&self) -> Vec<f64> {
        let jumps = self.state_jumps().iter().map(|jump| value(jump.before.t));
        let mut times: Vec<f64> = self.events().iter().map(|event| event.time).chain(jumps).collect();
        times.sort_by(f64::total_cmp);
        times.dedup();
        times
    }
}

impl<'k, K: ContactSystem> ContactRecord<'k, K> for ContactTrajectory<'k, K> {
    fn forces(&self, t: K::Scalar) -> Result<ContactForces<'k, K>, ContactError> {
        Self::forces(self, t)
    }

    fn modes(&self, t: K::Scalar) -> Result<&[Mode<K::Scalar>], ContactError> {
        Self::modes(self, t)
    }

    fn passages(&self) -> Vec<Passage<K>> {
        Self::passages(self).to_vec()
    }

    fn state_jumps(&self) -> Vec<StateJump<K>> {
        Self::state_jumps(self).to_vec()
    }

    fn stopped_by(&self) -> Option<usize> {
        Self::stopped_by(self)
    }
}

impl<K: ContactSystem<Scalar = f64>> RunRecord<K> for SteppedRun<'_, K> {
    type Error = ContactError;

    fn states(&self) -> Vec<Sample<K>> {
        core::iter::once(self.start).chain(self.samples.iter().map(|step| step.state)).collect()
    }

    fn span(&self) -> Option<(f64, f64)> {
        Some((self.start.t, self.samples.last().map_or(self.start.t, |step| step.state.t)))
    }

    fn state_at(&self, t: f64) -> Result<Sample<K>, ContactError> {
        self.at(t)
    }

    fn jumps(&self) -> Vec<f64> {
        Self::jumps(self)
    }
}

impl<'k, K: ContactSystem<Scalar = f64>> ContactRecord<'k, K> for SteppedRun<'k, K> {
    fn forces(&self, t: f64) -> Result<ContactForces<'k, K>, ContactError> {
        Self::forces(self, t)
    }

    fn modes(&self, t: f64) -> Result<&[Mode], ContactError> {
        Self::modes(self, t)
    }

    fn passages(&self) -> Vec<Passage<K>> {
        self.passages.clone()
    }

    fn state_jumps(&self) -> Vec<StateJump<K>> {
        self.state_jumps.clone()
    }

    fn stopped_by(&self) -> Option<usize> {
        self.stopped_by
    }
}

impl<'k, K: ContactSystem<Scalar = f64>> ChangingTrajectory<'k, K> {
    /// The part that covers a time; where two do, the later one.
    fn part_at(&self, t: f64) -> Result<&dyn ContactRecord<'k, K>, ContactError> {
        let covers = |part: &&RunPart<'k, K>| {
            part.record().span().is_some_and(|(first, last)| value(first) <= t && t <= value(last))
        };
        let found = self.parts().iter().rev().find(covers).map(RunPart::record);
        found.ok_or(ContactError { contact: None, time: t, kind: ContactErrorKind::OutsideRun })
    }
}

impl<'k, K: ContactSystem<Scalar = f64>> RunPart<'k, K> {
    /// The part as a record.
    #[must_use]
    pub fn record(&self) -> &dyn ContactRecord<'k, K> {
        match self {
            Self::Events(part) => &part.trajectory,
            Self::Steps(part) => &part.samples,
        }
    }
}

impl<K: ContactSystem<Scalar = f64>> RunRecord<K> for ChangingTrajectory<'_, K> {
    type Error = ContactError;

    fn states(&self) -> Vec<Sample<K>> {
        self.parts().iter().flat_map(|part| part.record().states()).collect()
    }

    fn span(&self) -> Option<(f64, f64)> {
        let [first, last] = [self.parts().first()?, self.parts().last()?].map(|part| part.record().span());
        Some((first?.0, last?.1))
    }

    fn state_at(&self, t: f64) -> Result<Sample<K>, ContactError> {
        self.part_at(t)?.state_at(t)
    }

    fn jumps(&self) -> Vec<f64> {
        self.parts().iter().flat_map(|part| part.record().jumps()).collect()
    }
}

impl<'k, K: ContactSystem<Scalar = f64>> ContactRecord<'k, K> for ChangingTrajectory<'k, K> {
    fn forces(&self, t: f64) -> Result<ContactForces<'k, K>, ContactError> {
        self.part_at(t)?.forces(t)
    }

    fn modes(&self, t: f64) -> Result<&[Mode], ContactError> {
        self.part_at(t)?.modes(t)
    }

    fn passages(&self) -> Vec<Passage<K>> {
        self.parts().iter().flat_map(|part| part.record().passages()).collect()
    }

    fn state_jumps(&self) -> Vec<StateJump<K>> {
        self.parts().iter().flat_map(|part| part.record().state_jumps()).collect()
    }

    fn stopped_by(&self) -> Option<usize> {
        self.parts().last().and_then(|part| part.record().stopped_by())
    }
}
