//! Runs in lanes: a lane gets a run, makes its steps, and is handed to the next one.

use alloc::vec;
use alloc::vec::Vec;

use gauss_runtime::configuration::Configuration;
use gauss_runtime::integrate::drive::cause::{StopPlace, StopReason, cause};
use gauss_runtime::integrate::drive::control::prepare;
use gauss_runtime::integrate::drive::event::{Events, Outcome, Watch};
use gauss_runtime::integrate::drive::interval;
use gauss_runtime::integrate::drive::pace::Pace;
use gauss_runtime::integrate::drive::run::Jumps;
use gauss_runtime::integrate::drive::search::{StepEnds, StepSearch};
use gauss_runtime::integrate::drive::summary::Summary;
use gauss_runtime::integrate::problem::equations::Problem;
use gauss_runtime::integrate::problem::error::IntegrationErrorKind;
use gauss_runtime::integrate::problem::state::{Rates, State};
use gauss_runtime::real::Real;
use gauss_runtime::simd::Packed;

use super::ended::{Ended, EventState, RunError, RunOutcome};
use super::system::{BatchSystem, SingleConfiguration, SingleSpeeds};
use super::{Group, LaneControl, Verdict, chosen_rates, number, numbers_of, ones_in};

/// A run by its number, and its start.
type First<S> = (usize, SingleConfiguration<S>, SingleSpeeds<S>);

/// The span of time, the state and the derivatives at the start of all lanes.
type Start<S> = Result<(f64, State<S>, Rates<S>), IntegrationErrorKind>;

/// Source of runs, and receiver of their ends: by their numbers.
pub trait Runs<S: BatchSystem> {
    /// The number of the next one, and its start.
    fn next(&mut self) -> Option<First<S>>;

    /// The last good state of a run, and how it ended.
    fn end(&mut self, run: usize, state: (SingleConfiguration<S>, SingleSpeeds<S>), outcome: RunOutcome<S>);
}

/// A run in a lane.
struct Running<'a, S: BatchSystem, P, C, E> {
    number: usize,
    summary: Summary,
    pace: Pace,
    /// Over jumps.
    way: Pace,
    jumps: Jumps,
    watch: Watch<'a, P, C, E>,
    found: Vec<EventState<SingleConfiguration<S>, SingleSpeeds<S>>>,
}

/// Settings that all runs have in common.
pub struct InLanes<'a, S: BatchSystem, P, C, E> {
    /// The choice of steps.
    pub control: &'a C,
    /// The kernel, the form of its equations, the input.
    pub problem: &'a P,
    /// Events that are looked for in each run.
    pub events: &'a E,
    /// The beginning and the end.
    pub times: (f64, f64),
    /// The most steps of a run.
    pub limit: u64,
    /// Holds an input in a lane, where controllers sample.
    pub hold: &'a dyn Fn(usize, &S::Input),
}

/// Lanes with their runs.
struct Lanes<'a, S: BatchSystem, P, C: LaneControl<S>, E> {
    all: &'a InLanes<'a, S, P, C, E>,
    group: Group<S>,
    memory: C::Memory,
    running: Vec<Option<Running<'a, S, P, C, E>>>,
    /// Which lanes make the present step.
    who: Vec<bool>,
}

