//! Control of a run: a method with its choice of steps, which carries a state over an interval.

use core::ops::ControlFlow;

use crate::configuration::Configuration;
use crate::integrate::drive::projection::{consistent_start, onto_constraints};
use crate::integrate::drive::tolerance::Tolerance;
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::error::{IntegrationError, IntegrationErrorKind, RunPart};
use crate::integrate::problem::state::{Rates, Sample, State};
use crate::integrate::step::checks::is_in_range;
use crate::integrate::step::one_step::{OneStep, check_contacts};
use crate::real::Real;
use crate::system::GaussSystem;

/// The largest number of steps of a run unless the user sets another limit: more steps would take minutes.
pub const DEFAULT_LIMIT: u64 = 100_000_000;

/// Rejected trials and rounding of the step to a state; a run sums them up in its
/// [`Summary`](crate::integrate::Summary).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct StepStatistics {
    /// Trials of that step that were rejected.
    pub rejected: u32,
    /// The ratio of rounding to tolerance where rounding alone is larger; 0 elsewhere.
    pub excess: f64,
}

impl StepStatistics {
    /// A step after so many rejected trials, with this ratio of rounding to tolerance.
    #[must_use]
    pub const fn new(rejected: u32, excess: f64) -> Self {
        Self { rejected, excess }
    }
}

/// A function that a run calls with each state that it reaches, the derivatives there, and the [`StepStatistics`] of
/// the step. It breaks to end the run.
pub type StepCallback<'a, S> = dyn FnMut(&State<S>, &Rates<S>, StepStatistics) -> ControlFlow<()> + 'a;

/// A run on its way over an interval: its state, and the memory of the control from step to step.
pub struct Progress<S: GaussSystem, M> {
    /// State of the run, on the constraints.
    pub state: State<S>,
    /// The derivatives there.
    pub rates: Rates<S>,
    /// The end of the interval.
    pub end: S::Scalar,
    /// Whether the run is there, or was ended before its first step.
    pub ended: bool,
    /// The memory of the choice of steps.
    pub memory: M,
}

impl<S: GaussSystem, M> Progress<S, M> {
    /// The same run with another memory.
    #[inline]
    pub(in crate::integrate) fn with<N>(self, memory: impl FnOnce(M) -> N) -> Progress<S, N> {
        let Self { state, rates, end, ended, memory: old } = self;
        Progress { state, rates, end, ended, memory: memory(old) }
    }

    /// Before the first step, told to `emit`.
    #[inline(always)]
    pub fn new(
        (state, rates): (State<S>, Rates<S>),
        end: S::Scalar,
        memory: M,
        emit: &mut StepCallback<'_, S>,
    ) -> Self {
        let ended = emit(&state, &rates, StepStatistics::default()).is_break() || (end - state.t).lane(0) == 0.0;
        Self { state, rates, end, ended, memory }
    }
}

// Written by hand: deriving would ask the same of the system, which is only named here.
impl<S: GaussSystem, M: Clone> Clone for Progress<S, M> {
    fn clone(&self) -> Self {
        Self { memory: self.memory.clone(), ..*self }
    }
}

/// A method with its choice of steps, which carries a state to the end of an interval.
#[diagnostic::on_unimplemented(
    message = "the steps of the simulation are not chosen",
    label = "`{Self}` chooses no steps",
    note = "add `.adaptive(1e-9, 1e-9)`, `.fixed_step(1e-3)` or `.control(…)` before the run"
)]
pub trait Control<S: GaussSystem> {
    /// The data that the choice of steps keeps from step to step: lengths, errors, derivatives of earlier steps.
    type StepMemory: Clone;

    /// Begins a run from `start` to the time `end` (before or after it), in at most `limit` steps, rejected ones
    /// included. `emit` gets the first state with the derivatives there.
    ///
    /// # Errors
    /// An [`IntegrationError`] where the run cannot begin.
    fn start<P: Problem<System = S>>(
        &self,
        problem: &P,
        start: State<S>,
        end: S::Scalar,
        limit: u64,
        emit: &mut StepCallback<'_, S>,
    ) -> Result<Progress<S, Self::StepMemory>, IntegrationError>;

