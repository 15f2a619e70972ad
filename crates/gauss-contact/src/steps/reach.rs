//! Stops that the motion of a step reaches.
//!
//! A damper too strong for a step to follow turns a speed back by many times of itself, in the speeds that the step
//! foresees. In flight such attempts come to no end, and the step is made in parts. But a stop that they lead to ends
//! them: there the speed is zero by whatever force, however far it is. So where forces would turn a speed back by more
//! than itself, a gap that closes is to be reached by the speeds before the step, or by the mean ones at which forces
//! and the motion without contacts agree.

use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::contact::{Contact, ContactSystem};

use crate::rounding::Rounding;

use super::bounds::gaps_of;
use super::motion::Middle;
use super::outcome::Attempt;
use super::stepper::ContactStepper;
use super::used::Used;

/// The part of a speed by which forces at the mean speeds of a motion without contacts may change it for being others.
const MILD: f64 = 1e-2;
/// The number of mean speeds that are tried.
const TRIALS: usize = 24;

impl<K: ContactSystem<Scalar = f64>, M: AsMut<[f64]>> ContactStepper<'_, K, M> {
    /// The speed that forces turn back within a step, where it ends at a stop that the motion does not reach.
    pub(super) fn overshoots(
        &self,
        h: f64,
        (middle, made): (&Middle<K>, &Attempt<K>),
        input: &K::Input,
    ) -> Option<usize> {
        if !made.end.struck || !made.end.z.is_finite() {
            return None;
        }
        let used = self.used(h, middle, made);
        let acceleration = |z: &K::Speeds| self.kernel.acceleration(middle.t, &middle.q, z, input);
        let free = self.z.add_scaled(0.5 * h, &made.acceleration);
        let speed = used.turns_back(&free, &acceleration(&free))?;
        if self.reaches(h, (middle, made), &self.z) {
            return None;
        }
        let mean = self.settled(&used, acceleration);
        mean.is_none_or(|mean| !self.reaches(h, (middle, made), &mean)).then_some(speed)
    }

    /// Whether mean speeds lead to all stops that were struck.
    fn reaches(&self, h: f64, (middle, made): (&Middle<K>, &Attempt<K>), mean: &K::Speeds) -> bool {
        let rates = self.kernel.contact_rates(middle.t, &middle.q, mean);
        let near = Rounding::of::<K>(&self.q).half_of_the_digits();
        let is_reached = |(i, contact): (usize, &Contact)| {
            let row = contact.normal;
            let acts = !self.rests[i] && made.end.impulses.component(row) > 0.0;
            !acts || self.gaps.component(i) + h * rates.component(row) <= near
        };
        gaps_of(self.kernel).all(is_reached)
    }

    /// The mean speeds of a step at which its motion without contacts agrees with the forces, if they are found: each
    /// speed by the rule of Aitken.
    fn settled(&self, used: &Used<K::Speeds>, acceleration: impl Fn(&K::Speeds) -> K::Speeds) -> Option<K::Speeds> {
        let half = 0.5 * used.h;
        let (mut z, mut parts, mut before) = (self.z, K::Speeds::zero(), None::<K::Speeds>);
        for _ in 0..TRIALS {
            let forces = acceleration(&z);
            let change = z.add_scaled(-1.0, &self.z).scale(1.0 / half);
            if used.is_within(MILD, [&forces, &change]) {
                return Some(z);
            }
            let off = forces.add_scaled(-1.0, &change).scale(half);
            for i in 0..K::Speeds::DIM {
                let part = before.map_or(1.0, |before: K::Speeds| {
                    let before = before.component(i);
                    -parts.component(i) * before / (off.component(i) - before)
                });
                let part = if part > 0.0 { part.min(1.0) } else { 1.0 };
                parts.set_component(i, part);
                z.set_component(i, z.component(i) + part * off.component(i));
            }
            before = Some(off);
        }
        None
    }
}
