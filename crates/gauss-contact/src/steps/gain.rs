//! The energy that a step with an impact gives and nothing explains.
//!
//! A step takes forces and the mass matrix once, at half of it, wherever within it a gap closes. Where speeds jump, the
//! forces that come with the coordinates (centrifugal ones, of a mass matrix that changes) then act at speeds that are
//! neither those before the impact nor those after it, and energy errs by ωh of what the jump is: two rods on a hinge
//! that bounce without loss gain a hundredth of theirs per impact, in steps of 1 ms.
//!
//! So a step with an impact keeps an account: what it gains beyond the work of its impulses and beyond what the motion
//! without contacts supplies at both ends. Where that is more than [`UNEXPLAINED`] it is made in parts, by which the
//! impact is confined to a sixteenth of the step; what is left is told by the report. Steps without a memory are told
//! of alone: where a step is made in parts its end jumps, and these are to be smooth.

use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::contact::ContactSystem;

use super::motion;
use super::outcome::{Attempt, End};
use super::stepper::ContactStepper;

/// The part of the kinetic energy that an impact may gain without being made in shorter parts.
const UNEXPLAINED: f64 = 1e-3;

/// By what part of itself energy is rounded: some hundred terms.
const ROUNDING: f64 = 128.0 * f64::EPSILON;

/// By what part of a step states are moved for rates of energy.
const NEAR: f64 = 1e-4;

impl<K: ContactSystem<Scalar = f64>, M: AsMut<[f64]>> ContactStepper<'_, K, M> {
    /// Reports what an impact gains that nothing explains; whether that is little.
    pub(super) fn accounts(&self, h: f64, made: &mut Attempt<K>, input: &K::Input) -> bool {
        if !made.end.struck {
            return true;
        }
        let (kernel, t) = (self.kernel, self.t + h);
        let [before, after] = [(self.t, &self.q, &self.z), (t, &made.end.q, &made.end.z)];
        let [of_before, of_after] = [before, after].map(|(t, q, z)| kernel.energy(t, q, z));
        let supplied: f64 = [before, after].iter().map(|at| 0.5 * h * self.power(h, *at, input)).sum();
        let gained = of_after - of_before - supplied - self.work(h, &made.end);
        made.end.report.unexplained = gained;

        let kinetic = [before, after].map(|(t, q, z)| kernel.kinetic_energy(t, q, z)).iter().sum::<f64>();
        // What comes to rest has hardly any, and weight works in the step.
        let of_step = kernel.kinetic_energy(t, &made.end.q, &made.acceleration.scale(h));
        let rounding = ROUNDING * (of_before.abs() + of_after.abs());
        gained <= UNEXPLAINED * kinetic + of_step + rounding
    }

    /// The work of the impulses of a step on its mean speeds, as far as it may be: they take energy away from the slip
    /// and the approach of surfaces, and give what moves these.
    fn work(&self, h: f64, end: &End<K>) -> f64 {
        let (kernel, t) = (self.kernel, self.t + 0.5 * h);
        let q = motion::half_way::<K>(h, &self.q, &kernel.kinematics(self.t, &self.q, &self.z));
        let mean = self.z.add_scaled(1.0, &end.z).scale(0.5);
        let [taken, given] = [mean, K::Speeds::zero()].map(|z| {
            let rates = kernel.contact_rates(t, &q, &z);
            (0..K::ContactRows::DIM).map(|row| end.impulses.component(row) * rates.component(row)).sum::<f64>()
        });
        taken.min(0.0) - given
    }

    /// The rate of the energy of the motion without contacts.
    fn power(&self, h: f64, (t, q, z): (f64, &K::Configuration, &K::Speeds), input: &K::Input) -> f64 {
        let kernel = self.kernel;
        let (rate, acceleration) = (kernel.kinematics(t, q, z), kernel.acceleration(t, q, z, input));
        let moved = |by: f64| kernel.energy(t + by, &q.advance(&rate.scale(by)), &z.add_scaled(by, &acceleration));
        (moved(NEAR * h) - moved(-NEAR * h)) / (2.0 * NEAR * h)
    }
}
