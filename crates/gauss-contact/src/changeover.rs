//! Runs that change over from events to steps where events pile up, and back.
//!
//! A run begins with events. It goes on in steps from where
//! - more than so many events, at several contacts, come within so short a time ([`ContactErrorKind::EventsPile`]),
//! - impacts at several gaps, or changes of modes, follow each other without end ([`ContactErrorKind::Zeno`],
//!   [`ContactErrorKind::Chatter`]),
//! - no forces were found that satisfy the laws ([`ContactErrorKind::Unsolved`]),
//! - a gap was found closed too late ([`ContactErrorKind::Penetration`]); what was made since the last
//!   event is left out.
//!
//! All other errors end it. It returns to events when no gap has closed for a while. Where these come to less than that
//! while before they pile up again, the next part in steps is at least twice as long as the one before.

use alloc::rc::Rc;
use alloc::vec::Vec;
use core::ops::Range;

use gauss_runtime::contact::ContactSystem;
use gauss_runtime::integrate::drive::simulation::NoControl;
use gauss_runtime::integrate::drive::tolerance::Tolerance;
use gauss_runtime::integrate::{Control, InputSource, NoInput, Sample};

use crate::error::{ContactError, ContactErrorKind};
use crate::impact::Impact;
use crate::mode::InMode;
use crate::residual::Residual;
use crate::run::ContactRun;
use crate::steps::{ContactStepper, StepSample, StepScheme, SteppedRun};
use crate::trajectory::{ContactTrajectory, InputOf};

/// Events within the time of these steps pile up, unless the run says otherwise.
const SPAN: f64 = 10.0;
/// Most events in that time that do not pile up: so many, and so many for each contact.
const EVENTS: usize = 50;
const EVENTS_EACH: usize = 4;
/// Steps without an impact after which events are tried again.
const QUIET: f64 = 50.0;

/// A run that changes over to steps and back, in preparation: see [`ContactRun::changing_over`].
#[derive(Clone, Copy, Debug)]
#[must_use = "a run does nothing before `run`"]
pub struct ChangingRun<'k, K, C = NoControl, I = NoInput> {
    run: ContactRun<'k, K, C, I>,
    h: f64,
    scheme: StepScheme,
    events: usize,
    span: f64,
    quiet: f64,
}

/// A part of a run from event to event.
pub struct EventPart<'k, K: ContactSystem> {
    /// The motion.
    pub trajectory: ContactTrajectory<'k, K>,
    /// Tolerance of its errors between events and of the times of these: relative, then absolute; see
    /// [`ContactRun::tolerance`].
    pub tolerance: [f64; 2],
}

/// A part of a run in steps of one length.
#[derive(Debug)]
#[non_exhaustive]
pub struct StepPart<'k, K: ContactSystem<Scalar = f64>> {
    /// The steps.
    pub samples: SteppedRun<'k, K>,
    /// Why there were no events any more.
    pub because: ContactError,
    /// The length of the steps: impacts are known to that time, so that places after one are off by it times what
    /// speeds jump by. Between impacts errors are of the order of the scheme.
    pub h: f64,
    /// Number of gaps that have closed, in all.
    pub impacts: usize,
    /// The worst residuals of the laws.
    pub residual: Residual,
    /// The longest way on which a gap closed within a step.
    pub closure: f64,
}

/// A part of a run with what its errors are.
pub enum RunPart<'k, K: ContactSystem<Scalar = f64>> {
    /// From event to event, to a tolerance.
    Events(EventPart<'k, K>),
    /// In steps: of first order at impacts.
    Steps(StepPart<'k, K>),
}

/// A run that has changed over to steps and back: its parts, in order of time.
pub struct ChangingTrajectory<'k, K: ContactSystem<Scalar = f64>> {
    parts: Vec<RunPart<'k, K>>,
}

impl<'k, K: ContactSystem<Scalar = f64>> RunPart<'k, K> {
    /// The states in order: those of events, or the ends of steps.
    pub fn iter(&self) -> impl Iterator<Item = Sample<K>> {
        let (events, steps) = match self {
            Self::Events(part) => (Some(part.trajectory.iter()), None),
            Self::Steps(part) => (None, Some(part.samples.iter().map(|step| step.state))),
        };
        events.into_iter().flatten().chain(steps.into_iter().flatten())
    }

    /// The last state; `None` where the part ended before its first step.
    #[must_use]
    pub fn last(&self) -> Option<Sample<K>> {
        match self {
            Self::Events(part) => part.trajectory.last(),
            Self::Steps(part) => part.samples.last().map(|step| step.state),
        }
    }
}

