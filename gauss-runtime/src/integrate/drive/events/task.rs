//! When a controller samples, and when what it gives acts.

use core::fmt;
use core::marker::PhantomData;

use alloc::collections::VecDeque;

use crate::integrate::drive::schedule::Scheduled;
use crate::integrate::drive::search::Function;
use crate::integrate::drive::watched::{Events, Mark, Visit};
use crate::integrate::problem::error::SamplingMistake;
use crate::integrate::problem::sampled::Controller;
use crate::integrate::problem::state::Sample;
use crate::real::Real;
use crate::sealed::Sealed;
use crate::system::GaussSystem;
use crate::vector_space::VectorSpace;

/// From a sample to its effect.
#[derive(Clone, Copy, Debug)]
enum Delay {
    Samples(u32),
    Time(f64),
}

/// A controller with its instants.
pub struct Task<S: GaussSystem, C> {
    controller: C,
    period: f64,
    delay: Delay,
    initially: S::Input,
    start: S::Scalar,
    /// Samples so far.
    count: u64,
    now: S::Input,
    /// Inputs that are to act, with their times, in this order.
    pending: VecDeque<(S::Scalar, S::Input)>,
}

// Written by hand: deriving would ask the same of the system, which is only named here.
impl<S: GaussSystem, C: Clone> Clone for Task<S, C> {
    fn clone(&self) -> Self {
        let (controller, pending) = (self.controller.clone(), self.pending.clone());
        Self { controller, pending, ..*self }
    }
}

impl<S: GaussSystem<Input: VectorSpace<S::Scalar>>, C> Task<S, C> {
    /// Without a delay.
    pub fn new(period: f64, controller: C) -> Self {
        let (zero, start) = (S::Input::zero(), S::Scalar::zero());
        let (delay, pending) = (Delay::Samples(0), VecDeque::new());
        Self { controller, period, delay, initially: zero, start, count: 0, now: zero, pending }
    }

    /// Acts after so much time.
    #[must_use]
    pub fn delayed(self, delay: f64) -> Self {
        Self { delay: Delay::Time(delay), ..self }
    }

    /// Acts after so many samples.
    #[must_use]
    pub fn delayed_samples(self, samples: u32) -> Self {
        Self { delay: Delay::Samples(samples), ..self }
    }

    /// Sets the input that is held until the first sample acts.
    #[must_use]
    pub fn initially(self, input: S::Input) -> Self {
        Self { initially: input, ..self }
    }

    /// The instants are multiples of the period, not sums of it, as the times of steps of one length are.
    fn time(&self, count: u64) -> S::Scalar {
        S::Scalar::from_f64(count as f64).fma(S::Scalar::from_f64(self.period), self.start)
    }

    /// Whether it is this instant: instants of several periods that coincide on paper are apart by roundings.
    fn is_now(&self, instant: S::Scalar, t: f64) -> bool {
        instant.lane(0) - t <= 8.0 * S::Scalar::EPSILON * t.abs().max(self.start.lane(0).abs())
    }

    /// When the input of a sample acts; nothing where that is at once. What is a whole number of periods but for a few
    /// roundings ends at an instant.
    fn acts(&self, count: u64) -> Option<S::Scalar> {
        let later = |samples: u64| (samples > 0).then(|| self.time(count + samples));
        match self.delay {
            Delay::Samples(samples) => later(samples.into()),
            Delay::Time(delay) => {
                let samples = delay / self.period;
                let whole = (samples + 0.5) as u64;
                if Real::abs(samples - whole as f64) <= 8.0 * f64::EPSILON * samples {
                    later(whole)
                } else {
                    Some(self.time(count) + S::Scalar::from_f64(delay))
                }
            }
        }
    }
}

impl<S: GaussSystem, C> fmt::Debug for Task<S, C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { period, delay, count, now, .. } = self;
        let mut shown = f.debug_struct("Task");
        shown.field("period", period).field("delay", delay).field("count", count).field("now", now);
        shown.finish_non_exhaustive()
    }
}

