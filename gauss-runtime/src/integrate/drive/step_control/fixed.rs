//! Steps of one length.

use core::ops::ControlFlow;

use crate::integrate::drive::cause::{StopPlace, StopReason, cause};
use crate::integrate::drive::control::{Control, Progress, StepCallback, StepStatistics, one_step, prepare};
use crate::integrate::drive::projection::accept;
use crate::integrate::lie_group::rkmk::Rkmk;
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::error::{IntegrationError, IntegrationErrorKind};
use crate::integrate::problem::state::{Rates, State};
use crate::integrate::runge_kutta::components::RungeKutta;
use crate::integrate::runge_kutta::tableau::{DormandPrince8, Tableau};
use crate::integrate::step::one_step::OneStep;
use crate::real::Real;
use crate::system::GaussSystem;

/// Steps of one length, by any method of one step. The last one ends where it should.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Fixed<T, M = RungeKutta<DormandPrince8, 12>> {
    /// The method.
    pub method: M,
    /// The length of the steps, of either sign.
    pub step: T,
}

impl<T: Real> Fixed<T> {
    /// [`RungeKutta`] of [`DormandPrince8`] with steps of length |step|; the direction is that of the interval.
    #[must_use]
    pub fn new(step: T) -> Self {
        Self::by(RungeKutta(DormandPrince8), step)
    }
}

impl<T: Real, const S: usize> Fixed<T, Rkmk<T, S>> {
    /// The Runge–Kutta–Munthe-Kaas method of any tableau, for example [`Tableau::RK4`].
    #[must_use]
    pub fn with(tableau: &Tableau<S>, step: T) -> Self {
        Self::by(Rkmk::new(tableau), step)
    }
}

impl<T: Real, M> Fixed<T, M> {
    /// Any method, for example `Fixed::by(RungeKutta(Verner9), 0.1)`.
    #[must_use]
    pub fn by(method: M, step: T) -> Self {
        Self { method, step }
    }
}

/// The end of a step, and the derivatives there where they came with it.
pub type Advanced<S> = (State<S>, Option<Rates<S>>);

/// Number of steps of a length that fill a span of time. A remainder of a few roundings of the count is that of the
/// length and of the ends, not a step.
fn number_of_steps<T: Real>(span: f64, length: f64) -> f64 {
    let count = span.abs() / length;
    let unit = T::EPSILON.max(f64::EPSILON);
    let whole = Real::abs(count - round(count)) <= 8.0 * unit * count.max(1.0);
    if whole { round(count).max(1.0) } else { floor(count) + 1.0 }
}

/// Number of steps of a length that lead from one time to another, where these are no more than the limit and follow
/// one another: neighbouring times are numbers that differ where a step is no less than their distance there.
///
/// # Errors
/// [`IntegrationErrorKind::TooManySteps`], [`IntegrationErrorKind::TimeTooCoarse`].
pub fn steps_between<T: Real>([from, to]: [T; 2], length: f64, limit: u64) -> Result<u64, IntegrationErrorKind> {
    let steps = number_of_steps::<T>((to - from).lane(0), length);
    let [from, to] = [from, to].map(|t| t.lane(0));
    let time = if from.abs() > to.abs() { from } else { to };
    if steps > limit as f64 {
        Err(IntegrationErrorKind::TooManySteps { limit })
    } else if length < T::EPSILON * time.abs() {
        Err(IntegrationErrorKind::TimeTooCoarse { step: length, time })
    } else {
        Ok(steps as u64)
    }
}

/// A step of a length in the direction of a span.
///
/// # Errors
/// [`IntegrationErrorKind::InvalidStep`].
#[inline]
pub fn toward<T: Real>(step: T, span: f64) -> Result<T, IntegrationErrorKind> {
    let length = step.lane(0);
    if !(length.is_finite() && length != 0.0) {
        return Err(IntegrationErrorKind::InvalidStep { step: length });
    }
    Ok(if (span < 0.0) == (length < 0.0) { step } else { -step })
}

