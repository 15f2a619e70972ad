//! Steps as long as a tolerance allows.

use core::fmt;
use core::ops::Range;

use crate::configuration::{Configuration, VectorSpace};
use crate::integrate::drive::cause::{StopPlace, StopReason, cause};
use crate::integrate::drive::choice::StepChoice;
use crate::integrate::drive::control::{
    Control, Progress, StepCallback, StepStatistics, check_tolerances, longest, prepare,
};
use crate::integrate::drive::cubic::StepEnds;
use crate::integrate::drive::logarithms::{exponential, logarithm};
use crate::integrate::drive::looks::Looks;
use crate::integrate::drive::pace::Pace;
use crate::integrate::drive::projection::{accept, check_move, onto_constraints};
use crate::integrate::drive::step_length::{StepLength, power};
use crate::integrate::drive::tolerance::{Floor, Tolerance, Trial};
use crate::integrate::lie_group::rkmk::Rkmk;
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::error::{IntegrationError, IntegrationErrorKind};
use crate::integrate::problem::state::{Rates, State, TangentOf, copy_and_debug};
use crate::integrate::runge_kutta::components::RungeKutta;
use crate::integrate::runge_kutta::tableau::{DormandPrince8, Tableau};
use crate::integrate::step::iteration::worst;
use crate::integrate::step::one_step::{EstimatingStep, Step};
use crate::real::Real;
use crate::system::{GaussSystem, Smoothness};

/// Steps that keep the estimated error of each within a tolerance: an embedded pair, or any other [`EstimatingStep`],
/// with a PI controller (Gustafsson; Hairer, Nørsett & Wanner II.4).
///
/// Where the tolerance is smaller than the rounding error of a step, the rounding error, measured at the state, is the
/// tolerance: shorter steps would be no better. [`Summary`](crate::integrate::Summary) counts these steps, and has the
/// largest ratio of the two.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Adaptive<M = RungeKutta<DormandPrince8, 12>> {
    /// The method.
    pub method: M,
    /// Tolerances that the error of a step is measured against.
    pub tolerance: Tolerance,
    /// The length of the first step; an estimate where there is none.
    pub first_step: Option<f64>,
    /// The longest step.
    pub largest_step: Option<f64>,
    /// The time within which the input may change.
    pub input_changes: Option<f64>,
}

impl Adaptive {
    /// [`RungeKutta`] of [`DormandPrince8`].
    ///
    /// The error of a step is measured component by component against `absolute + relative·size`, where the size is
    /// |z| for speeds, 1 for a rotation, |b| for a translation and |q| for a plain coordinate, and the root mean square
    /// must not exceed 1. In the momentum form as well errors are those of the speeds: near a singular place of a chart
    /// a small part of a momentum is much of a speed.
    #[must_use]
    pub fn new(relative: f64, absolute: f64) -> Self {
        Self::by(RungeKutta(DormandPrince8), relative, absolute)
    }
}

impl<T: Real, const S: usize> Adaptive<Rkmk<T, S>> {
    /// The Runge–Kutta–Munthe-Kaas method of any embedded pair.
    #[must_use]
    pub fn with(tableau: &Tableau<S>, relative: f64, absolute: f64) -> Self {
        Self::by(Rkmk::new(tableau), relative, absolute)
    }
}

impl<M> Adaptive<M> {
    /// Any method that estimates its error, for example `Adaptive::by(RungeKutta(Verner9), 1e-12, 1e-12)`; tolerances
    /// as in [`Adaptive::new`].
    #[must_use]
    pub fn by(method: M, relative: f64, absolute: f64) -> Self {
        Self {
            method,
            tolerance: Tolerance { relative, absolute },
            first_step: None,
            largest_step: None,
            input_changes: None,
        }
    }

    /// The length of the first step, instead of an estimate.
    #[must_use]
    pub fn first_step(self, length: f64) -> Self {
        Self { first_step: Some(length), ..self }
    }

    /// The longest step.
    #[must_use]
    pub fn largest_step(self, length: f64) -> Self {
        Self { largest_step: Some(length), ..self }
    }