    /// Makes steps until the end is reached or `emit` breaks, which gets every state reached with the derivatives
    /// there. With constraints, all of them satisfy these up to rounding. The run goes on from there by another call.
    ///
    /// # Errors
    /// An [`IntegrationError`] with the time of the last state emitted. Where this call was to make a single step, the
    /// run is at that state.
    fn advance<P: Problem<System = S>>(
        &self,
        problem: &P,
        run: &mut Progress<S, Self::StepMemory>,
        emit: &mut StepCallback<'_, S>,
    ) -> Result<(), IntegrationError>;

    /// Integrates from `start` to the time `end`: [`start`](Self::start), then [`advance`](Self::advance). When `emit`
    /// breaks, the run ends there, with the state that it got.
    ///
    /// # Errors
    /// An [`IntegrationError`] with the time of the last state emitted.
    #[inline]
    fn drive<P: Problem<System = S>>(
        &self,
        problem: &P,
        start: State<S>,
        end: S::Scalar,
        limit: u64,
        emit: &mut StepCallback<'_, S>,
    ) -> Result<State<S>, IntegrationError> {
        let mut run = self.start(problem, start, end, limit, emit)?;
        if !run.ended {
            self.advance(problem, &mut run, emit)?;
        }
        Ok(run.state)
    }

    /// The errors that a step may have, where the control has such a bound.
    fn tolerance(&self) -> Option<Tolerance> {
        None
    }

    /// The state a time `h` after `state`, where the derivatives are `rates`, with the accuracy of the method: what
    /// events and states between samples are made of. `h` has the sign of the run and is at most as long as the step
    /// that the run made from there. It depends continuously on `h` for the controls of this crate, which make one step
    /// of that length.
    ///
    /// # Errors
    /// When the step cannot be made.
    fn within<P: Problem<System = S>>(
        &self,
        problem: &P,
        state: &State<S>,
        rates: &Rates<S>,
        h: S::Scalar,
    ) -> Result<State<S>, IntegrationErrorKind> {
        let _ = rates;
        let nobody = &mut |_: &State<S>, _: &Rates<S>, _| ControlFlow::Continue(());
        self.drive(problem, *state, state.t + h, DEFAULT_LIMIT, nobody).map_err(|error| error.kind)
    }

    /// The states within one step, as a function of the time since its start: [`within`](Self::within), with whatever
    /// belongs to the step as a whole worked out once.
    fn along<P: Problem<System = S>>(
        &self,
        problem: &P,
        state: &State<S>,
        rates: &Rates<S>,
    ) -> impl FnMut(S::Scalar) -> Result<State<S>, IntegrationErrorKind> {
        let (state, rates) = (*state, *rates);
        move |h| self.within(problem, &state, &rates, h)
    }

    /// Whether steps are so long that the cubic between their ends is no approximation of the states within: events are
    /// then looked for among states of [`along`](Self::along).
    fn long_steps(&self) -> bool {
        false
    }
}

/// One step by a method, brought onto the constraints where there are any.
pub(in crate::integrate) fn one_step<S: GaussSystem, M: OneStep<S>, P: Problem<System = S>>(
    method: &M,
    problem: &P,
    state: &State<S>,
    rates: &Rates<S>,
    h: S::Scalar,
) -> Result<State<S>, IntegrationErrorKind> {
    let end = method.step(problem, state, rates, h)?.state;
    if S::CONSTRAINED { onto_constraints(problem, (state, rates), &end) } else { Ok(end) }
}

/// The state at a time within a step of a run, which the method reaches from the start of that step.
pub(in crate::integrate) fn within_step<S: GaussSystem, P: Problem<System = S>, C: Control<S>>(
    problem: &P,
    control: &C,
    from: &State<S>,
    t: S::Scalar,
) -> Result<Sample<S>, IntegrationError> {
    match control.within(problem, from, &problem.rates(from), t - from.t) {
        Ok(end) => Ok(problem.sample(&State { t, ..end })),
        Err(kind) => Err(IntegrationError::at(problem, from, kind)),
    }
}

