//! One run: the method is driven from jump to jump, and from instant to instant where controllers sample; its samples
//! and events are passed on. A run to its end and one by single steps are the same loop.

#[cfg(feature = "alloc")]
use alloc::vec::Vec;
use core::fmt;
use core::ops::{ControlFlow, Range};

use crate::configuration::Configuration;
use crate::integrate::drive::control::{Control, DEFAULT_LIMIT, Progress, StepStatistics};
use crate::integrate::drive::event::{Events, Outcome, Watch};
use crate::integrate::drive::interval::{begin, tick};
use crate::integrate::drive::observer::Observer;
use crate::integrate::drive::pace::Pace;
use crate::integrate::drive::projection::consistent_start;
use crate::integrate::drive::search::StepEnds;
use crate::integrate::drive::summary::{End, Summary};
#[cfg(feature = "alloc")]
use crate::integrate::drive::trajectory::{EventSample, RunData};
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::error::{IntegrationError, IntegrationErrorKind};
use crate::integrate::problem::state::{Rates, State, copy_and_debug};
use crate::real::Real;
use crate::system::GaussSystem;

/// Items that a run passes on.
pub(in crate::integrate) enum RunItem<'a, S: GaussSystem> {
    Sample(&'a State<S>),
    Event(usize, &'a State<S>),
    /// From this time on an input is held.
    Held(S::Scalar, S::Input),
}

/// The data of a run that stay the same during it.
pub(in crate::integrate) struct Run<'a, P, C> {
    control: &'a C,
    problem: &'a P,
    every: u64,
    limit: u64,
}

impl<'a, P, C> Run<'a, P, C> {
    /// A run whose end alone is kept; `limit` is the user's.
    pub(in crate::integrate) fn new(problem: &'a P, control: &'a C, every: u64, limit: Option<u64>) -> Self {
        Self { control, problem, every, limit: limit.unwrap_or(DEFAULT_LIMIT) }
    }

    /// A run whose every n-th sample is kept.
    #[cfg(feature = "alloc")]
    pub(in crate::integrate) fn kept(problem: &'a P, control: &'a C, every: u64, limit: Option<u64>) -> Self {
        let most = (DEFAULT_LIMIT / 10).saturating_mul(every).min(DEFAULT_LIMIT);
        Self { control, problem, every, limit: limit.unwrap_or(most) }
    }
}

/// Summary of a run, and the event that stopped it.
#[derive(Clone, Copy, Default)]
pub(in crate::integrate) struct RunResult {
    pub(in crate::integrate) summary: Summary,
    pub(in crate::integrate) stopped_by: Option<usize>,
}

/// So many jumps in a row that are no further apart than rounding tells times apart.
const AT_ONCE: u32 = 3;

/// Jumps, as they follow each other.
#[derive(Clone, Copy, Debug)]
pub struct Jumps {
    /// Times nearer than this are the same.
    resolution: f64,
    last: Option<f64>,
    in_a_row: u32,
    /// The last one, and how long it came after the one before.
    event: usize,
    interval: f64,
}

impl Jumps {
    /// Before any, in a run between these times.
    pub fn new<T: Real>(start: f64, end: f64) -> Self {
        let unit = T::EPSILON.max(f64::EPSILON);
        Self { resolution: 64.0 * unit * start.abs().max(end.abs()), last: None, in_a_row: 0, event: 0, interval: 0.0 }
    }

    /// Takes one more.
    ///
    /// # Errors
    /// [`IntegrationErrorKind::Zeno`] when they pile up.
    pub fn count(&mut self, t: f64, event: usize) -> Result<(), IntegrationErrorKind> {
        let interval = self.last.map_or(f64::INFINITY, |last| (t - last).abs());
        self.in_a_row = if interval <= self.resolution { self.in_a_row + 1 } else { 0 };
        (self.last, self.event, self.interval) = (Some(t), event, interval);
        if self.in_a_row < AT_ONCE { Ok(()) } else { Err(IntegrationErrorKind::Zeno { event, interval }) }
    }

