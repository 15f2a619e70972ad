//! Runs in steps of one length.

use core::ops::Range;

use gauss_runtime::contact::ContactSystem;
use gauss_runtime::integrate::drive::event::{Events, JumpFunction, NoEvents, Watched};
use gauss_runtime::integrate::{Crossing, Feedback, InputSource, NoInput, Problem, Sample, SystemProblem};

use crate::error::{ContactError, ContactErrorKind};
use crate::{jumps, sampling};

use super::made::{StepSample, SteppedRun};
use super::passing::{EventOutcome, EventWatch};
use super::relaxed::StepLaw;
use super::report::StepScheme;
use super::stepper::ContactStepper;

/// Roundings of a time within which an instant is the end of a step.
const ROUNDINGS: f64 = 16.0;
/// Part of a step that is tried in its place where it is too long to show where a jump has led.
const SHORTER: f64 = 0.25;

/// Function that sees a run after each of its steps.
type RunVisitor<'v, 'k, K> = &'v mut dyn FnMut(&mut SteppedRun<'k, K>);

/// The motion without contacts, as jumps see it.
pub(super) fn problem<'k, K: ContactSystem, I: InputSource<K>>(
    kernel: &'k K,
    input: &'k I,
) -> impl Problem<System = K> + use<'k, K, I> {
    let input = move |t: K::Scalar, q: &K::Configuration, z: &K::Speeds| input.input(t, q, z);
    SystemProblem::new(kernel).input_from(Feedback(input))
}

/// The end of a step of a run.
enum StepEnd {
    /// The step came to where it was to end.
    Target,
    /// The step came to a jump, or not as far after one.
    Before,
    /// The run has ended.
    End,
}

