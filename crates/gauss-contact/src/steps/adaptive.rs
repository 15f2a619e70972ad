//! Steps as long as a tolerance allows between impacts, and no shorter than a bound at them.
//!
//! Each step is made once as a whole and once in halves; the halves are kept, and what the two differ by is the
//! estimate, which is the error of the whole. In a smooth part, where no contact changes what it does, lengths follow
//! from the order of the scheme. A step in which a gap closes or opens or a slip begins, ends or turns back has an
//! error of first order in its length whatever the scheme: it is shortened to a quarter until it is within the
//! tolerance, but not below the shortest length, at which it is accepted with the error that it has. The step after it
//! is as long as that before the change was looked for. Of a step with an impact places alone are judged: speeds jump,
//! at a time that is known to a step.

use core::ops::Range;

use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::integrate::drive::event::{Events, NoEvents};
use gauss_runtime::integrate::problem::state::TangentOf;
use gauss_runtime::integrate::{InputSource, NoInput, Sample};
use gauss_runtime::real::Real;

use crate::error::{ContactError, ContactErrorKind};
use crate::mode::Mode;
use crate::{jumps, sampling};

use super::kept::Kept;
use super::made::{StepSample, StepStatistics, SteppedRun};
use super::passing::{EventOutcome, EventWatch};
use super::report::StepReport;
use super::run::{ContactSteps, held, problem};
use super::stepper::ContactStepper;

/// The order of steps in which contacts stay as they are.
const ORDER: f64 = 2.0;
/// The part of the length that a tolerance allows which is tried.
const SAFETY: f64 = 0.9;
/// Least and largest ratio of the length of the next step to that of this one.
const SHORTER: f64 = 0.2;
const LONGER: f64 = 4.0;
/// Factor by which a step is shortened that is too long for a change of contacts.
const NEARER: f64 = 0.25;
/// The shortest step at impacts unless said otherwise, as a part of the longest.
const SHORTEST: f64 = 1e-3;
/// Times within half of a step at which the input is looked at beside its start, as parts of it. Its end is one of
/// them: what begins before it is seen as long as it lasts from there to the next.
const LOOKS: [f64; 4] = [0.25, 0.5, 0.75, 1.0];
/// Roundings of the time that a step takes at least.
const ROUNDINGS: f64 = 16.0;
const MOST_STEPS: u64 = 10_000_000;
/// The estimate of a step that has none: it is too long.
const UNSEEN: f64 = 1e9;

/// A run in steps that keep a tolerance, in preparation: see [`ContactSteps::adaptive`].
#[derive(Clone, Copy, Debug)]
#[must_use = "a run does nothing before `run`"]
pub struct AdaptiveContactSteps<'k, K, I = NoInput, E = NoEvents> {
    steps: ContactSteps<'k, K, I, E>,
    relative: f64,
    absolute: f64,
    shortest: f64,
    limit: u64,
}

impl<'k, K: ContactSystem<Scalar = f64>, I, E> ContactSteps<'k, K, I, E> {
    /// Steps as long as tolerances allow: a component may err by `absolute`, plus `relative` times its size, in each
    /// step between impacts; the length that was given is that of the longest. At impacts steps are no shorter than a
    /// thousandth of it: see [`shortest`](AdaptiveContactSteps::shortest). What a contact does after an impact is off
    /// by what it does in such a time.
    ///
    /// An input is held during half of a step, as it is at the start of that; where it changes with time or state, that
    /// is of first order, and steps are as short as it asks for. It is looked at eight times in a step, as forces are
    /// of the scene that depend on the time: a push that is shorter than an eighth of the longest step may be missed.
    pub fn adaptive(self, relative: f64, absolute: f64) -> AdaptiveContactSteps<'k, K, I, E> {
        let (shortest, limit) = (SHORTEST * self.h, self.limit.unwrap_or(MOST_STEPS));
        AdaptiveContactSteps { steps: self, relative, absolute, shortest, limit }
    }
}

impl<'k, K: ContactSystem<Scalar = f64>, I, E> AdaptiveContactSteps<'k, K, I, E> {
    /// The length at which steps with impacts are no longer shortened, in place of a thousandth of the longest.
    pub fn shortest(mut self, length: f64) -> Self {
        self.shortest = length;
        self
    }

