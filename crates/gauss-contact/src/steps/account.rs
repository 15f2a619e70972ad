//! The energy of a run in which nothing but contacts can raise it.
//!
//! Each step may be off by no more than its length allows and the run all the same gain without bound: by forces that
//! set in within a step, as of stops that give way, by one impact after the other, by steps that are made in parts now
//! and then. Where a system [keeps its energy](gauss_runtime::system::GaussSystem::KEEPS_ENERGY), what it has is
//! compared with the least that it had, and what contacts gave since: surfaces that move, Newton's law with friction.
//! A run that has more than that by all that ever moved is refused. Other systems would take an acceleration more in
//! each step for the same, and the account would be off by what a step does not see of their powers.

use gauss_runtime::contact::ContactSystem;

/// The account of a run.
#[derive(Clone, Copy, Debug)]
pub(super) struct Account {
    /// The least energy so far, with what contacts gave since.
    pub(super) low: f64,
    /// The largest kinetic energy that is explained: that at the start, and what `low` leaves at later places.
    pub(super) most: f64,
}

impl Account {
    /// At the start of a run, of a system that keeps its energy.
    pub(super) fn begun<K: ContactSystem<Scalar = f64>>(
        kernel: &K,
        (t, q, z): (f64, &K::Configuration, &K::Speeds),
    ) -> Option<Self> {
        kernel.keeps_energy().then(|| Self { low: kernel.energy(t, q, z), most: kernel.kinetic_energy(t, q, z) })
    }
}
