//! One block of states over an interval of time, each lane on its own when it fails.

use alloc::vec::Vec;
use core::ops::Range;

use gauss_runtime::configuration::Configuration;
use gauss_runtime::integrate::drive::cause::{StopPlace, StopReason, cause};
use gauss_runtime::integrate::drive::control::prepare;
use gauss_runtime::integrate::drive::fixed::steps_between;
use gauss_runtime::integrate::drive::projection::accept;
use gauss_runtime::integrate::{DEFAULT_LIMIT, IntegrationErrorKind, OneStep, Problem, Rates, State};
use gauss_runtime::real::Real;
use gauss_runtime::simd::Packed;

use crate::lanes::{BatchSystem, RunError, SingleConfiguration, SingleSpeeds, number, numbers_of};

/// The interval of time of a run, and the length of its steps.
pub(crate) struct Interval {
    start: f64,
    end: f64,
    step: f64,
}

impl Interval {
    pub(crate) fn new(step: f64, interval: Range<f64>) -> Self {
        Self { start: interval.start, end: interval.end, step }
    }
}

/// A state and the derivatives there.
type AdvancedState<S> = (State<S>, Rates<S>);

/// A lane that stopped, and the state at which it stands still.
struct StoppedLane<S: BatchSystem> {
    lane: usize,
    t: <S::Scalar as Packed>::Single,
    q: SingleConfiguration<S>,
    y: SingleSpeeds<S>,
}

/// Who tries a step.
#[derive(Clone, Copy)]
enum StepTrial {
    /// All that have not stopped, with the first error of a step that has failed before.
    OfTheAble(Option<IntegrationErrorKind>),
    /// One state, because a step of all has failed with this error.
    Alone(usize, IntegrationErrorKind),
}

/// A block on its way. The first `states` lanes are states of the batch; those after them repeat the last one.
struct Block<'a, S: BatchSystem, P, M> {
    problem: &'a P,
    method: &'a M,
    interval: &'a Interval,
    states: usize,
    held: Vec<StoppedLane<S>>,
    failures: Vec<RunError>,
}

/// Carries a block, of which the first `states` lanes count, over the interval. What stopped is returned, by lane; (q,
/// z) then holds the last good state of that lane.
pub(crate) fn advance<S: BatchSystem, P: Problem<System = S>, M: OneStep<S>>(
    problem: &P,
    method: &M,
    interval: &Interval,
    states: usize,
    (q, z): (&mut S::Configuration, &mut S::Speeds),
) -> Vec<RunError> {
    let mut block = Block { problem, method, interval, states, held: Vec::new(), failures: Vec::new() };
    let Some((span, mut reached)) = block.start(q, z) else { return block.failures };
    // Lanes that cannot even start get their states back at the end.
    let (given, refused) = ((*q, *z), block.failures.len());

    let (start, end) = (reached.0.t, S::Scalar::from_f64(interval.end));
    let steps = match steps_between([start, end], interval.step.abs(), DEFAULT_LIMIT) {
        _ if span == 0.0 => 0,
        Ok(steps) => steps,
        Err(kind) => {
            block.fail_the_rest(interval.start, kind);
            return block.failures;
        }
    };
    let h = S::Scalar::from_f64(if span < 0.0 { -interval.step.abs() } else { interval.step.abs() });
    let (mut n, mut trial) = (1, StepTrial::OfTheAble(None));
    while n <= steps {
        // As `Fixed` has it: times are multiples of h, not sums of it, and the last step ends where it should.
        let last = n == steps;
        let time = if last { end } else { S::Scalar::from_f64(n as f64).fma(h, start) };
        let this = if last { end - reached.0.t } else { h };
        // The one place where steps are made, so that the method is put into this loop.
        match (block.step(&reached, block.lengths(this, trial), time), trial) {
            (Ok(next), StepTrial::OfTheAble(_)) => {
                (reached, trial) = (next, StepTrial::OfTheAble(None));
                n += 1;
            }
            (outcome, _) => match block.after(trial, outcome.err(), &reached) {
                Some(next) => trial = next,
                None => break,
            },
        }
    }

    let (state, _) = reached;
    (*q, *z) = (state.q, problem.speeds(state.t, &state.q, &state.y));
    for lane in block.failures[..refused].iter().flat_map(|failure| block.lanes_of(failure.state)) {
        q.replace(lane, &given.0.extract(lane));
        z.replace(lane, &given.1.extract(lane));
    }
    block.failures
}

