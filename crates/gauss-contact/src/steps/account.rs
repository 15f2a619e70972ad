//! The energy of a run in which nothing but contacts can raise it.
//!
//! Each step may be off by no more than its length allows and the run all the same gain without bound: by forces that
//! set in within a step, as of stops that give way, by one impact after the other, by steps that are made in parts now
//! and then. Where a system [keeps its energy](gauss_runtime::system::GaussSystem::KEEPS_ENERGY), what it has is
//! compared with the least that it had, and what contacts gave since: surfaces that move, Newton's law with friction.
//! A run that has more than that by all that ever moved is refused. Other systems would take an acceleration more in
//! each step for the same, and the account would be off by what a step does not see of their powers.

use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::contact::{Contact, ContactSystem};

use crate::error::{ContactError, ContactErrorKind};

use super::gain::ROUNDING;
use super::outcome::Attempt;
use super::stepper::ContactStepper;

/// The account of a run.
#[derive(Clone, Copy, Debug)]
pub(super) struct Account {
    /// The least energy so far, with what contacts gave since.
    low: f64,
    /// The largest kinetic energy that is explained: that at the start, and what `low` leaves at later places.
    most: f64,
}

impl Account {
    /// At the start of a run, of a system that keeps its energy.
    pub(super) fn begun<K: ContactSystem<Scalar = f64>>(
        kernel: &K,
        (t, q, z): (f64, &K::Configuration, &K::Speeds),
    ) -> Option<Self> {
        K::KEEPS_ENERGY.then(|| Self { low: kernel.energy(t, q, z), most: kernel.kinetic_energy(t, q, z) })
    }
}

impl<K: ContactSystem<Scalar = f64>, M: AsMut<[f64]>> ContactStepper<'_, K, M> {
    /// The account after a step.
    pub(super) fn accounted(&self, h: f64, made: &Attempt<K>) -> Result<Option<Account>, ContactError> {
        let Some(Account { low, most }) = self.account else { return Ok(None) };
        let (kernel, t, end) = (self.kernel, self.t + h, &made.end);
        let (potential, kinetic) = (kernel.potential_energy(t, &end.q), kernel.kinetic_energy(t, &end.q, &end.z));
        let [taken, given] = if end.touches { self.work(h, end) } else { [0.0; 2] };
        let of_law = if Self::rubs(&end.impulses) { taken.max(0.0) } else { 0.0 };
        let energy = potential + kinetic;
        let low = (low + of_law + given.max(0.0)).min(energy);
        let most = most.max(low - potential);
        // What weight makes of rest in a step, and rounding.
        let of_weight = || kernel.kinetic_energy(t, &end.q, &made.acceleration.scale(h));
        let rounding = ROUNDING * (potential.abs() + kinetic + low.abs());
        let gained = energy - low;
        if gained > most + rounding && gained > most + rounding + of_weight() {
            return Err(self.error(None, ContactErrorKind::EnergyFromNowhere { gained, kinetic: most, step: h }));
        }
        Ok(Some(Account { low, most }))
    }

    /// Whether there is friction, without which no impact gives energy.
    fn rubs(impulses: &K::ContactRows) -> bool {
        let normal = |contact: &Contact, row: usize| contact.has_gap() && row == contact.normal;
        let rubs =
            |contact: &Contact| contact.rows().any(|row| !normal(contact, row) && impulses.component(row) != 0.0);
        K::CONTACTS.iter().any(rubs)
    }
}
