//! Runs in steps of one length.

use core::ops::Range;

use gauss_runtime::contact::ContactSystem;
use gauss_runtime::integrate::drive::event::{Events, NoEvents, Watched};
use gauss_runtime::integrate::{Crossing, Feedback, InputSource, NoInput};

use crate::error::{ContactError, ContactErrorKind};
use crate::mode::InMode;

use crate::sampling;

use super::made::{StepSample, SteppedRun};
use super::passing::look;
use super::relaxed::StepLaw;
use super::report::StepScheme;
use super::stepper::ContactStepper;

/// Roundings of a time within which an instant is the end of a step.
const ROUNDINGS: f64 = 16.0;

/// A run in steps in preparation: that of [`contact_steps`](crate::WithContacts::contact_steps) of a
/// [`Simulation`](gauss_runtime::integrate::Simulation).
#[derive(Clone, Copy, Debug)]
#[must_use = "a run does nothing before `run`"]
pub struct ContactSteps<'k, K, I = NoInput, E = NoEvents> {
    pub(super) kernel: &'k K,
    pub(super) h: f64,
    pub(super) input: I,
    pub(super) events: E,
    scheme: StepScheme,
    law: StepLaw,
    tolerance: f64,
    every: u64,
    pub(super) limit: Option<u64>,
}

impl<'k, K: ContactSystem<Scalar = f64>> ContactSteps<'k, K> {
    /// Steps of length `h` of a system without inputs.
    pub fn new(kernel: &'k K, h: f64) -> Self {
        Self::of_parts(kernel, h, (NoInput, NoEvents), (1, None))
    }
}

impl<'k, K: ContactSystem<Scalar = f64>, I, E> ContactSteps<'k, K, I, E> {
    /// Steps of these parts, with every how many states are kept and the most steps.
    pub(crate) fn of_parts(kernel: &'k K, h: f64, (input, events): (I, E), (every, limit): (u64, Option<u64>)) -> Self {
        let (scheme, law, tolerance) = (StepScheme::default(), StepLaw::default(), 1e-8);
        Self { kernel, h, input, events, scheme, law, tolerance, every, limit }
    }

    /// The input as a function of time and state; it is taken in the state before each step, at the time in its middle,
    /// and held. Of what changes with time alone that is the mean over the step, up to the square of its length.
    pub fn input<G>(self, input: G) -> ContactSteps<'k, K, Feedback<G>, E>
    where
        G: Fn(f64, &K::Configuration, &K::Speeds) -> K::Input,
    {
        self.input_from(Feedback(input))
    }