/// The input that a step of this length holds.
pub(super) fn held<K: ContactSystem<Scalar = f64>, I: InputSource<K>>(
    input: &I,
    stepper: &ContactStepper<'_, K>,
    length: f64,
) -> K::Input {
    input.input(stepper.t + 0.5 * length, &stepper.q, &stepper.z)
}

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

    /// Events that another front has gathered, in the place of those so far.
    #[doc(hidden)]
    pub fn events_by<F>(self, events: F) -> ContactSteps<'k, K, I, F> {
        self.with_events(|_| events)
    }

    fn watch<G>(self, crossing: Crossing, ends: bool, function: G) -> ContactSteps<'k, K, I, Watched<E, G>> {
        self.with_events(|events| Watched::after(events, crossing, ends, function))
    }

    /// The run without its events, and these.
    pub(super) fn parted(self) -> (ContactSteps<'k, K, I>, E) {
        let Self { kernel, h, input, events, scheme, law, tolerance, every, limit } = self;
        (ContactSteps { kernel, h, input, events: NoEvents, scheme, law, tolerance, every, limit }, events)
    }

    fn with_events<F>(self, change: impl FnOnce(E) -> F) -> ContactSteps<'k, K, I, F> {
        let Self { kernel, h, input, events, scheme, law, tolerance, every, limit } = self;
        ContactSteps { kernel, h, input, events: change(events), scheme, law, tolerance, every, limit }
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
        E: Events<K>,
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
        E: Events<K>,
    {
        let mut made = SteppedRun::begun(self.kernel, (interval.start, q0, z0));
        let error = self.go((q0, z0), interval, (&mut made, &mut |_| ())).err();
        (made, error)
    }

    /// Like [`run`](Self::run), but hands the end of each step to a function and forgets it: the record covers the last
    /// step alone, with all passages and jumps of the state. A run of any number of steps takes no more memory than
    /// what the function keeps: every hundredth state, a sum, lines of a file.
    ///
    /// # Errors
    /// When the end is not reached, after all steps that were made.
    pub fn visit(
        self,
        (q0, z0): (K::Configuration, K::Speeds),
        interval: Range<f64>,
        mut each: impl FnMut(&StepSample<K>),
    ) -> Result<SteppedRun<'k, K>, ContactError>
    where
        I: InputSource<K>,
        E: Events<K>,
    {
        let mut made = SteppedRun::begun(self.kernel, (interval.start, q0, z0));
        let mut known = 0;
        let forgets = &mut |made: &mut SteppedRun<'k, K>| {
            made.samples[known..].iter().for_each(&mut each);
            made.forget();
            known = made.samples.len();
        };
        self.go((q0, z0), interval, (&mut made, forgets))?;
        Ok(made)
    }

    fn go(
        mut self,
        (q0, z0): (K::Configuration, K::Speeds),
        interval: Range<f64>,
        (made, seen): (&mut SteppedRun<'k, K>, RunVisitor<'_, 'k, K>),
    ) -> Result<(), ContactError>
    where
        I: InputSource<K>,
        E: Events<K>,
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
        let (mut stepper, mut passing) = (self.stepper((start, q0, z0))?, EventWatch::new(start, end));
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
                let target = if E::SAMPLED && rest >= -rounding { until } else { end_of_step };
                let reached = self.advance(&mut stepper, &mut passing, (length, target), made)?;
                seen(made);
                if matches!(reached, StepEnd::End) {
                    return Ok(());
                }
                if E::SAMPLED && stepper.t == until && until < end {
                    until = self.sample(&stepper, end)?;
                }
                if matches!(reached, StepEnd::Target) && !is_cut {
                    break;
                }
                length = end_of_step - stepper.t;
            }
        }
        Ok(())
    }

    /// One step of a run, of a length with which it comes to a time, or to an event before that which makes the state
    /// jump.
    fn advance(
        &mut self,
        stepper: &mut ContactStepper<'k, K>,
        passing: &mut EventWatch,
        (length, target): (f64, f64),
        made: &mut SteppedRun<'k, K>,
    ) -> Result<StepEnd, ContactError>
    where
        I: InputSource<K>,
        E: Events<K>,
    {
        let (before, mut tried) = (E::ANY.then(|| stepper.kept()), length);
        let problem = problem(self.kernel, &self.input);
        loop {
            stepper.step(tried, &held(&self.input, stepper, tried))?;
            if tried == length {
                stepper.t = target;
            }
            made.samples.push(StepSample::of(stepper));
            let verdict = passing.look(&mut self.events, made)?;
            let (Some(before), EventOutcome::TooLong | EventOutcome::Fails(_) | EventOutcome::Jumps(..)) =
                (&before, &verdict)
            else {
                return Ok(match verdict {
                    EventOutcome::Ended => StepEnd::End,
                    _ if tried == length => StepEnd::Target,
                    _ => StepEnd::Before,
                });
            };
            match verdict {
                EventOutcome::Jumps(number, near) => {
                    let again = &mut |length: f64| {
                        stepper.restore(before);
                        stepper.step(length, &held(&self.input, stepper, length))?;
                        Ok(StepSample::of(stepper))
                    };
                    let ended = passing.jump((&mut self.events, &problem), made, (number, near), again)?;
                    if ended {
                        return Ok(StepEnd::End);
                    }
                    return self.restart(stepper, made, target);
                }
                EventOutcome::TooLong => {
                    made.samples.pop();
                    stepper.restore(before);
                    tried *= SHORTER;
                }
                EventOutcome::Fails(kind) => {
                    made.samples.pop();
                    return Err(jumps::error(&problem, &made.last_state(), kind));
                }
                EventOutcome::On | EventOutcome::Ended => {}
            }
        }
    }

    /// Begins anew at the last state of a run, after a jump.
    fn restart(
        &self,
        stepper: &mut ContactStepper<'k, K>,
        made: &SteppedRun<'k, K>,
        target: f64,
    ) -> Result<StepEnd, ContactError> {
        let Sample { t, q, z, .. } = made.last_state();
        *stepper = self.stepper((t, q, z))?;
        let is_there = target - t <= ROUNDINGS * f64::EPSILON * target.abs();
        if is_there {
            stepper.t = target;
        }
        Ok(if is_there { StepEnd::Target } else { StepEnd::Before })
    }

    /// Lets controllers sample where the steps are; until when they hold what they give.
    fn sample(&mut self, stepper: &ContactStepper<'k, K>, end: f64) -> Result<f64, ContactError>
    where
        I: InputSource<K>,
        E: Events<K>,
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

    /// At the start of a run, or after a jump.
    pub(super) fn stepper(
        &self,
        (t, q, z): (f64, K::Configuration, K::Speeds),
    ) -> Result<ContactStepper<'k, K>, ContactError> {
        let stepper = ContactStepper::new(self.kernel, t, q, z)?;
        Ok(stepper.scheme(self.scheme).law(self.law).tolerance(self.tolerance))
    }
}

impl<'k, K: ContactSystem<Scalar = f64>, I, E, G> ContactSteps<'k, K, I, Watched<E, G>> {
    /// Changes the state at the event that was added last, as
    /// [`Simulation::then`](gauss_runtime::integrate::Simulation::then) does. The step in which the event is ends
    /// there, to a rounding of the time, and the next one begins with the state after the jump, as a run does: what the
    /// jump closes further is an impact of that step. [`SteppedRun::state_jumps`] has the states before and after it.
    ///
    /// A jump that leaves a gap below zero ends the run with
    /// [`JumpPenetrates`](ContactErrorKind::JumpPenetrates), one that does not lead back, or piles up, with the errors
    /// of [`event`](gauss_runtime::integrate::drive::event). After a jump steps are as short as the next flight is,
    /// where that would be over within one.
    pub fn then<J: FnMut(&mut Sample<K>)>(self, jump: J) -> ContactSteps<'k, K, I, Watched<E, G, JumpFunction<J>>> {
        self.with_events(|events| events.then(jump, false))
    }

    /// Changes the state as [`then`](Self::then) does, where the function may go on through zero.
    pub fn then_through<J: FnMut(&mut Sample<K>)>(
        self,
        jump: J,
    ) -> ContactSteps<'k, K, I, Watched<E, G, JumpFunction<J>>> {
        self.with_events(|events| events.then(jump, true))
    }
}