/// Refuses tolerances that are negative, not finite, or both zero.
///
/// # Errors
/// [`IntegrationErrorKind::InvalidTolerance`].
pub fn check_tolerances(relative: f64, absolute: f64) -> Result<(), IntegrationErrorKind> {
    let usable = |tolerance: f64| tolerance.is_finite() && tolerance >= 0.0;
    if usable(relative) && usable(absolute) && relative + absolute > 0.0 {
        Ok(())
    } else {
        Err(IntegrationErrorKind::InvalidTolerance { relative, absolute })
    }
}

/// The longest step of a run over a span: the length that the user set, or the whole span. A length with which the run
/// could not reach its end within the limit of steps is refused before the first step.
///
/// # Errors
/// [`IntegrationErrorKind::InvalidStep`], [`IntegrationErrorKind::TooManySteps`].
pub fn longest(asked: Option<f64>, span: f64, limit: u64) -> Result<f64, IntegrationErrorKind> {
    let length = asked.unwrap_or(span.abs());
    if length.is_nan() || length <= 0.0 {
        return Err(IntegrationErrorKind::InvalidStep { step: length });
    }
    if span.abs() / length > limit as f64 {
        return Err(IntegrationErrorKind::TooManySteps { limit });
    }
    Ok(length.min(span.abs()))
}

/// A step of about this length from t that ends at a time which is a number: what is left of it once it has been added,
/// so that the state goes as far as the time does. Far from zero these differ by a rounding of t in each step.
#[inline(always)]
pub fn to_a_number<T: Real>(t: T, length: f64) -> T {
    let h = T::from_f64(length);
    // As a plain number: bounds and derivatives of t are none of the step's.
    T::from_f64(((t + h) - t).lane(0))
}

/// The length at or below which a step does nothing: a rounding of the time, or of what the span is to a rounding, for
/// runs that start at zero.
pub fn smallest<T: Real>(t: f64, span: f64) -> f64 {
    let unit = T::EPSILON.max(f64::EPSILON);
    0.5 * unit * t.abs().max(unit * span.abs())
}

/// The error for a step that does not change the time t. A run whose span is so short compared with t that less than
/// half of the digits of t resolve it gets [`IntegrationErrorKind::TimeTooCoarse`].
pub fn unresolved<T: Real>(step: f64, time: f64, span: f64) -> IntegrationErrorKind {
    if span.abs() < Real::sqrt(T::EPSILON) * time.abs() {
        IntegrationErrorKind::TimeTooCoarse { step, time }
    } else {
        IntegrationErrorKind::StepTooSmall { step }
    }
}

/// The span of time in the first lane, the start on the constraints, and the derivatives there: all checks before the
/// first step.
///
/// # Errors
/// When contacts would be left out unasked, the interval or the start is not finite, or the start is not on the
/// constraints.
pub fn prepare<S: GaussSystem, P: Problem<System = S>>(
    problem: &P,
    start: &State<S>,
    end: S::Scalar,
) -> Result<(f64, State<S>, Rates<S>), IntegrationErrorKind> {
    check_contacts(problem)?;
    let span = end - start.t;
    if !(start.t.is_finite() && end.is_finite() && span.is_finite()) {
        return Err(IntegrationErrorKind::InvalidInterval);
    }
    if !(start.q.is_finite() && is_in_range(&start.y)) {
        return Err(IntegrationErrorKind::NonFinite { part: RunPart::InitialState });
    }
    let start = consistent_start(problem, start)?;
    let rates = problem.rates(&start);
    if !rates.is_finite() {
        return Err(IntegrationErrorKind::NonFinite { part: RunPart::Derivative });
    }
    Ok((span.lane(0), start, rates))
}