    /// The shortest time within which the input changes and changes back: no push is missed that lasts as long.
    ///
    /// Without this the run looks at what acts every 256th of its span, in steps whose length nothing limits: those of
    /// systems at rest, or in free flight, where a step takes its length from what its stages have seen. A push that is
    /// over within a 256th of the span may fall between two looks, and then it has never been. In steps that the motion
    /// itself limits, stages are up to a third of the step apart; with this they are looked at as well.
    ///
    /// Looks cost an evaluation of the equations each, a twelfth of a step by the default method, and scenes without
    /// inputs none: what depends on the time in the scene itself, as a load `exp(-(t - 5)^2)`, is not looked at;
    /// bound its steps ([`largest_step`](Self::largest_step)), or make it an input.
    #[must_use]
    pub fn input_changes_within(self, time: f64) -> Self {
        Self { input_changes: Some(time), ..self }
    }
}

/// The choice of steps of a run, as it goes on.
pub struct AdaptiveMemory<S: GaussSystem> {
    choice: StepChoice,
    /// The rounding error of a step, once it has been measured.
    floor: Option<Floor<S>>,
    limit: u64,
    pace: Pace,
}

copy_and_debug!(AdaptiveMemory { choice, floor, limit, pace });

/// A run on its way, with what does not change.
struct Drive<'a, S: GaussSystem, P, M> {
    control: &'a Adaptive<M>,
    problem: &'a P,
    end: S::Scalar,
    state: &'a mut State<S>,
    rates: &'a mut Rates<S>,
    choice: &'a mut StepChoice,
    floor: &'a mut Option<Floor<S>>,
}

impl<S: GaussSystem, M: EstimatingStep<S>> Control<S> for Adaptive<M> {
    type StepMemory = AdaptiveMemory<S>;

    fn tolerance(&self) -> Option<Tolerance> {
        Some(self.tolerance)
    }

    fn start<P: Problem<System = S>>(
        &self,
        problem: &P,
        start: State<S>,
        end: S::Scalar,
        limit: u64,
        emit: &mut StepCallback<'_, S>,
    ) -> Result<Progress<S, Self::StepMemory>, IntegrationError> {
        let stopped = |state: &State<S>, kind| IntegrationError::at(problem, state, kind);
        let Tolerance { relative, absolute } = self.tolerance;
        check_tolerances(relative, absolute).map_err(|kind| stopped(&start, kind))?;
        let (span, state, rates) = prepare(problem, &start, end).map_err(|kind| stopped(&start, kind))?;
        let from = state.t.lane(0);
        let choice = self.choice::<S>(problem.system().smoothness(), from, span);
        let memory = AdaptiveMemory { choice, floor: None, limit, pace: Pace::new(from, limit) };
        let mut run = Progress::new((state, rates), end, memory, emit);
        if !run.ended {
            let every = (S::Scalar::one(), 0..S::Scalar::LANES);
            let begun = self.begin_steps(problem, (&state, &rates), &every, limit, &mut run.memory.choice);
            begun.map_err(|kind| stopped(&state, kind))?;
        }
        Ok(run)
    }

    fn advance<P: Problem<System = S>>(
        &self,
        problem: &P,
        run: &mut Progress<S, Self::StepMemory>,
        emit: &mut StepCallback<'_, S>,
    ) -> Result<(), IntegrationError> {
        let stopped = |state: &State<S>, kind| IntegrationError::at(problem, state, kind);
        let Progress { state, rates, end, ended, memory } = run;
        let AdaptiveMemory { choice, floor, limit, pace } = memory;
        let (limit, mut drive) = (*limit, Drive { control: self, problem, end: *end, state, rates, choice, floor });
        loop {
            let (time, left) = (drive.state.t.lane(0), drive.left());
            if let Some(hopeless) = pace.spent(time, left) {
                return Err(stopped(drive.state, drive.cause(StopReason::StepLimit { limit, hopeless })));
            }
            match drive.step() {
                Ok(None) => {}
                Ok(Some((taken, last))) => {
                    *ended = last;
                    if emit(drive.state, drive.rates, taken).is_break() || last {
                        return Ok(());
                    }
                }
                Err(kind) => return Err(stopped(drive.state, drive.cause(StopReason::AnyStep(kind)))),
            }
        }
    }