    /// The most steps before the run is given up, instead of ten million, with those that are too long.
    pub fn max_steps(mut self, limit: u64) -> Self {
        self.limit = limit;
        self
    }

    /// Steps from (q₀, z₀) over the interval, forward in time.
    ///
    /// # Errors
    /// When the end is not reached; [`attempt`](Self::attempt) then gives the part that was made. `InvalidStep`,
    /// `InvalidTolerance`, `InvalidInterval`, `StepTooSmall`, `TooManySteps`, and those of steps.
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
        let mut made = SteppedRun::begun(self.steps.kernel, (interval.start, q0, z0));
        let error = self.go((q0, z0), interval, &mut made).err();
        (made, error)
    }

    fn check(&self, interval: &Range<f64>) -> Result<(), ContactError> {
        let stop = |kind| Err(ContactError { contact: None, time: interval.start, kind });
        let (longest, shortest) = (self.steps.h, self.shortest);
        let (relative, absolute) = (self.relative, self.absolute);
        if !(longest > 0.0 && longest.is_finite()) {
            return stop(ContactErrorKind::InvalidStep { step: longest });
        }
        if !(shortest > 0.0 && shortest <= longest) {
            return stop(ContactErrorKind::InvalidStep { step: shortest });
        }
        let valid = |tolerance: f64| tolerance >= 0.0 && tolerance.is_finite();
        if !(valid(relative) && valid(absolute) && relative + absolute > 0.0) {
            return stop(ContactErrorKind::InvalidTolerance { relative, absolute });
        }
        if !(interval.start.is_finite() && interval.end.is_finite() && interval.start <= interval.end) {
            return stop(ContactErrorKind::InvalidInterval);
        }
        Ok(())
    }

    fn go(
        self,
        start: (K::Configuration, K::Speeds),
        interval: Range<f64>,
        made: &mut SteppedRun<'k, K>,
    ) -> Result<(), ContactError>
    where
        I: InputSource<K>,
        E: Events<K>,
    {
        self.steps.check_every(interval.start)?;
        self.check(&interval)?;
        let Self { steps, relative, absolute, shortest, limit } = self;
        let (steps, events) = steps.parted();
        let steps = AdaptiveContactSteps { steps, relative, absolute, shortest, limit };
        let stepper = steps.stepper((interval.start, start.0, start.1))?;
        let (lengths, passing) = (Lengths::new(steps.steps.h, shortest), EventWatch::new(interval.start, interval.end));
        let mut on_way =
            AdaptiveDriver { steps, events, stepper, lengths, passing, until: 0.0, end: interval.end, fresh: true };
        on_way.go(interval.start, made)
    }

    /// At the start of a run, or after a jump.
    fn stepper(&self, start: (f64, K::Configuration, K::Speeds)) -> Result<ContactStepper<'k, K>, ContactError> {
        let mut stepper = self.steps.stepper(start)?;
        // A step that is made in parts does not differ from its halves where these are; impacts are made short anyway.
        stepper.accounts = false;
        Ok(stepper)
    }

    /// A step as a whole and in halves; the stepper is at the end of these.
    fn trial(
        &self,
        stepper: &mut ContactStepper<'k, K>,
        (before, starts): (&Kept<K>, bool),
        h: f64,
    ) -> Result<Trial, ContactError>
    where
        I: InputSource<K>,
    {
        // At the start, not at the middle as in steps of one length: with that, edges of pushes took minutes.
        let input = |stepper: &ContactStepper<'k, K>| held(&self.steps.input, stepper, 0.0);
        stepper.step(h, &input(stepper))?;
        let (whole, in_parts) = (stepper.kept(), stepper.report.parts > 0);
        let (mut impacts, closure) = (stepper.report.impacts, stepper.report.closure);
        stepper.restore(before);
        let unheld = self.unheld(stepper, h);
        let first = stepper.step(0.5 * h, &input(stepper))?;
        let of_first = stepper.impulses;
        let middle = stepper.kept();
        let unheld = unheld.add_scaled(1.0, &self.unheld(stepper, h));
        let second = stepper.step(0.5 * h, &input(stepper))?;
        let end = stepper.kept();
        impacts += first.impacts + second.impacts;
        // At the start what contacts do is not known yet.
        let count = stepper.kernel.contacts().len();
        let differs = !starts && (before.differs(&whole, count) || before.differs(&middle, count));
        let changes = differs || middle.differs(&end, count) || whole.differs(&end, count) || impacts > 0;
        stepper.impulses = stepper.impulses.add_scaled(1.0, &of_first);
        let parts = if first.parts + second.parts > 0 { first.parts.max(1) + second.parts.max(1) } else { 0 };
        let report = StepReport { parts, ..first.and(second) };
        let estimate = self.estimate((before, &whole, &end), &unheld, impacts > 0);
        // A flight that is shorter than half of the step is not seen: what closes has left out its way.
        let estimate = estimate.max(closure / (self.absolute + self.relative * closure).max(f64::MIN_POSITIVE));
        // A step that was made in parts is its halves, or nearly: what these err by is not seen.
        let estimate = if in_parts && !changes { UNSEEN } else { estimate };
        if !estimate.is_finite() {
            return Err(stepper.error(None, ContactErrorKind::NonFinite));
        }
        Ok(Trial { estimate, changes, report })
    }

    /// The change of the speeds by what changes with time in half of a step, from its start on, beside that which the
    /// step takes: by the input beside that which is held, without regard to its sign, and by the scene's own forces
    /// beside those in the middle. Without contacts.
    fn unheld(&self, stepper: &ContactStepper<'k, K>, h: f64) -> K::Speeds
    where
        I: InputSource<K>,
    {
        let (t, q, z, kernel) = (stepper.t, &stepper.q, &stepper.z, stepper.kernel);
        let mut sum = K::Speeds::zero();
        // Then nothing depends on the time, and there is no input.
        if kernel.keeps_energy() {
            return sum;
        }
        let (looks, part) = (LOOKS.map(|part| t + 0.5 * h * part), 0.5 * h / LOOKS.len() as f64);
        let mut add = |off: K::Speeds| {
            (0..K::Speeds::DIM).for_each(|i| sum.set_component(i, sum.component(i) + part * off.component(i).abs()));
        };
        let input = |at: f64| self.steps.input.input(at, q, z);
        let held = input(t);
        let [a, b, c, d] = looks.map(|at| kernel.acceleration(at, q, z, &held));
        if size_of::<K::Input>() > 0 {
            for (at, forces) in looks.into_iter().zip([&a, &b, &c, &d]) {
                add(kernel.acceleration(at, q, z, &input(at)).add_scaled(-1.0, forces));
            }
        }
        // By the trapezoidal rule, which is of the order of a step.
        let ends = kernel.acceleration(t, q, z, &held).add_scaled(1.0, &d).scale(0.5);
        add(ends.add_scaled(1.0, &a).add_scaled(-3.0, &b).add_scaled(1.0, &c));
        sum
    }

    /// Error of a step as a whole, over the tolerance: the largest of all components, of places alone where speeds
    /// jump. `unheld`: what the input adds to speeds that steps have not seen.
    fn estimate(&self, (before, whole, end): (&Kept<K>, &Kept<K>, &Kept<K>), unheld: &K::Speeds, jumps: bool) -> f64 {
        let over = |off: f64, size: f64| off.abs() / (self.absolute + self.relative * size).max(f64::MIN_POSITIVE);
        let larger = |worst: f64, x: f64| if x > worst || x.is_nan() { x } else { worst };
        let off = end.q.difference(&whole.q);
        let size = |i: usize| before.q.magnitude(i).max(end.q.magnitude(i));
        let places = (0..TangentOf::<K>::DIM).map(|i| over(off.component(i), size(i))).fold(0.0, larger);
        if jumps {
            return places;
        }
        let speed = |i: usize| {
            let [before, whole, end] = [before, whole, end].map(|kept| kept.z.component(i));
            over(larger((end - whole).abs(), unheld.component(i)), before.abs().max(end.abs()))
        };
        (0..K::Speeds::DIM).map(speed).fold(places, larger)
    }
}