    /// The input from a type that implements [`InputSource`], held in the same way.
    pub fn input_from<J: InputSource<K>>(self, input: J) -> ContactSteps<'k, K, J, E> {
        let Self { kernel, h, events, scheme, law, tolerance, every, limit, .. } = self;
        ContactSteps { kernel, h, input, events, scheme, law, tolerance, every, limit }
    }

    /// Finds the states in which a function of time and state passes through zero, numbered as those of a
    /// [`Simulation`](gauss_runtime::integrate::Simulation::event): [`SteppedRun::passages`]. They are looked for from
    /// the end of one step to the end of the next, and are as accurate as states in between; what passes there and back
    /// within a step is not seen.
    pub fn event<G>(self, crossing: Crossing, function: G) -> ContactSteps<'k, K, I, Watched<E, G>>
    where
        G: Fn(f64, &K::Configuration, &K::Speeds) -> f64,
    {
        self.watch(crossing, false, function)
    }

    /// Ends the run at the first such state, which is then its last: [`SteppedRun::stopped_by`].
    pub fn until<G>(self, crossing: Crossing, function: G) -> ContactSteps<'k, K, I, Watched<E, G>>
    where
        G: Fn(f64, &K::Configuration, &K::Speeds) -> f64,
    {
        self.watch(crossing, true, function)
    }

    /// Events that another front has gathered, in the place of those so far; they must not change the state.
    #[doc(hidden)]
    pub fn events_by<F>(self, events: F) -> ContactSteps<'k, K, I, F> {
        let Self { kernel, h, input, scheme, law, tolerance, every, limit, .. } = self;
        ContactSteps { kernel, h, input, events, scheme, law, tolerance, every, limit }
    }

    fn watch<G>(self, crossing: Crossing, ends: bool, function: G) -> ContactSteps<'k, K, I, Watched<E, G>> {
        let Self { kernel, h, input, events, scheme, law, tolerance, every, limit } = self;
        let events = Watched::after(events, crossing, ends, function);
        ContactSteps { kernel, h, input, events, scheme, law, tolerance, every, limit }
    }

    /// The most steps before the run is given up; without this there are as many as the interval takes.
    pub fn max_steps(mut self, limit: u64) -> Self {
        self.limit = Some(limit);
        self
    }

    /// Sets the scheme by which the motion between impacts is taken.
    pub fn scheme(mut self, scheme: StepScheme) -> Self {
        self.scheme = scheme;
        self
    }

    /// Which law of friction impulses satisfy.
    pub fn law(mut self, law: StepLaw) -> Self {
        self.law = law;
        self
    }

    /// See [`ContactStepper::tolerance`].
    pub fn tolerance(mut self, tolerance: f64) -> Self {
        self.tolerance = tolerance;
        self
    }

    /// Steps from (q₀, z₀) over the interval, forward in time: the ends of all steps. The length is made a little
    /// shorter where the interval is no multiple of it.
    ///
    /// # Errors
    /// When the end is not reached; [`attempt`](Self::attempt) then gives the part that was made.
    pub fn run(
        self,
        q0: K::Configuration,
        z0: K::Speeds,
        interval: Range<f64>,
    ) -> Result<SteppedRun<'k, K>, ContactError>
    where
        I: InputSource<K>,
        E: Events<InMode<'k, K>>,
    {
        match self.attempt(q0, z0, interval) {
            (made, None) => Ok(made),
            (_, Some(error)) => Err(error),
        }
    }

    /// Like [`run`](Self::run), but gives the steps that were made when the end is not reached, with the reason.
    pub fn attempt(
        self,
        q0: K::Configuration,
        z0: K::Speeds,
        interval: Range<f64>,
    ) -> (SteppedRun<'k, K>, Option<ContactError>)
    where
        I: InputSource<K>,
        E: Events<InMode<'k, K>>,
    {
        let mut made = SteppedRun::begun(self.kernel, (interval.start, q0, z0));
        let error = self.go((q0, z0), interval, &mut made).err();
        (made, error)
    }

    fn go(
        mut self,
        (q0, z0): (K::Configuration, K::Speeds),
        interval: Range<f64>,
        made: &mut SteppedRun<'k, K>,
    ) -> Result<(), ContactError>
    where
        I: InputSource<K>,
        E: Events<InMode<'k, K>>,
    {
        let Range { start, end } = interval;
        self.check_every(start)?;
        let h = self.h;
        let count = (end - start) / h - 1e-9;
        if !(h > 0.0 && h.is_finite() && start <= end && count < 1e15) {
            return Err(ContactError { contact: None, time: start, kind: ContactErrorKind::InvalidInterval });
        }
        // Rounded up; a negative number becomes 0.
        let whole = count as u64;
        let count = whole + u64::from(count > whole as f64);
        let h = (end - start) / count as f64;
        let mut stepper = self.stepper(start, q0, z0)?;
        sampling::begin::<K, E>(&mut self.events, self.input.held().is_some(), (start, end), self.limit)?;
        let (mut until, mut steps) = (self.sample(&stepper, end)?, 0);
        for n in 1..=count {
            // Times are multiples of the length, not sums of it.
            let end_of_step = start + (end - start) * (n as f64 / count as f64);
            let mut length = h;
            loop {
                steps += 1;
                if let Some(limit) = self.limit.filter(|limit| *limit < steps) {
                    return Err(stepper.error(None, ContactErrorKind::TooManySteps { limit }));
                }
                // An instant of a controller ends a step.
                let rest = end_of_step - until;
                let rounding = ROUNDINGS * f64::EPSILON * end_of_step.abs().max(start.abs());
                let is_cut = E::SAMPLED && rest > rounding;
                length = if is_cut { until - stepper.t } else { length };
                stepper.step(length, &self.held(&stepper, length))?;
                stepper.t = if E::SAMPLED && rest >= -rounding { until } else { end_of_step };
                made.samples.push(StepSample::of(&stepper));
                if look(&mut self.events, made)? {
                    return Ok(());
                }
                if E::SAMPLED && stepper.t == until && until < end {
                    until = self.sample(&stepper, end)?;
                }
                if !is_cut {
                    break;
                }
                length = end_of_step - stepper.t;
            }
        }
        Ok(())
    }

    /// The input that a step of this length holds.
    pub(super) fn held(&self, stepper: &ContactStepper<'k, K>, length: f64) -> K::Input
    where
        I: InputSource<K>,
    {
        self.input.input(stepper.t + 0.5 * length, &stepper.q, &stepper.z)
    }

    /// Lets controllers sample where the steps are; until when they hold what they give.
    pub(super) fn sample(&mut self, stepper: &ContactStepper<'k, K>, end: f64) -> Result<f64, ContactError>
    where
        I: InputSource<K>,
        E: Events<InMode<'k, K>>,
    {
        let now = (stepper.time(), stepper.configuration(), stepper.speeds());
        Ok(sampling::tick(&mut self.events, self.kernel, now, (self.input.held(), end))?.0)
    }

    /// States in between are made from those at both ends of a step.
    pub(super) fn check_every(&self, time: f64) -> Result<(), ContactError> {
        if self.every == 1 {
            return Ok(());
        }
        Err(ContactError { contact: None, time, kind: ContactErrorKind::EveryState { every: self.every } })
    }

    /// At the start of a run.
    pub(super) fn stepper(
        &self,
        start: f64,
        q: K::Configuration,
        z: K::Speeds,
    ) -> Result<ContactStepper<'k, K>, ContactError> {
        let stepper = ContactStepper::new(self.kernel, start, q, z)?;
        Ok(stepper.scheme(self.scheme).law(self.law).tolerance(self.tolerance))
    }
}