impl<S, C> Scheduled<S> for Task<S, C>
where
    S: GaussSystem<Input: VectorSpace<S::Scalar>>,
    C: Controller<S>,
{
    fn begin(&mut self, start: S::Scalar) -> Result<(), SamplingMistake> {
        if !(self.period.is_finite() && self.period > 0.0) {
            return Err(SamplingMistake::Period(self.period));
        }
        if let Delay::Time(delay) = self.delay
            && !(delay.is_finite() && delay >= 0.0)
        {
            return Err(SamplingMistake::Delay(delay));
        }
        (self.start, self.count, self.now) = (start, 0, self.initially);
        self.pending.clear();
        self.controller.start();
        Ok(())
    }

    fn period(&self) -> f64 {
        self.period
    }

    fn tick(&mut self, now: &Sample<S>) -> Result<(), SamplingMistake> {
        let t = now.t.lane(0);
        while let Some(&(at, input)) = self.pending.front()
            && self.is_now(at, t)
        {
            self.now = input;
            self.pending.pop_front();
        }
        if self.is_now(self.time(self.count), t) {
            let input = self.controller.sample(now.t, &now.q, &now.z);
            if !input.is_finite() {
                return Err(SamplingMistake::Input);
            }
            match self.acts(self.count) {
                None => self.now = input,
                Some(at) => self.pending.push_back((at, input)),
            }
            self.count += 1;
        }
        Ok(())
    }

    fn next(&self) -> S::Scalar {
        let sample = self.time(self.count);
        self.pending.front().map_or(sample, |&(at, _)| if at.lane(0) < sample.lane(0) { at } else { sample })
    }

    fn added_to(&self, others: Option<S::Input>) -> S::Input {
        others.map_or(self.now, |others| others.add_scaled(S::Scalar::one(), &self.now))
    }
}

/// Events, and a controller that samples.
#[derive(Clone, Debug)]
pub struct Controlled<E, K> {
    /// The events.
    pub others: E,
    /// The controller.
    pub task: K,
}

impl<E, K> Sealed for Controlled<E, K> {}

impl<S: GaussSystem, E: Events<S>, K: Scheduled<S>> Events<S> for Controlled<E, K> {
    const ANY: bool = E::ANY;
    const SAMPLED: bool = true;

    fn count(&self) -> usize {
        self.others.count()
    }

    fn each(&mut self, visit: &mut dyn FnMut(Function<'_, S>, &mut Mark)) {
        self.others.each(visit);
    }

    fn each_bounded(&mut self, visit: &mut Visit<'_, S>) {
        self.others.each_bounded(visit);
    }

    fn jump(&mut self, number: usize, state: &mut Sample<S>) -> bool {
        self.others.jump(number, state)
    }

    fn schedule(&mut self, visit: &mut dyn FnMut(&mut dyn Scheduled<S>)) {
        self.others.schedule(visit);
        visit(&mut self.task);
    }
}

/// Events of one segment of a run that is made of segments: it ends at those whose jumps the run makes itself, and has
/// none of the controllers beside them. The system `T` of a segment may be another one than that of the run, with the
/// same states.
#[derive(Debug)]
pub struct SegmentEvents<'e, S, E> {
    events: &'e mut E,
    system: PhantomData<fn(S)>,
}

impl<'e, S, E> SegmentEvents<'e, S, E> {
    /// Events of a run on a system.
    pub fn of(events: &'e mut E) -> Self {
        Self { events, system: PhantomData }
    }
}

impl<S, E> Sealed for SegmentEvents<'_, S, E> {}

impl<S, T, E> Events<T> for SegmentEvents<'_, S, E>
where
    S: GaussSystem,
    T: GaussSystem<Scalar = S::Scalar, Configuration = S::Configuration, Speeds = S::Speeds>,
    E: Events<S>,
{
    const ANY: bool = E::ANY;

    fn count(&self) -> usize {
        self.events.count()
    }

    fn each(&mut self, visit: &mut dyn FnMut(Function<'_, T>, &mut Mark)) {
        self.events.each(&mut |function, mark| mark.ending_at_jumps(|mark| visit(function, mark)));
    }

    fn jump(&mut self, _: usize, _: &mut Sample<T>) -> bool {
        false
    }
}