/// A run on its way.
struct AdaptiveDriver<'k, K: ContactSystem<Scalar = f64>, I, E> {
    steps: AdaptiveContactSteps<'k, K, I>,
    events: E,
    stepper: ContactStepper<'k, K>,
    lengths: Lengths,
    passing: EventWatch,
    /// Until when controllers hold what they give.
    until: f64,
    end: f64,
    /// Whether what contacts do is not known yet.
    fresh: bool,
}

impl<'k, K: ContactSystem<Scalar = f64>, I: InputSource<K>, E: Events<K>> AdaptiveDriver<'k, K, I, E> {
    fn go(&mut self, start: f64, made: &mut SteppedRun<'k, K>) -> Result<(), ContactError> {
        let (holds, limit) = (self.steps.steps.input.held().is_some(), self.steps.limit);
        sampling::begin::<K, E>(&mut self.events, holds, (start, self.end), Some(limit))?;
        self.sample()?;
        while self.stepper.t < self.end {
            let (before, statistics) = (self.stepper.kept(), &mut made.statistics);
            if statistics.accepted + statistics.rejected >= limit {
                return Err(self.stepper.error(None, ContactErrorKind::TooManySteps { limit }));
            }
            let (h, last) = self.lengths.within(self.until - before.t);
            let trial = self.steps.trial(&mut self.stepper, (&before, self.fresh), h);
            let least = ROUNDINGS * f64::EPSILON * before.t.abs().max(h);
            match self.lengths.judge(h, trial.as_ref().ok()) {
                Verdict::Keep => {
                    self.stepper.t = if last { self.until } else { before.t + h };
                    if self.keep(made, &before, (h, trial?))? {
                        return Ok(());
                    }
                    if self.stepper.t == self.until && self.stepper.t < self.end {
                        self.sample()?;
                    }
                }
                Verdict::Shorten if self.lengths.next >= least && self.lengths.next < h => {
                    statistics.rejected += 1;
                    self.stepper.restore(&before);
                }
                Verdict::Shorten => {
                    self.stepper.restore(&before);
                    trial?;
                    return Err(self.stepper.error(None, ContactErrorKind::StepTooSmall { step: h }));
                }
            }
        }
        Ok(())
    }