    /// Why a run ended: where steps have been used up, and every other one of them at least ended with a jump, by
    /// these.
    pub fn told(&self, kind: IntegrationErrorKind, summary: &Summary) -> IntegrationErrorKind {
        match kind {
            IntegrationErrorKind::TooManySteps { .. } if summary.jumps > 0 && 2 * summary.jumps >= summary.steps => {
                let Self { event, interval, .. } = *self;
                IntegrationErrorKind::TooManyJumps { event, jumps: summary.jumps, interval }
            }
            kind => kind,
        }
    }
}

/// Record of the states that a run has passed on since its start or the last jump.
struct PassedStates<S: GaussSystem> {
    count: u64,
    /// The state before, for events.
    before: Option<(State<S>, Rates<S>)>,
    /// Whether that is still to be passed on: it is, at the end or at an error.
    held: bool,
    /// Whether the next state is that one.
    resumed: bool,
}

copy_and_debug!(PassedStates { count, before, held, resumed });

impl<S: GaussSystem> PassedStates<S> {
    const fn new() -> Self {
        Self { count: 0, before: None, held: false, resumed: false }
    }

    /// Passes on what was held back.
    fn end(&mut self, pass: &mut dyn FnMut(RunItem<'_, S>)) {
        if let (true, Some((state, _))) = (core::mem::take(&mut self.held), &self.before) {
            pass(RunItem::Sample(state));
        }
    }
}

/// A run on its way, from step to step.
pub(in crate::integrate) struct RunProgress<S: GaussSystem, M> {
    jumps: Jumps,
    pace: Pace,
    reached: RunResult,
    passing: PassedStates<S>,
    end: S::Scalar,
    /// The start of the part that is on its way, or that is to come, until the next jump or instant.
    from: State<S>,
    part: Option<Progress<S, M>>,
    over: bool,
}

impl<S: GaussSystem, M> RunProgress<S, M> {
    /// Before anything is checked.
    fn new(start: State<S>, end: S::Scalar, limit: u64) -> Self {
        Self {
            jumps: Jumps::new::<S::Scalar>(start.t.lane(0), end.lane(0)),
            pace: Pace::new(start.t.lane(0), limit),
            reached: RunResult::default(),
            passing: PassedStates::new(),
            end,
            from: start,
            part: None,
            over: false,
        }
    }

    /// The state where the run is.
    pub(in crate::integrate) fn state(&self) -> &State<S> {
        self.part.as_ref().map_or(&self.from, |part| &part.state)
    }

    /// The end of the run, if nothing stops it.
    pub(in crate::integrate) fn end(&self) -> S::Scalar {
        self.end
    }

    /// Steps so far, and the event that stopped the run.
    pub(in crate::integrate) fn reached(&self) -> &RunResult {
        &self.reached
    }

    /// Whether no step is to come.
    pub(in crate::integrate) fn is_over(&self) -> bool {
        self.over
    }

    /// Begins the steps anew where the run is: what acts is not what it was, the states passed on are the same.
    pub(in crate::integrate) fn renew(&mut self) {
        if let Some(Progress { state, .. }) = self.part.take() {
            (self.from, self.passing.resumed) = (state, true);
        }
    }

    /// Goes on from another state at the same time, as after a jump.
    pub(in crate::integrate) fn put(&mut self, state: State<S>, pass: &mut dyn FnMut(RunItem<'_, S>)) {
        self.passing.end(pass);
        (self.from, self.part, self.passing) = (state, None, PassedStates::new());
    }
}

// Written by hand: deriving would ask the same of the system, which is only named here.
impl<S: GaussSystem, M: Clone> Clone for RunProgress<S, M> {
    fn clone(&self) -> Self {
        Self { part: self.part.clone(), ..*self }
    }
}

/// The way that a run is to make by one call.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(in crate::integrate) enum Way {
    /// To the start of a step.
    ToStep,
    /// To the end of it.
    OneStep,
    /// To the end of the run.
    Whole,
}

/// The end of a step of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum StepOutcome {
    /// The step was made; the run goes on.
    Step,
    /// The state jumped, by the event of this number: the run goes on from the state after the jump.
    Jump(usize),
    /// The event of this number ended the run.
    Stop(usize),
    /// The run is at the end of its interval.
    End,
}

