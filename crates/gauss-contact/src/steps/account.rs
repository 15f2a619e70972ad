//! The energy of a run, and how much of it is explained.
//!
//! Each step may be off by no more than its length allows and the run all the same gain without bound: by forces that
//! set in within a step, as of stops that give way, by one impact after the other, by steps that are made in parts now
//! and then. So what a system has is compared with the least that it had, and what was given to it since. A run that
//! has more than that by all that ever moved is refused.
//!
//! Where a system [keeps its energy](gauss_runtime::system::GaussSystem::KEEPS_ENERGY) contacts alone give: surfaces
//! that move, Newton's law with friction. Elsewhere so do inputs, forces, drives and frames that move: in each step the
//! rate of the energy at half of it, along its mean speeds and the acceleration that it took. That counts nothing of
//! forces that have a potential. Forces that steps take at mean speeds do the work that they should, up to (ωh)²/12 of
//! it: a quarter more than the work is allowed, since a sum of it over a long run is more than all that moves. Work
//! that is taken away is not counted, and steps that lose energy need no account; nor do those without an impact in
//! which accelerations hardly change, whose change of the energy is explained by their own check (`speeds`).

use gauss_runtime::contact::ContactSystem;

/// The account of a run.
#[derive(Clone, Copy, Debug)]
pub(super) struct Account {
    /// The least energy so far, with what was given since.
    pub(super) low: f64,
    /// The largest kinetic energy that is explained: that at the start, and what `low` leaves at later places.
    pub(super) most: f64,
    /// The energy after the last step that was accounted for, and whether that is the last step.
    pub(super) energy: f64,
    pub(super) is_current: bool,
}

impl Account {
    /// At the start of a run.
    pub(super) fn begun<K: ContactSystem<Scalar = f64>>(
        kernel: &K,
        (t, q, z): (f64, &K::Configuration, &K::Speeds),
    ) -> Self {
        let energy = kernel.energy(t, q, z);
        Self { low: energy, most: kernel.kinetic_energy(t, q, z), energy, is_current: true }
    }
}