/// Steps of one length, the last one ending where it should, as a run makes them.
#[derive(Clone, Copy, Debug)]
pub struct EqualSteps<T> {
    start: T,
    /// Length of a step, with the sign of the direction.
    h: T,
    /// Numbers of all steps, and of those that are made.
    steps: u64,
    made: u64,
    /// Whether the method is stable where steps are longer than the fastest decay.
    stiff: bool,
}

impl<T: Real> EqualSteps<T> {
    /// A run by steps of length |length|, of which none is made, with what else its method remembers.
    #[inline]
    pub(in crate::integrate) fn start<S: GaussSystem<Scalar = T>, P: Problem<System = S>, R>(
        ((length, stiff), rest): ((T, bool), R),
        problem: &P,
        start: &State<S>,
        end: T,
        limit: u64,
        emit: &mut StepCallback<'_, S>,
    ) -> Result<Progress<S, (Self, R)>, IntegrationError> {
        let stopped = |state: &State<S>, kind| IntegrationError::at(problem, state, kind);
        let h = toward(length, (end - start.t).lane(0)).map_err(|kind| stopped(start, kind))?;
        let (_, state, rates) = prepare(problem, start, end).map_err(|kind| stopped(start, kind))?;
        let none = Self { start: state.t, h, steps: 0, made: 0, stiff };
        let mut run = Progress::new((state, rates), end, (none, rest), emit);
        if !run.ended {
            let steps = steps_between([state.t, end], h.lane(0).abs(), limit);
            run.memory.0.steps = steps.map_err(|kind| stopped(&state, kind))?;
        }
        Ok(run)
    }

    /// The number of all steps.
    pub(in crate::integrate) fn steps(&self) -> u64 {
        self.steps
    }

    /// The number of steps that are made.
    pub(in crate::integrate) fn made(&self) -> u64 {
        self.made
    }

    /// Whether the last step has the length of the others, but for a millionth.
    pub(in crate::integrate) fn ends_with_a_whole_step(&self, end: T) -> bool {
        let (last, length) = ((end - time(self.start, self.h, self.steps - 1)).lane(0), self.h.lane(0));
        (last.abs() - length.abs()).abs() <= 1e-6 * length.abs()
    }

    /// Length of a step, with the sign of the direction.
    pub(in crate::integrate) fn length(&self) -> T {
        self.h
    }
}

impl<S: GaussSystem, R> Progress<S, (EqualSteps<S::Scalar>, R)> {
    /// Goes on until so many steps are made, each by `advance` from the rest of the memory; whether anybody wants more.
    #[inline(always)]
    pub(in crate::integrate) fn until<P: Problem<System = S>>(
        &mut self,
        made: u64,
        problem: &P,
        emit: &mut StepCallback<'_, S>,
        mut advance: impl FnMut(&mut R, &State<S>, &Rates<S>, S::Scalar) -> Result<Advanced<S>, IntegrationErrorKind>,
    ) -> Result<ControlFlow<()>, IntegrationError> {
        // Copies, so that what steps work on stays in registers.
        let (now, rest) = &mut self.memory;
        let EqualSteps { start, h, steps, made: mut n, stiff } = *now;
        let (mut state, mut rates, end) = (self.state, self.rates, self.end);
        let mut flow = ControlFlow::Continue(());
        while n < made && flow.is_continue() {
            let last = n + 1 == steps;
            let this = if last { end - state.t } else { h };
            let failed = |kind| {
                let (length, left) = (h.lane(0).abs(), (end - state.t).lane(0).abs());
                let place = StopPlace { state: &state, rates: &rates, length, left, stiff, lanes: 0..S::Scalar::LANES };
                IntegrationError::at(problem, &state, cause(problem, &place, StopReason::Step(kind)))
            };
            let (mut next, known) = advance(rest, &state, &rates, this).map_err(failed)?;
            n += 1;
            next.t = if last { end } else { time(start, h, n) };
            let there = accept(problem, (&state, &rates), &mut next, known).map_err(failed)?;
            (state, rates) = (next, there);
            flow = emit(&state, &rates, StepStatistics::default());
        }
        now.made = n;
        (self.state, self.rates, self.ended) = (state, rates, n == steps);
        Ok(flow)
    }
}