    /// Lets controllers sample where the steps are.
    fn sample(&mut self) -> Result<(), ContactError> {
        let Self { steps, events, stepper, end, .. } = self;
        let now = (stepper.time(), stepper.configuration(), stepper.speeds());
        let held = steps.steps.input.held();
        self.until = sampling::tick(events, steps.steps.kernel, now, (held, *end))?.0;
        Ok(())
    }

    /// Keeps a step but for what its events make of it; whether the run has ended.
    fn keep(
        &mut self,
        made: &mut SteppedRun<'k, K>,
        before: &Kept<K>,
        (h, trial): (f64, Trial),
    ) -> Result<bool, ContactError> {
        let Self { steps, events, stepper, lengths, passing, fresh, .. } = self;
        stepper.report = StepReport { estimate: trial.estimate, ..trial.report };
        made.samples.push(StepSample::of(stepper));
        part(stepper);
        match passing.look(events, made)? {
            EventOutcome::On => made.statistics.keep(&trial),
            EventOutcome::Ended => {
                made.statistics.keep(&trial);
                return Ok(true);
            }
            EventOutcome::TooLong => {
                made.samples.pop();
                made.statistics.rejected += 1;
                stepper.restore(before);
                lengths.next = NEARER * h;
                return Ok(false);
            }
            EventOutcome::Fails(kind) => {
                made.samples.pop();
                return Err(jumps::error(&problem(made.kernel, &steps.steps.input), &made.last_state(), kind));
            }
            EventOutcome::Jumps(number, near) => {
                let mut kept = trial;
                let again = &mut |h: f64| {
                    stepper.restore(before);
                    kept = steps.trial(stepper, (before, *fresh), h)?;
                    stepper.report = StepReport { estimate: kept.estimate, ..kept.report };
                    Ok(StepSample::of(stepper))
                };
                let ended = passing.jump(
                    (events, &problem(steps.steps.kernel, &steps.steps.input)),
                    made,
                    (number, near),
                    again,
                )?;
                made.statistics.keep(&kept);
                let Sample { t, q, z, .. } = made.last_state();
                *stepper = steps.stepper((t, q, z))?;
                if self.until - t <= ROUNDINGS * f64::EPSILON * self.until.abs() {
                    stepper.t = self.until;
                }
                self.fresh = true;
                return Ok(ended);
            }
        }
        self.fresh = false;
        Ok(false)
    }
}