    fn within<P: Problem<System = S>>(
        &self,
        problem: &P,
        state: &State<S>,
        rates: &Rates<S>,
        h: S::Scalar,
    ) -> Result<State<S>, IntegrationErrorKind> {
        if !S::CONSTRAINED {
            return Ok(self.method.step(problem, state, rates, h)?.state);
        }
        let at = |part: f64| self.on_constraints(problem, (state, rates), h * S::Scalar::from_f64(part));
        at(1.0).or_else(|kind| {
            // By a cubic through states on both sides, of which the error is η⁴/6 of a fourth derivative.
            let mut q = TangentOf::<S>::zero();
            let mut y = S::Speeds::zero();
            let base = at(1.0 - BESIDE).map_err(|_| kind)?;
            for (node, weight) in [(-2.0, -1.0 / 6.0), (-1.0, 2.0 / 3.0), (1.0, 2.0 / 3.0), (2.0, -1.0 / 6.0)] {
                let node = at(1.0 + BESIDE * node).map_err(|_| kind)?;
                q = q.add_scaled(S::Scalar::from_f64(weight), &base.q.difference(&node.q));
                y = y.add_scaled(S::Scalar::from_f64(weight), &node.y);
            }
            Ok(State { t: state.t + h, q: base.q.retract(&q).renormalise(), y })
        })
    }
}

impl<S: GaussSystem, P: Problem<System = S>, M: EstimatingStep<S>> Drive<'_, S, P, M> {
    fn left(&self) -> f64 {
        (self.end - self.state.t).lane(0).abs()
    }

    fn cause(&self, gave: StopReason) -> IntegrationErrorKind {
        let Self { state, rates, .. } = self;
        let (stiff, length, lanes) =
            (self.control.method.properties().stiff, self.choice.length(), 0..S::Scalar::LANES);
        cause(self.problem, &StopPlace { state, rates, length, left: self.left(), stiff, lanes }, gave)
    }

    /// Tries a step. None when it is rejected, else how it was taken, and whether it was the last one.
    #[inline(always)]
    fn step(&mut self) -> Result<Option<(StepStatistics, bool)>, IntegrationErrorKind> {
        let signed = self.choice.propose(self.state.t, self.end - self.state.t)?;
        let (step, coarse) = match self.control.method.step_and_estimates(self.problem, self.state, self.rates, signed)
        {
            Ok(step) => step,
            Err(kind) => return self.halve(kind),
        };
        let (control, last, length) = (self.control, self.choice.is_last(), S::Scalar::from_f64(self.choice.used()));
        let error = self.error_of(&step, coarse.as_ref(), length);
        if self.choice.judge(error) {
            self.choice.reject();
            return Ok(None);
        }
        let mut reached = step.state;
        if last {
            reached.t = self.end;
        }
        let rates = match accept(self.problem, (self.state, self.rates), &mut reached, step.rates) {
            Ok(rates) => rates,
            Err(kind) => return self.halve(kind),
        };
        if S::CONSTRAINED {
            let trial = Trial { from: self.state, to: &reached, length, floor: None };
            let moved = match check_move(&control.tolerance, self.problem, &trial, &step.state) {
                Ok(moved) => moved,
                Err(kind) => return self.halve(kind),
            };
            if self.choice.ends_beside(self.problem, &trial, &moved, 0) {
                return Ok(None);
            }
        }
        let made = StepEnds { lane: 0, before: (self.state, self.rates), after: (&reached, &rates) };
        if self.problem.has_input() && self.choice.leads_over_input(self.problem, &made, &control.tolerance) {
            return Ok(None);
        }
        let excess = self.floor.as_ref().map_or(0.0, |floor| {
            let (from, to) = (&self.problem.in_speeds(self.state), &self.problem.in_speeds(&reached));
            control.tolerance.excess(&Trial { from, to, length, floor: Some(floor) })
        });
        (*self.state, *self.rates) = (reached, rates);
        let logarithm = logarithm(self.choice.told(excess));
        let growth = exponential(self.choice.exponent(logarithm));
        let (taken, again) = self.choice.take(excess, logarithm, growth);
        if again || self.floor.is_some() {
            self.look(again);
        }
        Ok(Some((taken, last)))
    }

    /// The error of a step as a part of the tolerance, in speeds; above what rounding does where that may be too much.
    #[inline(always)]
    fn error_of(&mut self, step: &Step<S>, coarse: Option<&Rates<S>>, length: S::Scalar) -> f64 {
        let tolerance = &self.control.tolerance;
        let measured = |change: &Rates<S>| self.problem.change_of_speeds(&step.state, change);
        let (fine, coarse) = (measured(&step.error), coarse.map(measured));
        let (from, to) = (&self.problem.in_speeds(self.state), &self.problem.in_speeds(&step.state));
        let above = |floor: &Floor<S>| tolerance.error_above(floor, (from, to, length), (&fine, coarse.as_ref()));
        if let Some(floor) = &*self.floor {
            return above(floor);
        }
        let error = tolerance.error(&Trial { from, to, length, floor: None }, &fine, coarse.as_ref());
        if !self.choice.judge(error) {
            return error;
        }
        let floor = Floor::at(self.problem, self.state, self.rates);
        let error = above(&floor);
        *self.floor = Some(floor);
        error
    }

    /// Measures what rounding does where the run is now, or forgets it.
    #[cold]
    #[inline(never)]
    fn look(&mut self, again: bool) {
        *self.floor = again.then(|| Floor::at(self.problem, self.state, self.rates));
    }

    #[cold]
    fn halve(&mut self, kind: IntegrationErrorKind) -> Result<Option<(StepStatistics, bool)>, IntegrationErrorKind> {
        let of = (0..S::Scalar::LANES, self.state.t, self.left());
        self.choice.halve(self.problem, (self.state, self.rates), of, kind).map(|()| None)
    }
}

