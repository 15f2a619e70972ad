//! Events at the contacts of a run.

use core::fmt;

use gauss_runtime::contact::ContactSystem;
use gauss_runtime::integrate::Sample;

use crate::mode::InMode;
use crate::residual::Residual;

/// A change of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct ContactEvent {
    /// When.
    pub time: f64,
    /// The contact, by its place in [`ContactSystem::contacts`].
    pub contact: usize,
    /// Its name in the scene.
    pub name: &'static str,
    /// Kind of the event.
    pub kind: EventKind,
}

/// Kinds of events at a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum EventKind {
    /// Velocities jump.
    Impact(ImpactRecord),
    /// The gap closes without an impact, or after one without restitution.
    Closes,
    /// The gap closes for good: infinitely many impacts that were to come are left out.
    Rests {
        /// The rate of the gap that was taken away.
        speed: f64,
        /// Height of the first flight that was left out.
        height: f64,
        /// Time that all of them would have taken.
        remaining: f64,
    },
    /// The gap opens.
    Leaves,
    /// The slip ends.
    Sticks,
    /// The slip begins, in this direction along the tangents and, with friction of drilling, of the spin.
    Slides([f64; 3]),
    /// The slip turns round at once.
    Reverses([f64; 3]),
}

/// An impact at one contact. Entries are along the normal, then along the tangents, and of the spin with friction of
/// drilling; of rolling resistance the first is 0.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct ImpactRecord {
    /// Rates before.
    pub before: [f64; 4],
    /// Rates after.
    pub after: [f64; 4],
    /// The impulse.
    pub impulse: [f64; 4],
    /// The kinetic energy that it takes away: −Λ·(u⁺ + u⁻)/2, of which the sum over simultaneous ones is the loss.
    pub energy_lost: f64,
}

/// A time in which an open gap was looked at by samples of each step alone, a 128th of it apart or less: it was so near
/// to zero, or its rate so large, that no bound excludes that it closed and opened again between two of them, and it
/// was not smooth there.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct SampledGap {
    /// The contact, by its place in [`ContactSystem::contacts`].
    pub contact: usize,
    /// From when on.
    pub start: f64,
    /// Until when.
    pub end: f64,
}

/// A state in which a function that the run was given passed through zero: see
/// [`ContactRun::event`](crate::ContactRun::event).
#[non_exhaustive]
pub struct Passage<K: ContactSystem> {
    /// The number of the event, counted from 0 in the order in which events were added to the run.
    pub number: usize,
    /// The state; where an impact leads over zero, the one after it.
    pub sample: Sample<K>,
}

impl<K: ContactSystem> Passage<K> {
    pub(crate) fn of(number: usize, sample: &Sample<InMode<'_, K>>) -> Self {
        let Sample { t, q, z, p } = *sample;
        Self { number, sample: Sample { t, q, z, p } }
    }
}

impl<K: ContactSystem> Clone for Passage<K> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<K: ContactSystem> Copy for Passage<K> {}

impl<K: ContactSystem> fmt::Debug for Passage<K> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Passage").field("number", &self.number).field("sample", &self.sample).finish()
    }
}

/// A jump of the state by an event that the run was given: see [`ContactRun::then`](crate::ContactRun::then).
#[non_exhaustive]
pub struct StateJump<K: ContactSystem> {
    /// The number of the event, as that of a [`Passage`].
    pub number: usize,
    /// The state before it.
    pub before: Sample<K>,
    /// The state after it, on the constraints, before contacts act on it: an impact that it makes comes next.
    pub after: Sample<K>,
}

impl<K: ContactSystem> Clone for StateJump<K> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<K: ContactSystem> Copy for StateJump<K> {}

impl<K: ContactSystem> fmt::Debug for StateJump<K> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { number, before, after } = self;
        f.debug_struct("StateJump").field("number", number).field("before", before).field("after", after).finish()
    }
}

impl<K: ContactSystem> StateJump<K> {
    /// The energy that it gives, kinetic and potential.
    pub fn energy(&self, kernel: &K) -> K::Scalar {
        let [before, after] = [self.before, self.after].map(|Sample { t, q, z, .. }| kernel.energy(t, &q, &z));
        after - before
    }
}

/// One solution of the laws: at an impact, or where modes are chosen.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct SolveRecord {
    /// When.
    pub time: f64,
    /// Whether velocities were solved for, at an impact; else accelerations.
    pub impact: bool,
    /// The contacts that took part, with their residuals.
    pub residuals: alloc::vec::Vec<(usize, Residual)>,
}