impl<'k, K: ContactSystem<Scalar = f64>> ChangingTrajectory<'k, K> {
    /// The parts in order; none is empty.
    #[must_use]
    pub fn parts(&self) -> &[RunPart<'k, K>] {
        &self.parts
    }

    /// The states of all parts in order.
    pub fn iter(&self) -> impl Iterator<Item = Sample<K>> {
        self.parts.iter().flat_map(RunPart::iter)
    }

    /// The last state; `None` where the run ended before its first step.
    #[must_use]
    pub fn last(&self) -> Option<Sample<K>> {
        self.parts.last().and_then(RunPart::last)
    }
}

impl<'k, K: ContactSystem<Scalar = f64>, C, I> ContactRun<'k, K, C, I> {
    /// A run that goes on in steps of length `h` where events pile up, and returns to events when nothing has struck
    /// for the time of 50 steps. Events pile up where more than 50, and four for each contact, come within the time of
    /// ten steps at several contacts; where impacts at several gaps or changes of modes do not end; where no
    /// forces were found, and where a gap was found closed too late.
    ///
    /// Impacts go by Newton's law. The trajectory says which part was made how, and what its errors are.
    pub fn changing_over(self, h: f64) -> ChangingRun<'k, K, C, I> {
        let events = EVENTS + EVENTS_EACH * self.kernel.contacts().len();
        ChangingRun { run: self, h, scheme: StepScheme::default(), events, span: SPAN * h, quiet: QUIET * h }
    }
}

impl<'k, K: ContactSystem<Scalar = f64>, C, I> ChangingRun<'k, K, C, I> {
    /// More than so many events within so long a time pile up, where they are of several contacts.
    pub fn piles(mut self, events: usize, span: f64) -> Self {
        (self.events, self.span) = (events.max(1), span);
        self
    }

    /// Sets the time for which no gap may close before events are tried again.
    pub fn quiet(mut self, span: f64) -> Self {
        self.quiet = span;
        self
    }

    /// Sets how steps take the motion between impacts.
    pub fn scheme(mut self, scheme: StepScheme) -> Self {
        self.scheme = scheme;
        self
    }

    /// Runs from (q₀, z₀) over the interval, forward in time.
    ///
    /// # Errors
    /// When the end is not reached; [`attempt`](Self::attempt) then gives the part that was made. Those of runs from
    /// event to event that are no piling up, and those of steps; `InvalidStep`, `LawWithoutSteps`.
    pub fn run(
        self,
        q0: K::Configuration,
        z0: K::Speeds,
        interval: Range<f64>,
    ) -> Result<ChangingTrajectory<'k, K>, ContactError>
    where
        C: Control<InMode<'k, K>> + Clone + 'k,
        I: InputSource<K> + 'k,
    {
        match self.attempt(q0, z0, interval) {
            (trajectory, None) => Ok(trajectory),
            (_, Some(error)) => Err(error),
        }
    }

    /// Like [`run`](Self::run), but gives the parts that were made when the end is not reached, with the reason.
    pub fn attempt(
        self,
        q0: K::Configuration,
        z0: K::Speeds,
        interval: Range<f64>,
    ) -> (ChangingTrajectory<'k, K>, Option<ContactError>)
    where
        C: Control<InMode<'k, K>> + Clone + 'k,
        I: InputSource<K> + 'k,
    {
        let mut made = ChangingTrajectory { parts: Vec::new() };
        if let Err(error) = self.check(interval.start) {
            return (made, Some(error));
        }
        let Self { run, h, scheme, events, span, quiet } = self;
        let (run, input) = run.parted();
        let input: InputOf<'k, K> = Rc::new(move |t, q, z| input.input(t, q, z));
        let mut driver =
            Driver { run, input, h, scheme, piles: (events, span), quiet, end: interval.end, least: quiet };
        let error = driver.go((interval.start, q0, z0), &mut made.parts).err();
        (made, error)
    }

    fn check(&self, time: f64) -> Result<(), ContactError> {
        let stop = |kind| Err(ContactError { contact: None, time, kind });
        for length in [self.h, self.span, self.quiet] {
            if !(length > 0.0 && length.is_finite()) {
                return stop(ContactErrorKind::InvalidStep { step: length });
            }
        }
        match self.run.settings.law {
            Impact::Newton => Ok(()),
            law => stop(ContactErrorKind::LawWithoutSteps { law }),
        }
    }
}

/// Whether steps can go on from there.
fn piles_up(error: &ContactError) -> bool {
    use ContactErrorKind::{Chatter, EventsPile, Penetration, Unsolved, Zeno};
    matches!(error.kind, EventsPile { .. } | Zeno { .. } | Chatter { .. } | Unsolved { .. } | Penetration { .. })
}

/// A time with its state.
type At<K> =
    (f64, <K as gauss_runtime::system::GaussSystem>::Configuration, <K as gauss_runtime::system::GaussSystem>::Speeds);

/// A run on its way.
struct Driver<'k, K: ContactSystem<Scalar = f64>, C> {
    run: ContactRun<'k, K, C>,
    input: InputOf<'k, K>,
    h: f64,
    scheme: StepScheme,
    piles: (usize, f64),
    quiet: f64,
    end: f64,
    /// Least length of the next part in steps.
    least: f64,
}