/// Times are multiples of h, not sums of it.
#[inline(always)]
fn time<T: Real>(start: T, h: T, made: u64) -> T {
    T::from_f64(made as f64).fma(h, start)
}

impl<S: GaussSystem, M: OneStep<S>> Control<S> for Fixed<S::Scalar, M> {
    type StepMemory = (EqualSteps<S::Scalar>, ());

    #[inline]
    fn start<P: Problem<System = S>>(
        &self,
        problem: &P,
        start: State<S>,
        end: S::Scalar,
        limit: u64,
        emit: &mut StepCallback<'_, S>,
    ) -> Result<Progress<S, Self::StepMemory>, IntegrationError> {
        EqualSteps::start(((self.step, self.method.properties().stiff), ()), problem, &start, end, limit, emit)
    }

    #[inline]
    fn advance<P: Problem<System = S>>(
        &self,
        problem: &P,
        run: &mut Progress<S, Self::StepMemory>,
        emit: &mut StepCallback<'_, S>,
    ) -> Result<(), IntegrationError> {
        let flow = run.until(run.memory.0.steps, problem, emit, |(), state, rates, h| {
            self.method.step(problem, state, rates, h).map(|step| (step.state, step.rates))
        });
        flow.map(|_| ())
    }

    fn within<P: Problem<System = S>>(
        &self,
        problem: &P,
        state: &State<S>,
        rates: &Rates<S>,
        h: S::Scalar,
    ) -> Result<State<S>, IntegrationErrorKind> {
        one_step(&self.method, problem, state, rates, h)
    }
}

/// The integer part of a count; beyond 2⁵³ every number is an integer.
fn floor(count: f64) -> f64 {
    if count < 9.0e15 { (count as u64) as f64 } else { count }
}

fn round(count: f64) -> f64 {
    floor(count + 0.5)
}

#[cfg(test)]
mod tests {
    use core::cell::Cell;
    use core::ops::ControlFlow;

    use nalgebra::{UnitQuaternion, Vector3};

    use super::*;
    use crate::integrate::{Classical4, DormandPrince5, Feedback, InputSource, SystemProblem, VelocityForm};
    use crate::testing::FreeTop;
    use crate::testing::order::{TOP, TORQUE, start_by_velocity};

    /// A method whose last stage is the end of the step pays for the derivatives there once.
    #[test]
    fn fixed_steps_use_the_derivatives_that_come_with_a_step() {
        const STEPS: u32 = 20;
        fn evaluations(method: impl OneStep<FreeTop<f64>>) -> u32 {
            let count = Cell::new(0);
            let input = Feedback(|t: f64, q: &UnitQuaternion<f64>, z: &Vector3<f64>| {
                count.set(count.get() + 1);
                InputSource::<FreeTop<f64>>::input(&TORQUE, t, q, z)
            });
            let problem = SystemProblem { system: &TOP, form: VelocityForm, input };
            let nobody = &mut |_: &State<_>, _: &Rates<_>, _| ControlFlow::Continue(());
            let run = Fixed::by(method, 0.1).drive(&problem, start_by_velocity(), 2.0, u64::from(STEPS), nobody);
            run.expect("runs");
            count.get()
        }
        assert_eq!(evaluations(RungeKutta(DormandPrince5)), 1 + 6 * STEPS);
        assert_eq!(evaluations(Rkmk::new(&Tableau::DORMAND_PRINCE_5)), 1 + 6 * STEPS);
        assert_eq!(evaluations(RungeKutta(Classical4)), 1 + 4 * STEPS);
    }
}
