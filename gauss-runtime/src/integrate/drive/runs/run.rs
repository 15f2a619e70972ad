//! One run: the method is driven from jump to jump, and from instant to instant where controllers sample; its samples
//! and events are passed on.

#[cfg(feature = "alloc")]
use alloc::vec::Vec;
use core::ops::{ControlFlow, Range};

use crate::configuration::Configuration;
use crate::integrate::drive::control::{Control, DEFAULT_LIMIT, StepStatistics};
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
use crate::integrate::problem::state::{Rates, State};
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
#[derive(Default)]
pub(in crate::integrate) struct RunResult {
    pub(in crate::integrate) summary: Summary,
    pub(in crate::integrate) stopped_by: Option<usize>,
}

/// So many jumps in a row that are no further apart than rounding tells times apart.
const AT_ONCE: u32 = 3;

/// Jumps, as they follow each other.
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

/// End of a part of a run between two jumps or instants, unless it reached its end.
enum Cut<S: GaussSystem> {
    Stopped(State<S>),
    Jumped(State<S>),
    Failed(IntegrationErrorKind),
}

impl<S: GaussSystem> Cut<S> {
    /// At an event, with the state there and the one that it jumped to; passes on the first, and the second where the
    /// run ends.
    fn at(
        counted: Result<(), IntegrationErrorKind>,
        (state, after): (State<S>, Option<State<S>>),
        stopped: bool,
        pass: &mut dyn FnMut(RunItem<'_, S>),
    ) -> Self {
        pass(RunItem::Sample(&state));
        match (counted, after) {
            (Err(kind), _) => Self::Failed(kind),
            (Ok(()), Some(after)) if !stopped => Self::Jumped(after),
            (Ok(()), after) => {
                if let Some(after) = &after {
                    pass(RunItem::Sample(after));
                }
                Self::Stopped(after.unwrap_or(state))
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
        events: E,
        start: State<S>,
        end: S::Scalar,
        pass: &mut dyn FnMut(RunItem<'_, S>),
    ) -> (RunResult, Result<State<S>, IntegrationError>) {
        let mut watch = Watch::new(self.control, self.problem, events, 0..S::Scalar::LANES);
        let mut jumps = Jumps::new::<S::Scalar>(start.t.lane(0), end.lane(0));
        let mut pace = Pace::new(start.t.lane(0), self.limit);
        let mut reached = RunResult::default();
        let mut passing = PassedStates::new();
        let mut from = match self.begun(watch.events(), start, end) {
            Ok(start) => start,
            Err(kind) => return (reached, Err(IntegrationError::at(self.problem, &start, kind))),
        };
        loop {
            let stop = match self.ticked(watch.events(), &from, end) {
                Ok((held, stop)) => {
                    held.into_iter().for_each(|input| pass(RunItem::Held(from.t, input)));
                    stop
                }
                Err(kind) => {
                    passing.end(pass);
                    return (reached, Err(IntegrationError::at(self.problem, &from, kind)));
                }
            };
            let now = (&mut jumps, &mut reached, &mut passing);
            let (outcome, cut, last) = self.part(&mut watch, now, from, stop, pass);
            let goes_on = E::SAMPLED && stop.lane(0) != end.lane(0);
            if let (true, None, Ok(state)) = (goes_on, &cut, &outcome) {
                (from, passing.resumed) = (*state, true);
                continue;
            }
            passing.end(pass);
            let failed = |kind| Err(IntegrationError::at(self.problem, &last, kind));
            match cut {
                Some(Cut::Jumped(state)) => {
                    (from, passing) = (state, PassedStates::new());
                    let (left, tries) =
                        ((end - from.t).lane(0).abs(), reached.summary.steps + reached.summary.rejected);
                    if pace.jumped(from.t.lane(0), left, tries) {
                        let kind =
                            jumps.told(IntegrationErrorKind::TooManySteps { limit: self.limit }, &reached.summary);
                        return (reached, failed(kind));
                    }
                }
                Some(Cut::Stopped(state)) => return (reached, Ok(state)),
                Some(Cut::Failed(kind)) => return (reached, failed(kind)),
                None => {
                    let outcome = outcome.map_err(|mut error| {
                        // The user set the limit of the whole run, not what was left of it for this part.
                        if let IntegrationErrorKind::TooManySteps { limit } = &mut error.kind {
                            *limit = self.limit;
                        }
                        error.kind = jumps.told(error.kind, &reached.summary);
                        error
                    });
                    return (reached, outcome);
                }
            }
        }
    }

    /// The start of a run, of one with controllers on its constraints, after all checks before the first sample.
    /// Without controllers it is known when the program is compiled.
    fn begun<E: Events<S>>(
        &self,
        events: &mut E,
        start: State<S>,
        end: S::Scalar,
    ) -> Result<State<S>, IntegrationErrorKind> {
        if !E::SAMPLED {
            return Ok(start);
        }
        begin(events, self.problem.held().is_some(), (start.t, end), self.limit)?;
        consistent_start(self.problem, &start)
    }

    /// The input that controllers hold from a state on, and until when.
    fn ticked<E: Events<S>>(
        &self,
        events: &mut E,
        from: &State<S>,
        end: S::Scalar,
    ) -> Result<(Option<S::Input>, S::Scalar), IntegrationErrorKind> {
        if !E::SAMPLED {
            return Ok((None, end));
        }
        tick(events, &self.problem.sample(from), self.problem.held(), end)
    }

    /// From one jump or instant to the next, with the last state that was reached.
    #[expect(clippy::type_complexity, reason = "three things that belong together here alone")]
    fn part<E: Events<S>>(
        &self,
        watch: &mut Watch<'_, P, C, E>,
        (jumps, reached, passing): (&mut Jumps, &mut RunResult, &mut PassedStates<S>),
        start: State<S>,
        end: S::Scalar,
        pass: &mut dyn FnMut(RunItem<'_, S>),
    ) -> (Result<State<S>, IntegrationError>, Option<Cut<S>>, State<S>) {
        let mut cut = None;
        let limit = self.limit.saturating_sub(reached.summary.steps + reached.summary.rejected);
        let outcome =
            self.control.drive(self.problem, start, end, limit, &mut |state, rates, taken: StepStatistics| {
                if core::mem::take(&mut passing.resumed) {
                    // Passed on before; the derivatives are those of another input.
                    passing.before = Some((*state, *rates));
                    return ControlFlow::Continue(());
                }
                if passing.count > 0 {
                    reached.summary.count(taken);
                }
                if E::ANY {
                    let found = match &passing.before {
                        None => watch.begin(state).map(|()| Outcome::On),
                        Some((from, slopes)) => {
                            let made = StepEnds { lane: 0, before: (from, slopes), after: (state, rates) };
                            watch.step(&made, &mut |number, state| pass(RunItem::Event(number, state)))
                        }
                    };
                    cut = match found {
                        Ok(Outcome::On) => None,
                        Ok(Outcome::Here { state, after, number, stopped_by }) => {
                            reached.stopped_by = stopped_by;
                            (passing.held, passing.before) = (false, Some((state, *rates)));
                            let counted = after.map_or(Ok(()), |_| {
                                reached.summary.jumps += 1;
                                jumps.count(state.t.lane(0), number)
                            });
                            Some(Cut::at(counted, (state, after), stopped_by.is_some(), pass))
                        }
                        Err(kind) => Some(Cut::Failed(kind)),
                    };
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
                ControlFlow::Continue(())
            });
        (outcome, cut, passing.before.map_or(start, |(state, _)| state))
    }
}