/// Opens the contacts that an impact has parted: in the next step, of whatever length, each closes only where its gap
/// does.
fn part<K: ContactSystem<Scalar = f64>>(stepper: &mut ContactStepper<'_, K>) {
    for (i, contact) in stepper.kernel.contacts().iter().enumerate() {
        if contact.has_gap() && !stepper.rests[i] {
            stepper.modes[i] = Mode::Open;
        }
    }
}

/// A step that was tried.
struct Trial {
    /// Over the tolerance.
    estimate: f64,
    /// Whether a contact changes what it does.
    changes: bool,
    report: StepReport,
}

impl StepStatistics {
    fn keep(&mut self, trial: &Trial) {
        self.accepted += 1;
        self.changes += u64::from(trial.changes);
        if trial.estimate > 1.0 {
            self.beyond += 1;
            self.largest_beyond = self.largest_beyond.max(trial.estimate);
        } else {
            self.largest = self.largest.max(trial.estimate);
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Verdict {
    Keep,
    Shorten,
}

/// Lengths of steps.
#[derive(Clone, Copy, Debug)]
struct Lengths {
    longest: f64,
    shortest: f64,
    next: f64,
    /// While a change of contacts is looked for: the length before, and how much time is left until it is passed.
    sought: Option<(f64, f64)>,
}

impl Lengths {
    fn new(longest: f64, shortest: f64) -> Self {
        Self { longest, shortest, next: longest, sought: None }
    }

    /// The next length where so much time is left, and whether it is the last: two steps share what is less than two.
    fn within(&self, left: f64) -> (f64, bool) {
        match self.next {
            next if left <= next => (left, true),
            next if left < 2.0 * next => (0.5 * left, false),
            next => (next, false),
        }
    }

    /// Judges a step, and sets the length of the next one. A step that has no solution is too long.
    fn judge(&mut self, h: f64, trial: Option<&Trial>) -> Verdict {
        let Some(trial) = trial else {
            self.next = NEARER * h;
            return if h > self.shortest { Verdict::Shorten } else { self.give_up() };
        };
        match (trial.changes, trial.estimate <= 1.0) {
            (true, false) if h > self.shortest => {
                let (before, _) = self.sought.unwrap_or((h, h));
                self.sought = Some((before, h));
                self.next = (NEARER * h).max(self.shortest);
                Verdict::Shorten
            }
            (true, _) => {
                self.next = self.sought.take().map_or(h, |(before, _)| before);
                Verdict::Keep
            }
            (false, holds) => {
                let power = -1.0 / (ORDER + 1.0);
                let wanted = SAFETY * Real::powf(trial.estimate.max(1e-9), power);
                self.smooth(h, wanted, holds)
            }
        }
    }

    fn smooth(&mut self, h: f64, wanted: f64, holds: bool) -> Verdict {
        if !holds {
            self.next = h * wanted.clamp(SHORTER, SAFETY);
            return Verdict::Shorten;
        }
        let longer = (h * wanted.clamp(SHORTER, LONGER)).min(self.longest);
        self.next = match self.sought {
            Some((before, left)) if left > h => {
                self.sought = Some((before, left - h));
                h.min(longer)
            }
            Some((before, _)) => {
                self.sought = None;
                before.min(longer)
            }
            None => longer,
        };
        Verdict::Keep
    }

    /// No length is left that could do.
    fn give_up(&mut self) -> Verdict {
        self.next = f64::INFINITY;
        Verdict::Shorten
    }
}
