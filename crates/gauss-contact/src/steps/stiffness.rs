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
//!
//! Steps without a memory are to be smooth in their start: their forces stay at half of the way. On springs K they keep
//! `½ qᵀKq + ½ zᵀ(A − h²K/4)z` as long as they are whole, and energy is off by `h² zᵀKz/8`: by a quarter of the kinetic
//! energy times the mean square of ωh of what swings along z, by kinetic energies. Where that mean is at most
//! [`FOLLOWED`] at the end of each step, energy is never more than 4/3 of that at the start, whatever swings beside. In
//! parts now and then a step would keep another form each time, and energy would grow: it did from ωh = 1 on, and from
//! a half where one of several speeds passed through zero. So steps without a memory are never made in parts for
//! springs, and refused where that mean is more.

use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::real::Real;

use crate::error::{ContactError, ContactErrorKind};

use super::motion::Middle;
use super::outcome::Attempt;
use super::stepper::ContactStepper;
use super::used::Used;

/// The square of ωh from which on forces are taken at the mean place of a step.
const SWING: f64 = 0.09;
/// For how many steps that is so after the last with such a force: more than two swings of it.
const STAYS: u32 = 64;
/// The square of ωh up to which a step without a memory follows what swings: its energy is off by a quarter of that
/// part of the kinetic energy.
const FOLLOWED: f64 = 1.0;
/// Roundings of powers.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

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

    /// Whether forces have changed so much since the step before that they may do so with places; nothing where there
    /// was no step before.
    pub(super) fn may_stiffen(&self, used: &Used<V>) -> Option<bool> {
        // From half of the step before to half of this one.
        self.free.map(|(h, free)| used.change([&used.acceleration, &free], 2.0 * used.h / (used.h + h)) > SWING)
    }
}

impl<V: VectorSpace<f64>> Used<V> {
    /// Whether forces are to be taken at mean places, given the accelerations by places at half of the step and before
    /// it.
    pub(super) fn stiffens(&self, accelerations: [&V; 2]) -> bool {
        self.change(accelerations, 2.0) > SWING
    }

    /// The same, given those at half of the step and at the mean place, to which the change of speeds in the step leads
    /// along half of its half.
    pub(super) fn stiffens_on_way(&self, accelerations: [&V; 2]) -> bool {
        !self.is_within(0.25 * SWING, accelerations)
    }

    /// The largest part of itself by which a speed would change in a step by what two accelerations differ, times as
    /// much as the way between them is shorter than that of the step: the square of ωh.
    fn change(&self, [one, other]: [&V; 2], times: f64) -> f64 {
        let by = |i: usize| times * self.h * (one.component(i) - other.component(i)).abs();
        // Mostly forces change by nothing that the speeds alone would not show.
        if (0..V::DIM).all(|i| by(i) <= SWING * self.before.component(i).abs()) {
            return 0.0;
        }
        let sizes = self.magnitudes();
        (0..V::DIM).map(|i| by(i) / sizes.component(i)).fold(0.0, f64::max)
    }
}

impl<K: ContactSystem<Scalar = f64>, M: AsMut<[f64]>> ContactStepper<'_, K, M> {
    /// Refuses a step without a memory whose energy is off by more than a quarter of the kinetic energy for springs: by
    /// the speeds after it, and those without an impact.
    pub(super) fn follows(
        &self,
        h: f64,
        (middle, made): (&Middle<K>, &Attempt<K>),
        input: &K::Input,
    ) -> Result<(), ContactError> {
        let (end, used) = (&made.end, self.used(h, middle, made));
        // Where speeds jump, forces of two steps may agree by chance.
        let is_smooth = !end.struck && self.last.acceleration.is_some();
        if is_smooth && self.last.may_stiffen(&used) == Some(false) || !end.z.is_finite() {
            return Ok(());
        }
        let after = self.swing(h, (middle, &end.z), input);
        let free = self.z.add_scaled(h, &made.acceleration);
        let swing = if end.struck { after.max(self.swing(h, (middle, &free), input)) } else { after };
        if swing.is_nan() || swing <= FOLLOWED {
            return Ok(());
        }
        Err(self.error(None, ContactErrorKind::StiffSprings { phase: Real::sqrt(swing), step: h }))
    }

    /// The square of ωh of the second half of a step by some speeds.
    fn swing(&self, h: f64, (middle, z): (&Middle<K>, &K::Speeds), input: &K::Input) -> f64 {
        let (kernel, t, still) = (self.kernel, self.t + h, K::Speeds::zero());
        let q = middle.half.advance(&kernel.kinematics(middle.t, &middle.half, z).scale(0.5 * h));
        let swing = self.swing_to(h, &q, (z, &still), input);
        if swing <= FOLLOWED {
            return swing;
        }
        // Speeds seen from a body that turns change by its turning alone, as do those of arms.
        let acceleration = |z: &K::Speeds| kernel.acceleration(t, &q, z, input);
        let both = acceleration(z).add_scaled(1.0, &acceleration(&z.scale(-1.0))).scale(0.5);
        let turning = both.add_scaled(-1.0, &acceleration(&still));
        self.swing_to(h, &q, (z, &turning), input)
    }

    /// The square of ωh of the way that leads to a place with speeds that `turning` changes: how much the power of
    /// forces by places changes along half of the step, as a part of the kinetic energy. Of what swings with several ω
    /// it is the mean by kinetic energies, and so never more than that of the fastest.
    fn swing_to(&self, h: f64, q: &K::Configuration, (z, turning): (&K::Speeds, &K::Speeds), input: &K::Input) -> f64 {
        let (kernel, t) = (self.kernel, self.t + h);
        let power = |q: &K::Configuration, z: &K::Speeds| {
            let (p, a) = (kernel.momentum(t, q, z), self.of_places(t, q, input));
            let each = (0..K::Speeds::DIM).map(|i| p.component(i) * a.component(i));
            each.fold([0.0, 0.0], |[sum, size], each| [sum + each, size + each.abs()])
        };
        let way = kernel.kinematics(t, q, &z.add_scaled(-0.25 * h, turning)).scale(-0.5 * h);
        let [before, after] = [power(&q.advance(&way), &z.add_scaled(-0.5 * h, turning)), power(q, z)];
        let (mut least, rounding) = (K::Speeds::zero(), ROUNDING * h * (before[1] + after[1]));
        (0..K::Speeds::DIM).for_each(|i| least.set_component(i, self.least(h)));
        let kinetic = kernel.kinetic_energy(t, q, z) + kernel.kinetic_energy(t, q, &least);
        h * (before[0] - after[0]).abs() / (kinetic + rounding + f64::MIN_POSITIVE)
    }
}
