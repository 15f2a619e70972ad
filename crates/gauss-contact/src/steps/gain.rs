//! The energy that a step with an impact gives and nothing explains.
//!
//! A step takes forces and the mass matrix once, at half of it, wherever within it a gap closes. Where speeds jump, the
//! forces that come with the coordinates (centrifugal ones, of a mass matrix that changes) then act at speeds that are
//! neither those before the impact nor those after it, and energy errs by ωh of what the jump is: two rods on a hinge
//! that bounce without loss gain a hundredth of theirs per impact, in steps of 1 ms.
//!
//! So a step with an impact keeps an account: what it gains beyond the work of its impulses and beyond what the motion
//! without contacts supplies at both ends. Where that is more than [`LITTLE`] it is made in parts, by which the impact
//! is confined to a sixteenth of the step; what is left is told by the report. Steps without a memory are told
//! of alone: where a step is made in parts its end jumps, and these are to be smooth. A step that is taken although its
//! forces are not those at its mean speeds keeps the same account, and is refused where that is [`MUCH`]; any is where
//! it is more than all that moves has (`EnergyFromNowhere`). What all steps of a run gain is told by `account`.

use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::contact::{Contact, ContactSystem};

use crate::error::{ContactError, ContactErrorKind};

use super::account::Account;
use super::motion;
use super::outcome::{Attempt, End};
use super::report::StepScheme;
use super::stepper::ContactStepper;
use super::used::Used;

/// The part of the kinetic energy that an impact may gain without being made in shorter parts.
const LITTLE: f64 = 1e-3;
/// The part of it that a step may gain whose forces are not those at its mean speeds.
const MUCH: f64 = 0.1;

/// Part of itself by which energy is rounded: some hundred terms.
const ROUNDING: f64 = 128.0 * f64::EPSILON;

/// The part of work by which it may be off in a step.
const ALLOWED: f64 = 0.25;

/// Part of a step by which states are moved for rates of energy.
const NEAR: f64 = 1e-4;

/// The energy that a step gains.
pub(super) struct Gain {
    /// Energy gained that nothing explains.
    pub(super) unexplained: f64,
    /// The work that impulses give: Newton's law has such with friction.
    of_law: f64,
    /// The kinetic energy at both ends.
    kinetic: f64,
    /// The larger of those at both ends, without what nothing explains.
    explained: f64,
    /// Energy that weight gives to what rests in the step, and rounding.
    least: f64,
}

impl Gain {
    /// Whether it is no more than an impact may gain.
    pub(super) fn is_little(&self) -> bool {
        self.unexplained <= LITTLE * self.kinetic + self.least
    }

    /// Whether it is more than the energy of all that moves, beside what the law of impact gives: of an error of first
    /// order nothing is left then.
    pub(super) fn is_more_than_all(&self) -> bool {
        self.unexplained - self.of_law > self.explained + self.least
    }

    /// Error for which a step of length `h` is refused.
    pub(super) fn kind(&self, h: f64) -> ContactErrorKind {
        ContactErrorKind::EnergyFromNowhere { gained: self.unexplained, kinetic: self.explained, step: h }
    }

    /// Whether it is more than the forces of a step may differ by from those at its mean speeds.
    pub(super) fn is_much(&self) -> bool {
        self.unexplained > MUCH * self.explained + self.least
    }
}