impl<'k, K: ContactSystem<Scalar = f64>, C> Driver<'k, K, C>
where
    C: Control<InMode<'k, K>> + Clone + 'k,
{
    fn go(&mut self, mut from: At<K>, parts: &mut Vec<RunPart<'k, K>>) -> Result<(), ContactError> {
        loop {
            let start = from.0;
            let because = match self.events(&mut from, parts) {
                Some(error) if piles_up(&error) => error,
                Some(error) => return Err(error),
                None => return Ok(()),
            };
            let has_stepped = parts.iter().any(|part| matches!(part, RunPart::Steps(_)));
            let soon = has_stepped && from.0 - start < self.quiet;
            self.least = if soon { 2.0 * self.least } else { self.quiet };
            if self.steps(&mut from, because, parts)? {
                return Ok(());
            }
        }
    }

    /// Events from a state on, to the end or to where they cannot go on.
    fn events(&self, from: &mut At<K>, parts: &mut Vec<RunPart<'k, K>>) -> Option<ContactError> {
        let (t, q, z) = *from;
        let (mut made, error) =
            self.run.again().attempt_with((Rc::clone(&self.input), None), Some(self.piles), (q, z), t..self.end);
        if let Some(ContactErrorKind::Penetration { .. }) = error.as_ref().map(|error| &error.kind)
            && let Some(segment) = made.segments.pop()
        {
            let Sample { t, q, z, .. } = *segment.trajectory.first();
            *from = (t, q, z);
            if !made.segments.is_empty() {
                parts.push(self.part(made));
            }
        } else if let Some(last) = made.last() {
            *from = (last.t, last.q, last.z);
            parts.push(self.part(made));
        }
        error
    }

    fn part(&self, trajectory: ContactTrajectory<'k, K>) -> RunPart<'k, K> {
        let Tolerance { relative, absolute } = self.run.settings.tolerance::<InMode<'k, K>>(&self.run.control);
        RunPart::Events(EventPart { trajectory, tolerance: [relative, absolute] })
    }

    /// Steps until nothing has struck for a while; whether they are at the end.
    fn steps(
        &self,
        from: &mut At<K>,
        because: ContactError,
        parts: &mut Vec<RunPart<'k, K>>,
    ) -> Result<bool, ContactError> {
        let (start, q, z) = *from;
        let mut part = StepPart {
            samples: SteppedRun::begun(self.run.kernel, (start, q, z)),
            because,
            h: self.h,
            impacts: 0,
            residual: Residual::default(),
            closure: 0.0,
        };
        let made = self.go_in_steps((start, q, z), &mut part);
        if let Some(last) = part.samples.last() {
            *from = (last.state.t, last.state.q, last.state.z);
            parts.push(RunPart::Steps(part));
        }
        made.map(|()| from.0 >= self.end)
    }

    fn go_in_steps(&self, (start, q, z): At<K>, part: &mut StepPart<'k, K>) -> Result<(), ContactError> {
        let mut stepper = ContactStepper::new(self.run.kernel, start, q, z)?.scheme(self.scheme);
        let mut struck = start;
        for n in 1_u64.. {
            // Times are multiples of the length, not sums of it; what is left at the end is no step if it is rounding.
            let next = self.h * n as f64 + start;
            let end = if self.end - next <= 1e-9 * self.h { self.end } else { next };
            let (t, q, z) = (stepper.time(), *stepper.configuration(), *stepper.speeds());
            let report = stepper.step(end - t, &(self.input)(t, &q, &z))?;
            stepper.at_time(end);
            part.impacts += report.impacts;
            part.residual = part.residual.worse(report.residual);
            part.closure = part.closure.max(report.closure);
            part.samples.samples.push(StepSample::of(&stepper));
            if report.impacts > 0 {
                struck = end;
            }
            let is_quiet = end - struck >= self.quiet && end - start >= self.least;
            if is_quiet || end >= self.end {
                return Ok(());
            }
        }
        Ok(())
    }
}
