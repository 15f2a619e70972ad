//! Springs that steps without a memory cannot follow.
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

/// The square of ωh up to which a step without a memory follows what swings: its energy is off by a quarter of that
/// part of the kinetic energy.
const FOLLOWED: f64 = 1.0;
/// Roundings of powers.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

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