impl<K: ContactSystem<Scalar = f64>, M: AsMut<[f64]>> ContactStepper<'_, K, M> {
    /// The energy that a step gains; with weight as a reason where forces do not change with places (`is_stiff`) more
    /// than it can follow.
    pub(super) fn gain(&self, h: f64, (made, is_stiff): (&Attempt<K>, bool), input: &K::Input) -> Gain {
        let (kernel, t) = (self.kernel, self.t + h);
        let [before, after] = [(self.t, &self.q, &self.z), (t, &made.end.q, &made.end.z)];
        let [of_before, of_after] = [before, after].map(|(t, q, z)| kernel.energy(t, q, z));
        let supplied: f64 = [before, after].iter().map(|at| 0.5 * h * self.power(h, *at, input)).sum();
        let [taken, _] = self.work(h, &made.end);
        let given = taken - self.work_on_speeds(h, &made.end);
        let gained = of_after - of_before - supplied - (taken.min(0.0) - given);
        let [first, last] = [before, after].map(|(t, q, z)| kernel.kinetic_energy(t, q, z));
        // What comes to rest has hardly any, and weight works in the step.
        let of_weight = || kernel.kinetic_energy(t, &made.end.q, &made.acceleration.scale(h));
        let of_step = if is_stiff { 0.0 } else { of_weight() };
        let impulses: f64 = (0..K::ContactRows::DIM).map(|row| made.end.impulses.component(row).abs()).sum();
        let of_impulses = impulses * made.end.report.residual.rounding;
        let rounding = ROUNDING * (of_before.abs() + of_after.abs()) + of_impulses;
        let (kinetic, explained) = (first + last, first.max(last - gained));
        Gain { unexplained: gained, of_law: taken.max(0.0), kinetic, explained, least: of_step + rounding }
    }

    /// The work of the impulses of a step on its mean speeds, and of that on the speeds of surfaces that move: impulses
    /// take energy away from the slip and the approach of surfaces, and give what moves these.
    pub(super) fn work(&self, h: f64, end: &End<K>) -> [f64; 2] {
        let (kernel, t) = (self.kernel, self.t + 0.5 * h);
        let q = motion::half_way::<K>(h, &self.q, &kernel.kinematics(self.t, &self.q, &self.z));
        let mean = self.z.add_scaled(1.0, &end.z).scale(0.5);
        [mean, K::Speeds::zero()].map(|z| {
            let rates = kernel.contact_rates(t, &q, &z);
            (0..K::ContactRows::DIM).map(|row| end.impulses.component(row) * rates.component(row)).sum::<f64>()
        })
    }

    /// The work that the impulses of a step do on its mean speeds, with that of what drives the system: where its
    /// constraints move with time, or its surfaces, it is another one than that of impulses on rates of contacts.
    fn work_on_speeds(&self, h: f64, end: &End<K>) -> f64 {
        let (kernel, t) = (self.kernel, self.t + 0.5 * h);
        let q = motion::half_way::<K>(h, &self.q, &kernel.kinematics(self.t, &self.q, &self.z));
        let added = kernel.impulse_velocities(&kernel.impulse_response(t, &q).factors, &end.impulses);
        let mean = self.z.add_scaled(1.0, &end.z).scale(0.5);
        let [less, more] = [-0.5, 0.5].map(|part| kernel.kinetic_energy(t, &q, &mean.add_scaled(part, &added)));
        more - less
    }

    /// The rate of the energy of the motion without contacts.
    fn power(&self, h: f64, (t, q, z): (f64, &K::Configuration, &K::Speeds), input: &K::Input) -> f64 {
        self.rate(h, (t, q, z), &self.kernel.acceleration(t, q, z, input))
    }

    /// The rate of the energy in a motion with an acceleration.
    fn rate(&self, h: f64, (t, q, z): (f64, &K::Configuration, &K::Speeds), acceleration: &K::Speeds) -> f64 {
        let (kernel, rate) = (self.kernel, self.kernel.kinematics(t, q, z));
        let moved = |by: f64| kernel.energy(t + by, &q.advance(&rate.scale(by)), &z.add_scaled(by, acceleration));
        (moved(NEAR * h) - moved(-NEAR * h)) / (2.0 * NEAR * h)
    }

    /// The account after a step.
    pub(super) fn accounted(&self, h: f64, made: &Attempt<K>) -> Result<Option<Account>, ContactError> {
        let Some(Account { low, most, energy, is_current }) = self.account else { return Ok(None) };
        let (kernel, t, end) = (self.kernel, self.t + h, &made.end);
        if !kernel.keeps_energy() && self.is_smooth(h, made) {
            return Ok(Some(Account { low, most, energy, is_current: false }));
        }
        // What smooth steps gave since is explained.
        let low = if is_current { low } else { low + kernel.energy(self.t, &self.q, &self.z) - energy };
        let (potential, kinetic) = (kernel.potential_energy(t, &end.q), kernel.kinetic_energy(t, &end.q, &end.z));
        let energy = potential + kinetic;
        let rounding = ROUNDING * (potential.abs() + kinetic + low.abs());
        let given = match energy > low + rounding {
            true if kernel.keeps_energy() => self.given_by_contacts(h, end),
            true => self.supplied(h, made),
            false => 0.0,
        };
        let low = (low + given).min(energy);
        let most = most.max(low - potential);
        // What weight makes of rest in a step.
        let of_weight = || kernel.kinetic_energy(t, &end.q, &made.acceleration.scale(h));
        let gained = energy - low;
        if gained > most + rounding && gained > most + rounding + of_weight() {
            return Err(self.error(None, ContactErrorKind::EnergyFromNowhere { gained, kinetic: most, step: h }));
        }
        Ok(Some(Account { low, most, energy, is_current: true }))
    }

    /// Whether a step has no impact, and takes forces that hardly differ from those of the step before. Steps without
    /// a memory do not look back at their forces.
    fn is_smooth(&self, h: f64, made: &Attempt<K>) -> bool {
        let has_memory = self.scheme == StepScheme::Midpoint;
        let (before, after) = (self.z, made.end.z);
        let used = Used { h, least: self.least(h), before, used: before, acceleration: made.acceleration, after };
        has_memory && !made.end.struck && !self.last.is_stiff() && self.last.is_smooth(&used)
    }

    /// The energy that contacts give in a step: surfaces that move, and Newton's law with friction.
    fn given_by_contacts(&self, h: f64, end: &End<K>) -> f64 {
        let [taken, given] = if end.touches { self.work(h, end) } else { [0.0; 2] };
        let of_law = if Self::rubs(self.kernel, &end.impulses) { taken.max(0.0) } else { 0.0 };
        of_law + (-given).max(0.0)
    }

    /// The energy that all that has no potential gives in a step, contacts among it, with what steps may err by of it.
    fn supplied(&self, h: f64, made: &Attempt<K>) -> f64 {
        let (kernel, t, end) = (self.kernel, self.t + 0.5 * h, &made.end);
        let mean = motion::mean(&self.z, &end.z);
        // The place at which the step took its forces: of those that have a potential the rate is zero there alone.
        let way = if self.last.is_stiff() { &mean } else { &self.z };
        let q = motion::half_way::<K>(h, &self.q, &kernel.kinematics(self.t, &self.q, way));
        let mut work = h * self.rate(h, (t, &q, &mean), &made.acceleration);
        if end.touches || K::CONSTRAINED {
            let free = self.z.add_scaled(h, &made.acceleration);
            let (p, added) = (kernel.momentum(t, &q, &mean), end.z.add_scaled(-1.0, &free));
            work += (0..K::Speeds::DIM).map(|i| p.component(i) * added.component(i)).sum::<f64>();
        }
        if end.touches && !Self::rubs(kernel, &end.impulses) {
            work -= self.work(h, end)[0].max(0.0);
        }
        (1.0 + ALLOWED) * work.max(0.0)
    }

    /// Whether there is friction, without which no impact gives energy.
    fn rubs(kernel: &K, impulses: &K::ContactRows) -> bool {
        let normal = |contact: &Contact, row: usize| contact.has_gap() && row == contact.normal;
        let rubs =
            |contact: &Contact| contact.rows().any(|row| !normal(contact, row) && impulses.component(row) != 0.0);
        kernel.contacts().iter().any(rubs)
    }
}