impl<S: BatchSystem, P: Problem<System = S>, M: OneStep<S>> Block<'_, S, P, M> {
    /// The lanes that hold a state.
    fn lanes_of(&self, state: usize) -> Range<usize> {
        let end = if state + 1 == self.states { S::Scalar::WIDTH } else { state + 1 };
        state..end
    }

    /// The span of time and the state at its start, which is good in all lanes: lanes that are not hold the state of
    /// one that is. `None` when none is.
    fn start(&mut self, q: &S::Configuration, z: &S::Speeds) -> Option<(f64, AdvancedState<S>)> {
        let interval = self.interval;
        if !(interval.step.is_finite() && interval.step != 0.0) {
            self.fail_the_rest(interval.start, IntegrationErrorKind::InvalidStep { step: interval.step });
            return None;
        }
        match self.check(q, z) {
            Ok(started) => Some(started),
            Err(kind) => {
                let mut good = None;
                for state in 0..self.states {
                    let single = (q.extract(state), z.extract(state));
                    match self.check(&S::Configuration::repeat(&single.0), &S::Speeds::repeat(&single.1)) {
                        Ok(_) => good = Some(single),
                        Err(kind) => self.failures.push(RunError::new(state, interval.start, kind)),
                    }
                }
                let (mut q, mut z) = (*q, *z);
                for lane in self.failures.iter().flat_map(|failure| self.lanes_of(failure.state)) {
                    let (good_q, good_z) = good?;
                    q.replace(lane, &good_q);
                    z.replace(lane, &good_z);
                }
                // Lanes with parameters of their own may all do alone and not together; then there is no one to blame.
                let Ok(started) = self.check(&q, &z) else {
                    self.fail_the_rest(interval.start, kind);
                    return None;
                };
                for state in self.failures.iter().map(|failure| failure.state) {
                    let holding = self.lanes_of(state).map(|lane| StoppedLane::at(&started.1.0, lane));
                    self.held.extend(holding);
                }
                Some(started)
            }
        }
    }

    /// The start of a run, refused where a step from there would be.
    fn check(&self, q: &S::Configuration, z: &S::Speeds) -> Result<(f64, AdvancedState<S>), IntegrationErrorKind> {
        let (system, interval) = (self.problem.system(), self.interval);
        let (t, q) = (S::Scalar::from_f64(interval.start), q.renormalise());
        let start = State { t, q, y: self.problem.variables(t, &q, z) };
        let (span, start, rates) = prepare(self.problem, &start, S::Scalar::from_f64(interval.end))?;
        let regularity = system.regularity(t, &q);
        let singular = |regularity: &f64| regularity.abs() <= Real::sqrt(S::Scalar::EPSILON);
        match (0..S::Scalar::LANES).map(|lane| regularity.lane(lane)).find(singular) {
            Some(regularity) => Err(IntegrationErrorKind::SingularChart { regularity }),
            None => Ok((span, (start, rates))),
        }
    }

    /// Chooses the next trial, if there is anything left to try. The error of a step does not tell which lanes fail.
    /// They are independent, and a step of length zero succeeds from every good state: so each is tried while the
    /// others stand still; those that are to blame stop, and the others make the step.
    #[cold]
    #[inline(never)]
    fn after(
        &mut self,
        trial: StepTrial,
        failed: Option<IntegrationErrorKind>,
        (from, rates): &AdvancedState<S>,
    ) -> Option<StepTrial> {
        let first = match (trial, failed) {
            (StepTrial::OfTheAble(Some(kind)), Some(_)) => {
                let going = (0..self.states).find(|&state| self.is_able(state)).unwrap_or(0);
                self.fail_the_rest(from.t.extract(going).lane(0), kind);
                return None;
            }
            (StepTrial::OfTheAble(None), Some(kind)) => StepTrial::Alone(0, kind),
            (StepTrial::OfTheAble(_), None) => return Some(trial),
            (StepTrial::Alone(state, first), failed) => {
                if let Some(kind) = failed {
                    let (length, time) = (self.interval.step.abs(), number(from.t, state));
                    let left = (self.interval.end - time).abs();
                    let (stiff, lanes) = (self.method.properties().stiff, numbers_of::<S::Scalar>(state));
                    let place = StopPlace { state: from, rates, length, left, stiff, lanes };
                    let kind = cause(self.problem, &place, StopReason::Step(kind));
                    self.failures.push(RunError::new(state, time, kind));
                    self.held.extend(self.lanes_of(state).map(|lane| StoppedLane::at(from, lane)));
                }
                StepTrial::Alone(state + 1, first)
            }
        };
        let StepTrial::Alone(from, kind) = first else { return Some(first) };
        match (from..self.states).find(|&state| self.is_able(state)) {
            Some(state) => Some(StepTrial::Alone(state, kind)),
            None => (self.failures.len() < self.states).then_some(StepTrial::OfTheAble(Some(kind))),
        }
    }

    /// Whether a state has not stopped.
    fn is_able(&self, state: usize) -> bool {
        self.failures.iter().all(|failure| failure.state != state)
    }

    /// Stops the states that are left as well.
    fn fail_the_rest(&mut self, time: f64, kind: IntegrationErrorKind) {
        for state in 0..self.states {
            if self.failures.iter().all(|failure| failure.state != state) {
                self.failures.push(RunError::new(state, time, kind));
            }
        }
    }

    /// The lengths of a step, zero for lanes that stand still.
    #[inline(always)]
    fn lengths(&self, mut h: S::Scalar, trial: StepTrial) -> S::Scalar {
        if let StepTrial::Alone(state, _) = trial {
            let given = h;
            h = S::Scalar::zero();
            self.lanes_of(state).for_each(|lane| h.replace(lane, &given.extract(lane)));
        }
        for held in &self.held {
            h.replace(held.lane, &Real::zero());
        }
        h
    }

    #[inline(always)]
    fn step(
        &self,
        (state, rates): &AdvancedState<S>,
        h: S::Scalar,
        time: S::Scalar,
    ) -> Result<AdvancedState<S>, IntegrationErrorKind> {
        let step = self.method.step(self.problem, state, rates, h)?;
        let (mut next, mut known) = (step.state, step.rates);
        next.t = time;
        for held in &self.held {
            next.t.replace(held.lane, &held.t);
            next.q.replace(held.lane, &held.q);
            next.y.replace(held.lane, &held.y);
            known = None;
        }
        let rates = accept(self.problem, (state, rates), &mut next, known)?;
        Ok((next, rates))
    }
}

impl<S: BatchSystem> StoppedLane<S> {
    fn at(state: &State<S>, lane: usize) -> Self {
        Self { lane, t: state.t.extract(lane), q: state.q.extract(lane), y: state.y.extract(lane) }
    }
}