/// End of a part of a run between two jumps or instants, unless it reached its end.
enum Cut<S: GaussSystem> {
    Stopped(State<S>, usize),
    Jumped(State<S>, usize),
    /// An error, after the last good state.
    Failed(IntegrationErrorKind, State<S>),
}

impl<S: GaussSystem> Cut<S> {
    /// At an event, with the state there and the one that it jumped to; passes on the first, and the second where the
    /// run ends.
    fn at(
        counted: Result<(), IntegrationErrorKind>,
        (state, after): (State<S>, Option<State<S>>),
        (number, stopped_by): (usize, Option<usize>),
        pass: &mut dyn FnMut(RunItem<'_, S>),
    ) -> Self {
        pass(RunItem::Sample(&state));
        match (counted, after) {
            (Err(kind), _) => Self::Failed(kind, state),
            (Ok(()), Some(after)) if stopped_by.is_none() => Self::Jumped(after, number),
            (Ok(()), after) => {
                if let Some(after) = &after {
                    pass(RunItem::Sample(after));
                }
                Self::Stopped(after.unwrap_or(state), stopped_by.unwrap_or(number))
            }
        }
    }
}

impl<S: GaussSystem, P: Problem<System = S>, C: Control<S>> Run<'_, P, C> {
    /// Keeps every sample and event.
    #[cfg(feature = "alloc")]
    pub(in crate::integrate) fn keep<O: Observer<S>, E: Events<S>>(
        &self,
        events: E,
        mut observer: O,
        (q0, z0): (S::Configuration, S::Speeds),
        interval: Range<S::Scalar>,
    ) -> (RunData<S>, Option<IntegrationError>) {
        let problem = self.problem;
        let start = problem.state(interval.start, q0.renormalise(), &z0);
        let (mut samples, mut found, mut held) = (Vec::new(), Vec::new(), Vec::new());
        let (reached, outcome) = self.drive(events, start, interval.end, &mut |seen| match seen {
            RunItem::Sample(state) => {
                let sample = problem.sample(state);
                samples.push(sample);
                observer.see(&sample);
            }
            RunItem::Event(number, state) => {
                let sample = problem.sample(state);
                found.push(EventSample { number, sample });
                observer.event(number, &sample);
            }
            RunItem::Held(t, input) => held.push((t, input)),
        });
        if samples.is_empty() {
            samples.push(problem.sample(&start));
        }
        let RunResult { summary, stopped_by } = reached;
        (RunData { samples, events: found, held, stopped_by, summary }, outcome.err())
    }

    /// Keeps nothing but the end.
    pub(in crate::integrate) fn to_end<O: Observer<S>, E: Events<S>>(
        &self,
        events: E,
        mut observer: O,
        (q0, z0): (S::Configuration, S::Speeds),
        interval: Range<S::Scalar>,
    ) -> Result<End<S>, IntegrationError> {
        let problem = self.problem;
        let start = problem.state(interval.start, q0.renormalise(), &z0);
        let (reached, outcome) = self.drive(events, start, interval.end, &mut |seen| match seen {
            RunItem::Sample(state) => observer.see(&problem.sample(state)),
            RunItem::Event(number, state) => observer.event(number, &problem.sample(state)),
            RunItem::Held(..) => {}
        });
        let state = outcome?;
        Ok(End { sample: problem.sample(&state), stopped_by: reached.stopped_by, summary: reached.summary })
    }