/// The part of a step by which states on both sides of a place where constraints become dependent are apart from it.
const BESIDE: f64 = 0.03;

impl<M> Adaptive<M> {
    /// A step brought onto the constraints, or where it is where that would move it too far and its error is no more
    /// than the tolerance: beside a place where constraints become dependent the nearest state on them has other
    /// speeds.
    ///
    /// # Errors
    /// Where a stage is at such a place.
    fn on_constraints<S: GaussSystem, P: Problem<System = S>>(
        &self,
        problem: &P,
        (state, rates): (&State<S>, &Rates<S>),
        h: S::Scalar,
    ) -> Result<State<S>, IntegrationErrorKind>
    where
        M: EstimatingStep<S>,
    {
        let (step, coarse) = self.method.step_and_estimates(problem, state, rates, h)?;
        let projected = onto_constraints(problem, (state, rates), &step.state).and_then(|projected| {
            let trial = Trial { from: state, to: &projected, length: h.abs(), floor: None };
            check_move(&self.tolerance, problem, &trial, &step.state).map(|_| projected)
        });
        projected.or_else(|kind| {
            let measured = |change: &Rates<S>| problem.change_of_speeds(&step.state, change);
            let (fine, coarse) = (measured(&step.error), coarse.as_ref().map(measured));
            let (from, to) = (&problem.in_speeds(state), &problem.in_speeds(&step.state));
            let trial = Trial { from, to, length: h.abs(), floor: None };
            let error = self.tolerance.error(&trial, &fine, coarse.as_ref());
            if error <= 1.0 { Ok(step.state) } else { Err(kind) }
        })
    }
}

impl<M> Adaptive<M> {
    /// The choice of steps from a time over a span, in a run or a lane that is yet to [begin](Self::begin_steps).
    #[must_use]
    pub fn choice<S: GaussSystem>(&self, smoothness: Smoothness, from: f64, span: f64) -> StepChoice
    where
        M: EstimatingStep<S>,
    {
        let lengths = StepLength::new(self.method.estimate_order(), smoothness);
        StepChoice::new(span, lengths, Looks::new(self.input_changes, from, span))
    }