impl<S, P, C, E> InLanes<'_, S, P, C, E>
where
    S: BatchSystem,
    P: Problem<System = S>,
    C: LaneControl<S>,
    E: Events<S> + Clone,
{
    /// Carries all runs to their ends. The first ones get the lanes in their order.
    pub fn carry(&self, runs: &mut dyn Runs<S>) {
        let firsts: Vec<_> = (0..S::Scalar::WIDTH).map_while(|_| runs.next()).collect();
        let Some(mut lanes) = self.open(&firsts, runs) else {
            // None of them can be started, which says nothing about the others.
            return if firsts.is_empty() {
            } else {
                self.carry(runs)
            };
        };
        loop {
            while let Some(lane) = lanes.free() {
                let Some((number, q, z)) = runs.next() else { break };
                match lanes.place(lane, &q, &z) {
                    Ok(()) => lanes.enter(lane, number, runs),
                    Err(kind) => runs.end(number, (q, z), self.not_started(number, kind)),
                }
            }
            if lanes.running.iter().all(Option::is_none) {
                return;
            }
            lanes.step(runs);
        }
    }

    fn not_started(&self, state: usize, kind: IntegrationErrorKind) -> RunOutcome<S> {
        Err(RunError { state, time: self.times.0, kind })
    }

    /// The start of some runs in a lane each; lanes without one repeat the last.
    fn start(&self, starts: impl Fn(usize) -> (SingleConfiguration<S>, SingleSpeeds<S>)) -> Start<S> {
        let first = starts(0);
        let (mut q, mut z) = (S::Configuration::repeat(&first.0), S::Speeds::repeat(&first.1));
        for lane in 1..S::Scalar::WIDTH {
            let start = starts(lane);
            q.replace(lane, &start.0);
            z.replace(lane, &start.1);
        }
        let start = self.problem.state(S::Scalar::from_f64(self.times.0), q.renormalise(), &z);
        prepare(self.problem, &start, S::Scalar::from_f64(self.times.1))
    }

    /// Lanes with the first runs. Those that cannot be started are told so; none where no one can.
    fn open(&self, firsts: &[First<S>], runs: &mut dyn Runs<S>) -> Option<Lanes<'_, S, P, C, E>> {
        let last = firsts.len().checked_sub(1)?;
        let state = |n: usize| (firsts[n].1, firsts[n].2);
        let mut refused: Vec<(usize, IntegrationErrorKind)> = Vec::new();
        let memory = self.control.memory(self.times.1 - self.times.0, self.limit);
        let started = memory.and_then(|memory| {
            let together = self.start(|lane| state(lane.min(last)));
            let started = together.or_else(|kind| {
                // Those that can be started alone, with one of them in the place of the others.
                let alone = |n: usize| self.start(|_| state(n)).err();
                refused.extend((0..=last).filter_map(|n| alone(n).map(|kind| (n, kind))));
                let good = (0..=last).find(|n| refused.iter().all(|(bad, _)| bad != n)).ok_or(kind)?;
                let able = |n: usize| if refused.iter().any(|(bad, _)| *bad == n) { good } else { n };
                self.start(|lane| state(able(lane.min(last))))
            })?;
            Ok((memory, started))
        });
        let (outcome, rest) = match started {
            Ok(started) => (Some(started), None),
            Err(kind) => (None, Some(kind)),
        };
        for (n, &(number, q, z)) in firsts.iter().enumerate() {
            let alone = refused.iter().find(|(bad, _)| *bad == n).map(|(_, kind)| *kind);
            if let Some(kind) = alone.or(rest) {
                runs.end(number, (q, z), self.not_started(number, kind));
            }
        }
        let (memory, (span, state, rates)) = outcome?;
        let width = S::Scalar::WIDTH;
        let (verdicts, end) = (vec![Verdict::Rejected; width], S::Scalar::from_f64(self.times.1));
        let unseen = !E::ANY;
        let group = Group { state, rates, verdicts, end, span, unseen, alone: false, steps: 1 };
        let mut lanes =
            Lanes { all: self, group, memory, running: (0..width).map(|_| None).collect(), who: vec![false; width] };
        for (lane, (number, ..)) in firsts.iter().enumerate() {
            if refused.iter().all(|(bad, _)| *bad != lane) {
                lanes.enter(lane, *number, runs);
            }
        }
        Some(lanes)
    }
}