    /// Runs the method and passes on the first, every n-th and the last state reached, both sides of jumps, and the
    /// events between them.
    pub(in crate::integrate) fn drive<E: Events<S>>(
        &self,
        mut events: E,
        start: State<S>,
        end: S::Scalar,
        pass: &mut dyn FnMut(RunItem<'_, S>),
    ) -> (RunResult, Result<State<S>, IntegrationError>) {
        let mut run = RunProgress::new(start, end, self.limit);
        let outcome = self.begun(&mut events, &mut run);
        let outcome = outcome.and_then(|()| self.advance(&mut run, &mut events, Way::Whole, pass));
        (run.reached, outcome.map(|_| *run.state()))
    }

    /// A run before its first step, with the first state passed on.
    pub(in crate::integrate) fn start<E: Events<S>>(
        &self,
        events: &mut E,
        start: State<S>,
        end: S::Scalar,
        pass: &mut dyn FnMut(RunItem<'_, S>),
    ) -> Result<RunProgress<S, C::StepMemory>, IntegrationError> {
        let mut run = RunProgress::new(start, end, self.limit);
        self.begun(events, &mut run)?;
        self.advance(&mut run, events, Way::ToStep, pass)?;
        Ok(run)
    }

    /// Goes on by a step, or to the end, from part to part. After an error the run is at its last state.
    pub(in crate::integrate) fn advance<E: Events<S>>(
        &self,
        run: &mut RunProgress<S, C::StepMemory>,
        events: &mut E,
        way: Way,
        pass: &mut dyn FnMut(RunItem<'_, S>),
    ) -> Result<StepOutcome, IntegrationError> {
        let mut watch = Watch::new(self.control, self.problem, events, 0..S::Scalar::LANES);
        loop {
            let stop = match &run.part {
                Some(part) => part.end,
                None => self.ticked(watch.events(), run, pass)?,
            };
            let (outcome, cut) = self.part(&mut watch, run, (way, stop), pass);
            if let (true, None, Some(Progress { state, ended, .. })) = (outcome.is_ok(), &cut, &run.part) {
                if !ended {
                    return Ok(StepOutcome::Step);
                }
                if E::SAMPLED && stop.lane(0) != run.end.lane(0) {
                    (run.from, run.part, run.passing.resumed) = (*state, None, true);
                    if way == Way::OneStep {
                        return Ok(StepOutcome::Step);
                    }
                    continue;
                }
            }
            run.passing.end(pass);
            match cut {
                Some(Cut::Jumped(state, number)) => {
                    self.jumped(run, state)?;
                    if way != Way::Whole {
                        return Ok(StepOutcome::Jump(number));
                    }
                }
                Some(Cut::Stopped(state, number)) => {
                    (run.from, run.part, run.over) = (state, None, true);
                    return Ok(StepOutcome::Stop(number));
                }
                Some(Cut::Failed(kind, last)) => {
                    (run.from, run.part) = (last, None);
                    return Err(IntegrationError::at(self.problem, &last, kind));
                }
                None => {
                    run.over = outcome.is_ok();
                    return outcome.map(|()| StepOutcome::End).map_err(|error| self.told(run, error));
                }
            }
        }
    }

    /// The error of a part, as one of the whole run.
    #[cold]
    fn told(&self, run: &mut RunProgress<S, C::StepMemory>, mut error: IntegrationError) -> IntegrationError {
        // The user set the limit of the whole run, not what was left of it for this part.
        if let IntegrationErrorKind::TooManySteps { limit } = &mut error.kind {
            *limit = self.limit;
        }
        error.kind = run.jumps.told(error.kind, &run.reached.summary);
        (run.from, run.part) = (*run.state(), None);
        error
    }

    /// Goes on from the state after a jump, unless the end is out of reach by jumps.
    fn jumped(&self, run: &mut RunProgress<S, C::StepMemory>, state: State<S>) -> Result<(), IntegrationError> {
        let last = run.passing.before.map_or(run.from, |(state, _)| state);
        (run.from, run.part, run.passing) = (state, None, PassedStates::new());
        let Summary { steps, rejected, .. } = run.reached.summary;
        if run.pace.jumped(state.t.lane(0), (run.end - state.t).lane(0).abs(), steps + rejected) {
            let kind = IntegrationErrorKind::TooManySteps { limit: self.limit };
            let kind = run.jumps.told(kind, &run.reached.summary);
            return Err(IntegrationError::at(self.problem, &last, kind));
        }
        Ok(())
    }

    /// The start of a run, of one with controllers on its constraints, after all checks before the first sample.
    /// Without controllers it is known when the program is compiled.
    fn begun<E: Events<S>>(
        &self,
        events: &mut E,
        run: &mut RunProgress<S, C::StepMemory>,
    ) -> Result<(), IntegrationError> {
        if E::SAMPLED {
            let from = run.from;
            begin(events, self.problem.held().is_some(), (from.t, run.end), self.limit)
                .and_then(|()| consistent_start(self.problem, &from))
                .map(|start| run.from = start)
                .map_err(|kind| IntegrationError::at(self.problem, &from, kind))?;
        }
        Ok(())
    }

    /// Lets controllers sample the start of a part, and gives the time until which they hold their input.
    fn ticked<E: Events<S>>(
        &self,
        events: &mut E,
        run: &mut RunProgress<S, C::StepMemory>,
        pass: &mut dyn FnMut(RunItem<'_, S>),
    ) -> Result<S::Scalar, IntegrationError> {
        if !E::SAMPLED {
            return Ok(run.end);
        }
        match tick(events, &self.problem.sample(&run.from), self.problem.held(), run.end) {
            Ok((held, stop)) => {
                held.into_iter().for_each(|input| pass(RunItem::Held(run.from.t, input)));
                Ok(stop)
            }
            Err(kind) => {
                run.passing.end(pass);
                Err(IntegrationError::at(self.problem, &run.from, kind))
            }
        }
    }

    /// The cut of a part at a state that it has reached, where an event is on the way there.
    #[inline(always)]
    fn cut<E: Events<S>>(
        watch: &mut Watch<'_, P, C, E>,
        (jumps, reached, passing): (&mut Jumps, &mut RunResult, &mut PassedStates<S>),
        (start, state, rates): (&State<S>, &State<S>, &Rates<S>),
        pass: &mut dyn FnMut(RunItem<'_, S>),
    ) -> Option<Cut<S>> {
        let found = match &passing.before {
            None => watch.begin(state).map(|()| Outcome::On),
            Some((from, slopes)) => {
                let made = StepEnds { lane: 0, before: (from, slopes), after: (state, rates) };
                watch.step(&made, &mut |number, state| pass(RunItem::Event(number, state)))
            }
        };
        match found {
            Ok(Outcome::On) => None,
            Ok(Outcome::Here { state, after, number, stopped_by }) => {
                reached.stopped_by = stopped_by;
                (passing.held, passing.before) = (false, Some((state, *rates)));
                let counted = after.map_or(Ok(()), |_| {
                    reached.summary.jumps += 1;
                    jumps.count(state.t.lane(0), number)
                });
                Some(Cut::at(counted, (state, after), (number, stopped_by), pass))
            }
            Err(kind) => Some(Cut::Failed(kind, passing.before.map_or(*start, |(state, _)| state))),
        }
    }

    /// From one jump or instant to the next, or by one step of that.
    fn part<E: Events<S>>(
        &self,
        watch: &mut Watch<'_, P, C, E>,
        run: &mut RunProgress<S, C::StepMemory>,
        (way, stop): (Way, S::Scalar),
        pass: &mut dyn FnMut(RunItem<'_, S>),
    ) -> (Result<(), IntegrationError>, Option<Cut<S>>) {
        let mut cut = None;
        let RunProgress { jumps, reached, passing, from, part, .. } = run;
        let limit = self.limit.saturating_sub(reached.summary.steps + reached.summary.rejected);
        let emit = &mut |state: &State<S>, rates: &Rates<S>, taken: StepStatistics| {
            if core::mem::take(&mut passing.resumed) {
                // Passed on before; the derivatives are those of another input.
                passing.before = Some((*state, *rates));
                return ControlFlow::Continue(());
            }
            let first = passing.count == 0;
            if !first {
                reached.summary.count(taken);
            }
            if E::ANY {
                cut = Self::cut(watch, (jumps, reached, passing), (from, state, rates), pass);
                if cut.is_some() {
                    return ControlFlow::Break(());
                }
            }
            passing.held = !passing.count.is_multiple_of(self.every);
            if !passing.held {
                pass(RunItem::Sample(state));
            }
            if passing.held || E::ANY {
                passing.before = Some((*state, *rates));
            }
            passing.count += 1;
            if way == Way::OneStep && !first { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let begun = match part {
            Some(_) => Ok(()),
            None => self.control.start(self.problem, *from, stop, limit, emit).map(|begun| *part = Some(begun)),
        };
        let outcome = begun.and_then(|()| match part {
            Some(part) if way != Way::ToStep && !part.ended => self.control.advance(self.problem, part, emit),
            _ => Ok(()),
        });
        (outcome, cut)
    }
}
