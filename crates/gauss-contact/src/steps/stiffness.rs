//! The stiffness that a step meets: how much forces change with places along it.
//!
//! A step that takes its forces at the place to which half of it leads with the speeds before it keeps what swings from
//! growing as long as its length stays: it is symplectic then, and energy is off by (ωh)²/8 of itself, to and fro.
//! Where lengths change, or an impact comes in between, what it is off by at that time stays, and adds up. At the mean
//! place of both ends instead the work of a force that is linear in places is the change of its energy, however lengths
//! change, and whatever impulses do. But that place is not known before, so that the step is made several times.
//!
//! So places are mean ones once ωh is [`SWING`], from which on (ωh)²/8 is no longer small, and stay so for as long as
//! it is and [`STAYS`] steps more: a measure that came and went with the state would change from one to the other by
//! the phase of what swings, which feeds it.

use gauss_runtime::configuration::VectorSpace;

use super::used::Used;

/// The square of ωh from which on forces are taken at the mean place of a step.
const SWING: f64 = 0.0625;
/// For how many steps that is so after the last with such a force: more than two swings of it.
const STAYS: u32 = 64;

/// The forces of the step before, as far as the next one is made by them.
#[derive(Clone, Copy, Debug)]
pub(super) struct LastForces<V> {
    /// The mean acceleration, where no speeds have jumped.
    pub(super) acceleration: Option<V>,
    /// That without contacts, at half of the step, with its length.
    free: Option<(f64, V)>,
    /// For how many steps forces are to be taken at mean places.
    stays: u32,
}

impl<V> Default for LastForces<V> {
    fn default() -> Self {
        Self { acceleration: None, free: None, stays: 0 }
    }
}

impl<V: VectorSpace<f64>> LastForces<V> {
    /// After a step of some length: its acceleration without contacts, and the mean one where speeds have not jumped.
    pub(super) fn then(&self, free: (f64, V), acceleration: Option<V>) -> Self {
        Self { acceleration, free: Some(free), stays: self.stays.saturating_sub(1) }
    }

    /// Forces change much with places in the step that is being made.
    pub(super) fn stiffen(&mut self) {
        self.stays = STAYS + 1;
    }

    /// Whether forces are to be taken at mean places.
    pub(super) fn is_stiff(&self) -> bool {
        self.stays > 0
    }

    /// Whether forces have changed so much since the step before that they may do so with places.
    pub(super) fn may_stiffen(&self, used: &Used<V>) -> bool {
        // From half of the step before to half of this one.
        self.free.is_some_and(|(h, free)| used.change(&free, 2.0 * used.h / (used.h + h)).0 > SWING)
    }
}

impl<V: VectorSpace<f64>> Used<V> {
    /// The square of ωh of the forces that change most with places, given the acceleration at the place before the
    /// step, and the speed on which they act.
    pub(super) fn stiffness(&self, at_start: &V) -> (f64, usize) {
        self.change(at_start, 2.0)
    }

    /// Whether forces are to be taken at mean places.
    pub(super) fn stiffens(&self, at_start: &V) -> bool {
        self.stiffness(at_start).0 > SWING
    }

    /// The part of itself by which a speed would change in a step by what the acceleration differs from another one,
    /// times as much as the way between them is shorter than that of the step: the largest, and its speed.
    fn change(&self, other: &V, times: f64) -> (f64, usize) {
        let sizes = self.magnitudes();
        let part = |i: usize| {
            let by = times * self.h * (self.acceleration.component(i) - other.component(i)).abs();
            if sizes.component(i) > 0.0 { by / sizes.component(i) } else { 0.0 }
        };
        (0..V::DIM).map(|i| (part(i), i)).fold((0.0, 0), |most, part| if part.0 > most.0 { part } else { most })
    }
}