    /// Chooses the length of the first step, in some lanes together, and the longest, of a run of so many steps; `ones`
    /// is 1 in these lanes and 0 in others.
    ///
    /// # Errors
    /// When a length that was set is none, or too short for the steps.
    pub fn begin_steps<S, P>(
        &self,
        problem: &P,
        start: (&State<S>, &Rates<S>),
        of: &(S::Scalar, Range<usize>),
        limit: u64,
        choice: &mut StepChoice,
    ) -> Result<(), IntegrationErrorKind>
    where
        S: GaussSystem,
        P: Problem<System = S>,
        M: EstimatingStep<S>,
    {
        let span = choice.span;
        let longest = longest(self.largest_step, span, limit)?;
        Looks::check(self.input_changes)?;
        let first = self.first_step.unwrap_or_else(|| self.first_length(problem, start, of, span.signum()));
        if !(first.is_finite() && first > 0.0) {
            return Err(IntegrationErrorKind::InvalidStep { step: first });
        }
        (choice.length, choice.longest) = (first.min(longest), longest);
        Ok(())
    }

    /// A first step from the sizes of the state, of its derivative and of the change of the derivative over an Euler
    /// step (Hairer, Nørsett & Wanner, II.4), for some lanes together; `ones` is 1 in these and 0 in others.
    fn first_length<S, P>(
        &self,
        problem: &P,
        (start, rates): (&State<S>, &Rates<S>),
        (ones, lanes): &(S::Scalar, Range<usize>),
        direction: f64,
    ) -> f64
    where
        S: GaussSystem,
        P: Problem<System = S>,
        M: EstimatingStep<S>,
    {
        // The root mean square of the components of an error, each against its tolerance; the worst lane.
        let scaled_norm = |error: &Rates<S>| {
            let still = Trial { from: start, to: start, length: S::Scalar::zero(), floor: None };
            let errors = self.tolerance.errors(&still, error, None);
            lanes.clone().map(|lane| errors.lane(lane)).fold(0.0, worst)
        };
        let size = {
            // The state itself as an "error": |y| with the magnitudes of q.
            let mut sizes: Rates<S> = Rates { configuration: TangentOf::<S>::zero(), variables: start.y };
            for i in 0..TangentOf::<S>::DIM {
                sizes.configuration.set_component(i, start.q.magnitudes(i));
            }
            scaled_norm(&sizes)
        };
        let speed = scaled_norm(rates);
        let guess = if size < 1e-5 || speed < 1e-5 { 1e-6 } else { 0.01 * size / speed };
        // A component that is zero and moves has no size for a purely relative tolerance: any short step will do, and
        // the controller lengthens it.
        let guess = if guess > 0.0 && guess.is_finite() { guess } else { 1e-6 };
        // Not beyond a fraction of a turn.
        let turn = S::Configuration::increment_angle(&rates.configuration.scale(*ones));
        let guess = if turn * guess > 0.1 { 0.1 / turn } else { guess };

        let h = S::Scalar::from_f64(direction * guess) * *ones;
        let euler = State {
            t: start.t + h,
            q: start.q.retract(&rates.configuration.scale(h)),
            y: start.y.add_scaled(h, &rates.variables),
        };
        let next = problem.rates(&euler);
        if !next.is_finite() {
            return guess * 1e-3;
        }
        let change = Rates {
            configuration: next.configuration.add_scaled(-S::Scalar::one(), &rates.configuration),
            variables: next.variables.add_scaled(-S::Scalar::one(), &rates.variables),
        };
        let curvature = scaled_norm(&change) / guess;
        let steepest = speed.max(curvature);
        let second = if steepest <= 1e-15 {
            (guess * 1e-3).max(1e-6)
        } else {
            power(0.01 / steepest, 1.0 / self.method.estimate_order())
        };
        if second > 0.0 { second.min(100.0 * guess) } else { guess }
    }
}

#[cfg(test)]
#[path = "adaptive_tests.rs"]
mod tests;
