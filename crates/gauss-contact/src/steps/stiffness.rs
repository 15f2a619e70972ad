//! The stiffness that a step meets: how much forces change with places along it.
//!
//! A step that takes its forces at the place to which half of it leads with the speeds before it keeps what swings from
//! growing as long as its length stays: it is symplectic then, and energy is off by (ωh)²/8 of itself, to and fro.
//! Where lengths change, or an impact comes in between, what it is off by at that time stays, and adds up. At the mean
//! place of both ends instead the work of a force that is linear in places is the change of its energy, however lengths
//! change, and whatever impulses do. But that place is not known before, so that the step is made several times.
//!
//! So places are mean ones where the square of ωh is more than [`SWING`], and stay so for [`STAYS`] steps more: a
//! measure that came and went with the state would change from one to the other by the phase of what swings, which
//! feeds it. Forces that come with speeds do not count: masses that change with places, as of arms, do better with
//! those at half of the way, whose step is then nearly that of a discrete action.

use gauss_runtime::configuration::VectorSpace;

use super::used::Used;

/// The square of ωh below which forces change so little that what a step gains by it needs no account.
const SMOOTH: f64 = 0.02;
/// The square of ωh from which on forces are taken at the mean place of a step.
const SWING: f64 = 0.09;
/// Number of steps for which that is so after the last with such a force: more than two swings of it.
const STAYS: u32 = 64;

/// The forces of the step before, as far as the next one is made by them.
#[derive(Clone, Copy, Debug)]
pub(super) struct LastForces<V> {
    /// The mean acceleration, where no speeds have jumped.
    pub(super) acceleration: Option<V>,
    /// Acceleration without contacts, at half of the step, with its length.
    free: Option<(f64, V)>,
    /// Number of steps for which forces are to be taken at mean places.
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

    /// Whether forces have changed so much since the step before that they may do so with places; nothing where there
    /// was no step before.
    pub(super) fn may_stiffen(&self, used: &Used<V>) -> Option<bool> {
        self.changes_beyond(SWING, used)
    }

    /// Whether forces have hardly changed since the step before.
    pub(super) fn is_smooth(&self, used: &Used<V>) -> bool {
        self.changes_beyond(SMOOTH, used) == Some(false)
    }

    fn changes_beyond(&self, most: f64, used: &Used<V>) -> Option<bool> {
        // From half of the step before to half of this one.
        let times = |h: f64| 2.0 * used.h / (used.h + h);
        self.free.map(|(h, free)| used.change([&used.acceleration, &free], times(h), most) > most)
    }
}

impl<V: VectorSpace<f64>> Used<V> {
    /// Whether forces are to be taken at mean places, given the accelerations by places at half of the step and before
    /// it.
    pub(super) fn stiffens(&self, accelerations: [&V; 2]) -> bool {
        self.change(accelerations, 2.0, SWING) > SWING
    }

    /// The same, given those at half of the step and at the mean place, to which the change of speeds in the step leads
    /// along half of its half.
    pub(super) fn stiffens_on_way(&self, accelerations: [&V; 2]) -> bool {
        !self.is_within(0.25 * SWING, accelerations)
    }

    /// The largest part of itself by which a speed would change in a step by what two accelerations differ, times as
    /// much as the way between them is shorter than that of the step: the square of ωh; 0 where it is clearly below a
    /// number.
    fn change(&self, [one, other]: [&V; 2], times: f64, most: f64) -> f64 {
        let by = |i: usize| times * self.h * (one.component(i) - other.component(i)).abs();
        // Mostly forces change by nothing that the speeds alone would not show.
        if (0..V::DIM).all(|i| by(i) <= most * self.before.component(i).abs()) {
            return 0.0;
        }
        let sizes = self.magnitudes();
        (0..V::DIM).map(|i| by(i) / sizes.component(i)).fold(0.0, f64::max)
    }
}