impl<'a, S, P, C, E> Lanes<'a, S, P, C, E>
where
    S: BatchSystem,
    P: Problem<System = S>,
    C: LaneControl<S>,
    E: Events<S> + Clone,
{
    /// A lane without a run.
    fn free(&self) -> Option<usize> {
        self.running.iter().position(Option::is_none)
    }

    /// Puts a state into a lane: the start of a run, in bits that do not depend on the others.
    fn place(
        &mut self,
        lane: usize,
        q: &SingleConfiguration<S>,
        z: &SingleSpeeds<S>,
    ) -> Result<(), IntegrationErrorKind> {
        let problem = self.all.problem;
        let here = self.group.state;
        let (mut t, mut configuration) = (here.t, here.q);
        let mut speeds = problem.speeds(t, &here.q, &here.y);
        self.group.end.replace(lane, &Real::from_f64(self.all.times.1));
        t.replace(lane, &Real::from_f64(self.all.times.0));
        configuration.replace(lane, q);
        speeds.replace(lane, z);
        let fresh = problem.state(t, configuration.renormalise(), &speeds);
        self.set(lane, &fresh)
    }

    /// Takes one lane of a state, checked as that of a run that begins.
    fn set(&mut self, lane: usize, fresh: &State<S>) -> Result<(), IntegrationErrorKind> {
        let mut start = self.group.state;
        start.t.replace(lane, &fresh.t.extract(lane));
        start.q.replace(lane, &fresh.q.extract(lane));
        start.y.replace(lane, &fresh.y.extract(lane));
        let (_, checked, rates) = prepare(self.all.problem, &start, self.group.end)?;
        start.q.replace(lane, &checked.q.extract(lane));
        start.y.replace(lane, &checked.y.extract(lane));
        self.group.state = start;
        self.group.rates = chosen_rates(ones_in(|other| other == lane), &rates, &self.group.rates);
        Ok(())
    }

    /// A run begins in a lane that holds its start.
    fn enter(&mut self, lane: usize, number: usize, runs: &mut dyn Runs<S>) {
        let all = self.all;
        let way = || Pace::new(all.times.0, all.limit);
        let running = Running {
            number,
            summary: Summary::default(),
            pace: way(),
            way: way(),
            jumps: Jumps::new::<S::Scalar>(all.times.0, all.times.1),
            watch: Watch::new(all.control, all.problem, all.events.clone(), numbers_of::<S::Scalar>(lane)),
            found: Vec::new(),
        };
        self.running[lane] = Some(running);
        let begun = self.begin_sampling(lane).and_then(|()| self.sample(lane));
        let outcome = match begun {
            Ok(()) if self.group.span == 0.0 => return self.leave(lane, Ok(None), runs),
            Ok(()) => self.begin(lane, all.limit),
            Err(kind) => Err(kind),
        };
        if let Err(kind) = outcome {
            self.leave(lane, Err(kind), runs);
        }
    }

    /// Checks the controllers of a run that begins.
    fn begin_sampling(&mut self, lane: usize) -> Result<(), IntegrationErrorKind> {
        let (all, Some(running)) = (self.all, &mut self.running[lane]) else { return Ok(()) };
        if !E::SAMPLED {
            return Ok(());
        }
        let interval = (S::Scalar::from_f64(all.times.0), S::Scalar::from_f64(all.times.1));
        interval::begin(running.watch.events(), all.problem.held().is_some(), interval, all.limit)
    }

    /// Lets the controllers of a run sample where it is: what they hold, and until when, is in its lane.
    fn sample(&mut self, lane: usize) -> Result<(), IntegrationErrorKind> {
        let (all, Some(running)) = (self.all, &mut self.running[lane]) else { return Ok(()) };
        if !E::SAMPLED {
            return Ok(());
        }
        let State { t, q, y } = &self.group.state;
        // Controllers see the state of their run in all lanes.
        let here = State {
            t: S::Scalar::repeat(&t.extract(lane)),
            q: S::Configuration::repeat(&q.extract(lane)),
            y: S::Speeds::repeat(&y.extract(lane)),
        };
        let (now, end) = (all.problem.sample(&here), S::Scalar::from_f64(all.times.1));
        let (held, until) = interval::tick(running.watch.events(), &now, None, end)?;
        if let Some(held) = held {
            (all.hold)(lane, &held);
        }
        self.group.end.replace(lane, &until.extract(lane));
        let state = self.group.state;
        self.set(lane, &state)
    }

    /// A step has come to an instant of a controller, from which the run goes on as from a start.
    fn instant(&mut self, lane: usize, runs: &mut dyn Runs<S>) {
        let limit = self.all.limit;
        let Some(running) = &mut self.running[lane] else { return };
        let tries = running.summary.steps + running.summary.rejected;
        running.pace = Pace::new(number(self.group.state.t, lane), limit.saturating_sub(tries));
        let outcome = self.sample(lane).and_then(|()| self.begin_steps(lane, limit.saturating_sub(tries)));
        if let Err(kind) = outcome {
            self.leave(lane, Err(kind), runs);
        }
    }

    /// Whether the end of a lane is that of its run.
    fn is_whole(&self, lane: usize) -> bool {
        !E::SAMPLED || number(self.group.end, lane) == self.all.times.1
    }

    /// The first step of a run, or after a jump, is to come; so many are allowed.
    fn begin(&mut self, lane: usize, limit: u64) -> Result<(), IntegrationErrorKind> {
        self.begin_steps(lane, limit)?;
        let Some(running) = &mut self.running[lane] else { return Ok(()) };
        if E::ANY { running.watch.begin(&self.group.state) } else { Ok(()) }
    }

    fn begin_steps(&mut self, lane: usize, limit: u64) -> Result<(), IntegrationErrorKind> {
        self.all.control.begin(self.all.problem, &self.group, (lane, limit), &mut self.memory).map_err(|mut kind| {
            // What was left of the limit says nothing to whoever set it.
            if let IntegrationErrorKind::TooManySteps { limit } = &mut kind {
                *limit = self.all.limit;
            }
            kind
        })
    }

    /// A run has come to its end, by itself or by an event, or cannot go on.
    fn leave(&mut self, lane: usize, how: Result<Option<usize>, IntegrationErrorKind>, runs: &mut dyn Runs<S>) {
        let Some(running) = self.running[lane].take() else { return };
        let State { t, q, y } = &self.group.state;
        let time = number(*t, lane);
        let last = (q.extract(lane), self.all.problem.speeds(*t, q, y).extract(lane));
        let outcome = match how {
            Ok(stopped_by) => Ok(Ended { time, stopped_by, summary: running.summary, events: running.found }),
            Err(kind) => {
                let kind = running.jumps.told(kind, &running.summary);
                Err(RunError { state: running.number, time, kind })
            }
        };
        runs.end(running.number, last, outcome);
    }

    /// Ends a run that cannot go on, with the cause that is found.
    fn give_up(&mut self, lane: usize, gave: StopReason, runs: &mut dyn Runs<S>) {
        let place = StopPlace {
            state: &self.group.state,
            rates: &self.group.rates,
            length: self.all.control.length(lane, &self.memory),
            left: self.group.left(lane),
            stiff: self.all.control.passes_over_decay(),
            lanes: numbers_of::<S::Scalar>(lane),
        };
        let kind = cause(self.all.problem, &place, gave);
        self.leave(lane, Err(kind), runs);
    }

    /// A step in all lanes that have runs.
    fn step(&mut self, runs: &mut dyn Runs<S>) {
        for lane in (0..self.running.len()).filter(|_| self.all.control.paced()) {
            let left = self.group.left(lane);
            let t = number(self.group.state.t, lane);
            let spent = self.running[lane].as_mut().and_then(|running| running.pace.spent(t, left));
            if let Some(hopeless) = spent {
                self.give_up(lane, StopReason::StepLimit { limit: self.all.limit, hopeless }, runs);
            }
        }
        let mut who = core::mem::take(&mut self.who);
        who.iter_mut().zip(&self.running).for_each(|(who, running)| *who = running.is_some());
        let before = E::ANY.then_some((self.group.state, self.group.rates));
        self.attempt(&who);
        if let Some(before) = &before {
            self.see(before, &who, runs);
        }
        for lane in (0..who.len()).filter(|&lane| who[lane]) {
            match self.group.verdicts[lane] {
                Verdict::Rejected => {}
                Verdict::Stopped(gave) => self.give_up(lane, gave, runs),
                Verdict::Taken(taken, last) => {
                    if let Some(running) = &mut self.running[lane]
                        && !E::ANY
                    {
                        running.summary.count(taken);
                        running.summary.steps += self.group.steps - 1;
                    }
                    match (last, self.is_whole(lane)) {
                        (true, true) => self.leave(lane, Ok(None), runs),
                        (true, false) => self.instant(lane, runs),
                        (false, _) => {}
                    }
                }
            }
        }
        self.who = who;
    }

    /// Tries a step in some lanes. When it fails it is tried in each of them alone: they are independent, and a step of
    /// length zero succeeds from every good state.
    fn attempt(&mut self, who: &[bool]) {
        let (control, problem) = (self.all.control, self.all.problem);
        if let Err(kind) = control.attempt(problem, &mut self.group, who, &mut self.memory) {
            let tried = |lane: &usize| who[*lane];
            match (0..who.len()).filter(tried).count() {
                1 => {
                    let lane = (0..who.len()).find(tried).unwrap_or(0);
                    self.group.verdicts[lane] = control.failed((problem, &self.group), lane, kind, &mut self.memory);
                }
                _ => (0..who.len()).filter(tried).for_each(|lane| {
                    let alone: Vec<bool> = (0..who.len()).map(|other| other == lane).collect();
                    self.group.alone = true;
                    self.attempt(&alone);
                    self.group.alone = false;
                }),
            }
        }
    }

    /// Looks for events in the steps that were taken.
    #[inline(never)]
    fn see(&mut self, before: &(State<S>, Rates<S>), who: &[bool], runs: &mut dyn Runs<S>) {
        let suspicious = self.suspicious(before);
        for lane in (0..who.len()).filter(|&lane| who[lane]) {
            let Verdict::Taken(taken, _) = self.group.verdicts[lane] else { continue };
            let Some(running) = &mut self.running[lane] else { continue };
            running.summary.count(taken);
            if !suspicious[lane] {
                continue;
            }
            // All other lanes stand still.
            let only = ones_in(|other| other == lane);
            let state = super::chosen_state(only, &self.group.state, &before.0);
            let rates = chosen_rates(only, &self.group.rates, &before.1);
            let numbers = numbers_of::<S::Scalar>(lane);
            let made = StepEnds { lane: numbers.start, before: (&before.0, &before.1), after: (&state, &rates) };
            let (problem, found) = (self.all.problem, &mut running.found);
            let outcome = running.watch.step(&made, &mut |event, at| {
                let z = problem.speeds(at.t, &at.q, &at.y);
                found.push(EventState { event, t: number(at.t, lane), q: at.q.extract(lane), z: z.extract(lane) });
            });
            match outcome {
                Ok(Outcome::On) => {}
                Ok(Outcome::Here { state, after, number, stopped_by }) => {
                    self.cut(lane, (&state, after.as_ref()), (number, stopped_by), runs);
                }
                Err(kind) => {
                    // The last good state is the one before.
                    self.back(lane, &before.0);
                    self.leave(lane, Err(kind), runs);
                }
            }
        }
    }

    /// In which lanes the curve of the step shows that an event may be on it; in others the values at its end are
    /// remembered.
    fn suspicious(&mut self, before: &(State<S>, Rates<S>)) -> Vec<bool> {
        let all = self.all;
        let after = (&self.group.state, &self.group.rates);
        let made = StepEnds { lane: 0, before: (&before.0, &before.1), after };
        let looking = StepSearch::of(all.control, all.problem, &made);
        let mut suspicious = vec![false; self.running.len()];
        let mut watched = all.events.clone();
        let mut event = 0;
        watched.each(&mut |function, _| {
            let seen = looking.glimpse(function);
            for (lane, running) in self.running.iter_mut().enumerate() {
                let Some(running) = running else { continue };
                let numbers = numbers_of::<S::Scalar>(lane);
                let shows = |start: f64| match &seen {
                    Ok(seen) => seen(numbers.start, start),
                    Err(_) => Ok(true),
                };
                suspicious[lane] |= running.watch.may_pass(event, shows);
            }
            event += 1;
        });
        let mut event = 0;
        watched.each(&mut |function, _| {
            let values = gauss_runtime::integrate::drive::search::values(all.problem, function, after.0);
            for (lane, running) in self.running.iter_mut().enumerate().filter(|(lane, _)| !suspicious[*lane]) {
                if let (Some(running), Verdict::Taken(..)) = (running, &self.group.verdicts[lane]) {
                    running.watch.remember(event, values.lane(numbers_of::<S::Scalar>(lane).start));
                }
            }
            event += 1;
        });
        suspicious
    }

    /// A run ends at an event, or goes on from there in another state.
    fn cut(
        &mut self,
        lane: usize,
        (at, after): (&State<S>, Option<&State<S>>),
        (event, stopped_by): (usize, Option<usize>),
        runs: &mut dyn Runs<S>,
    ) {
        // Neither is the step of this lane the last one any more.
        self.group.verdicts[lane] = Verdict::Rejected;
        self.back(lane, at);
        let Some(running) = &mut self.running[lane] else { return };
        if after.is_some() {
            running.summary.jumps += 1;
            if let Err(kind) = running.jumps.count(number(at.t, lane), event) {
                return self.leave(lane, Err(kind), runs);
            }
        }
        let outcome = after.map_or(Ok(()), |after| self.set(lane, after));
        match (outcome, stopped_by) {
            (Err(kind), _) => self.leave(lane, Err(kind), runs),
            (Ok(()), Some(_)) => self.leave(lane, Ok(stopped_by), runs),
            (Ok(()), None) => self.go_on(lane, runs),
        }
    }

    /// After a jump a run goes on as from a start.
    fn go_on(&mut self, lane: usize, runs: &mut dyn Runs<S>) {
        if let Err(kind) = self.sample(lane) {
            return self.leave(lane, Err(kind), runs);
        }
        let (t, left, limit) = (number(self.group.state.t, lane), self.group.left(lane), self.all.limit);
        let Some(running) = &mut self.running[lane] else { return };
        let tries = running.summary.steps + running.summary.rejected;
        let lost = running.way.jumped(t, left, tries);
        running.pace = Pace::new(t, limit.saturating_sub(tries));
        let outcome = if lost {
            Err(IntegrationErrorKind::TooManySteps { limit })
        } else if left == 0.0 {
            return self.leave(lane, Ok(None), runs);
        } else {
            self.begin(lane, limit.saturating_sub(tries))
        };
        if let Err(kind) = outcome {
            self.leave(lane, Err(kind), runs);
        }
    }

    /// A lane goes back to a state within its last step.
    fn back(&mut self, lane: usize, to: &State<S>) {
        let state = &mut self.group.state;
        state.t.replace(lane, &to.t.extract(lane));
        state.q.replace(lane, &to.q.extract(lane));
        state.y.replace(lane, &to.y.extract(lane));
    }
}
