//! How long steps are: all the same, or as long as a tolerance allows.

use core::ops::ControlFlow;

use crate::configuration::{Configuration, VectorSpace};
use crate::integrate::drive::projection::{accept, consistent_start, on_constraints};
use crate::integrate::drive::step_length::{StepLength, power};
use crate::integrate::lie_group::rkmk::Rkmk;
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::error::{IntegrationError, IntegrationErrorKind, Part};
use crate::integrate::problem::state::{Rates, State, TangentOf};
use crate::integrate::runge_kutta::components::RungeKutta;
use crate::integrate::runge_kutta::tableau::{DormandPrince8, Tableau};
use crate::integrate::step::one_step::{EstimatingStep, OneStep};
use crate::real::Real;
use crate::system::GaussSystem;

/// What takes the states of a run, with the derivatives there, as they are reached; it breaks to end the run.
pub type Emit<'a, S> = dyn FnMut(&State<S>, &Rates<S>) -> ControlFlow<()> + 'a;

/// A method with its choice of steps, which carries a state to the end of an interval.
#[diagnostic::on_unimplemented(
    message = "it is not said how the simulation steps",
    label = "`{Self}` chooses no steps",
    note = "add `.adaptive(1e-9, 1e-9)`, `.fixed_step(1e-3)` or `.control(…)` before the run"
)]
pub trait Control<S: GaussSystem> {
    /// Integrates from `start` to the time `end` (before or after it), in at most `limit` steps. `emit` gets every state
    /// reached with the derivatives there, the first and the last included. With constraints, all of them satisfy these up
    /// to rounding. When `emit` breaks, the run ends there, with the state that it got.
    ///
    /// # Errors
    /// An [`IntegrationError`] with the time of the last state emitted.
    fn drive<P: Problem<System = S>>(
        &self,
        problem: &P,
        start: State<S>,
        end: S::Scalar,
        limit: u64,
        emit: &mut Emit<'_, S>,
    ) -> Result<State<S>, IntegrationError>;

    /// The state a time `h` after `state`, where the derivatives are `rates`, with the accuracy of the method: what events
    /// and dense output are made of. `h` has the sign of the run and is at most as long as the step that the run made from
    /// there. It depends continuously on `h` for the controls of this crate, which make one step of that length.
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
        let nobody = &mut |_: &State<S>, _: &Rates<S>| ControlFlow::Continue(());
        self.drive(problem, *state, state.t + h, u64::MAX, nobody).map_err(|error| error.kind)
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
    if S::CONSTRAINED { on_constraints(problem, &end) } else { Ok(end) }
}

/// Steps of one length, by any method of one step. The last one ends where it should.
#[derive(Clone, Copy, Debug)]
pub struct Fixed<T, M = RungeKutta<DormandPrince8, 12>> {
    method: M,
    step: T,
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

/// Steps that keep the estimated error of each within a tolerance: an embedded pair, or any other [`EstimatingStep`], with a PI
/// controller (Gustafsson; Hairer, Nørsett & Wanner II.4).
#[derive(Clone, Copy, Debug)]
pub struct Adaptive<M = RungeKutta<DormandPrince8, 12>> {
    method: M,
    relative: f64,
    absolute: f64,
    pub(in crate::integrate) first_step: Option<f64>,
    pub(in crate::integrate) largest_step: f64,
}

impl Adaptive {
    /// [`RungeKutta`] of [`DormandPrince8`].
    ///
    /// The error of a step is measured component by component against `absolute + relative·size`, where the size is
    /// |y| for velocities or momenta, 1 for a rotation, |b| for a translation and |q| for a plain coordinate, and the root
    /// mean square must not exceed 1.
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
    /// Any method that estimates its error, for example `Adaptive::by(RungeKutta(Verner9), 1e-12, 1e-12)`; tolerances as in
    /// [`Adaptive::new`].
    #[must_use]
    pub fn by(method: M, relative: f64, absolute: f64) -> Self {
        Self { method, relative, absolute, first_step: None, largest_step: f64::INFINITY }
    }
}

/// Refuses tolerances that are negative, not finite, or both zero.
pub(in crate::integrate) fn check_tolerances(relative: f64, absolute: f64) -> Result<(), IntegrationErrorKind> {
    let usable = |tolerance: f64| tolerance.is_finite() && tolerance >= 0.0;
    if usable(relative) && usable(absolute) && relative + absolute > 0.0 {
        Ok(())
    } else {
        Err(IntegrationErrorKind::InvalidTolerance { relative, absolute })
    }
}

/// The span of time in the first lane, the start on the constraints, and the derivatives there: all checks before the first
/// step.
pub(crate) fn prepare<S: GaussSystem, P: Problem<System = S>>(
    problem: &P,
    start: &State<S>,
    end: S::Scalar,
) -> Result<(f64, State<S>, Rates<S>), IntegrationErrorKind> {
    if !(start.t.is_finite() && end.is_finite()) {
        return Err(IntegrationErrorKind::InvalidInterval);
    }
    if !(start.q.is_finite() && start.y.is_finite()) {
        return Err(IntegrationErrorKind::NonFinite { part: Part::InitialState });
    }
    let start = consistent_start(problem, start)?;
    let rates = problem.rates(&start);
    if !rates.is_finite() {
        return Err(IntegrationErrorKind::NonFinite { part: Part::Derivative });
    }
    Ok(((end - start.t).lane(0), start, rates))
}

/// The end of a step, and the derivatives there where they came with it.
pub(in crate::integrate) type Advanced<S> = (State<S>, Option<Rates<S>>);

/// How many steps of a length fill a span of time. A remainder of a few roundings of the count is that of the length and of the
/// ends, not a step.
pub(crate) fn number_of_steps<T: Real>(span: f64, length: f64) -> f64 {
    let count = span.abs() / length;
    let unit = T::EPSILON.max(f64::EPSILON);
    let whole = Real::abs(count - round(count)) <= 8.0 * unit * count.max(1.0);
    if whole { round(count).max(1.0) } else { floor(count) + 1.0 }
}

/// Steps of length |length|, the last one ending where it should, each made by `advance`.
#[inline]
pub(in crate::integrate) fn steps_of_one_length<S: GaussSystem, P: Problem<System = S>>(
    length: S::Scalar,
    problem: &P,
    start: State<S>,
    end: S::Scalar,
    limit: u64,
    emit: &mut Emit<'_, S>,
    mut advance: impl FnMut(&State<S>, &Rates<S>, S::Scalar) -> Result<Advanced<S>, IntegrationErrorKind>,
) -> Result<State<S>, IntegrationError> {
    let stopped = |state: &State<S>, kind| IntegrationError::at(problem, state, kind);
    let positive = length.lane(0).abs();
    if !(positive.is_finite() && positive > 0.0) {
        return Err(stopped(&start, IntegrationErrorKind::InvalidStep { step: length.lane(0) }));
    }
    let (span, start, mut rates) = prepare(problem, &start, end).map_err(|kind| stopped(&start, kind))?;
    if emit(&start, &rates).is_break() || span == 0.0 {
        return Ok(start);
    }

    let steps = number_of_steps::<S::Scalar>(span, positive);
    if steps > limit as f64 {
        return Err(stopped(&start, IntegrationErrorKind::TooManySteps { limit }));
    }
    let h = if (span < 0.0) == (length.lane(0) < 0.0) { length } else { -length };

    let mut state = start;
    let steps = steps as u64;
    for n in 1..=steps {
        let last = n == steps;
        let this = if last { end - state.t } else { h };
        let (mut next, known) = advance(&state, &rates, this).map_err(|kind| stopped(&state, kind))?;
        // Times are multiples of h, not sums of it.
        next.t = if last { end } else { S::Scalar::from_f64(n as f64).fma(h, start.t) };
        rates = accept(problem, &mut next, known).map_err(|kind| stopped(&state, kind))?;
        state = next;
        if emit(&state, &rates).is_break() {
            break;
        }
    }
    Ok(state)
}

impl<S: GaussSystem, M: OneStep<S>> Control<S> for Fixed<S::Scalar, M> {
    fn drive<P: Problem<System = S>>(
        &self,
        problem: &P,
        start: State<S>,
        end: S::Scalar,
        limit: u64,
        emit: &mut Emit<'_, S>,
    ) -> Result<State<S>, IntegrationError> {
        steps_of_one_length(self.step, problem, start, end, limit, emit, |state, rates, h| {
            self.method.step(problem, state, rates, h).map(|step| (step.state, step.rates))
        })
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

impl<S: GaussSystem, M: EstimatingStep<S>> Control<S> for Adaptive<M> {
    fn drive<P: Problem<System = S>>(
        &self,
        problem: &P,
        start: State<S>,
        end: S::Scalar,
        limit: u64,
        emit: &mut Emit<'_, S>,
    ) -> Result<State<S>, IntegrationError> {
        let stopped = |state: &State<S>, kind| IntegrationError::at(problem, state, kind);
        check_tolerances(self.relative, self.absolute).map_err(|kind| stopped(&start, kind))?;
        let (span, start, mut rates) = prepare(problem, &start, end).map_err(|kind| stopped(&start, kind))?;
        if emit(&start, &rates).is_break() || span == 0.0 {
            return Ok(start);
        }

        let direction = if span < 0.0 { -1.0 } else { 1.0 };
        let lengths = self.first_and_longest(problem, &start, &rates, span);
        let (first, longest) = lengths.map_err(|kind| stopped(&start, kind))?;
        let mut state = start;
        let mut length = first;
        let mut lengths = StepLength::new(self.method.estimate_order(), S::SMOOTHNESS);
        for _ in 0..limit {
            let left = (end - state.t).lane(0).abs();
            // Stretch by 1 % rather than leave a sliver.
            let last = length >= left * 0.99;
            let signed = if last { end - state.t } else { S::Scalar::from_f64(direction * length) };
            if state.t + signed == state.t {
                return Err(stopped(&state, IntegrationErrorKind::StepTooSmall { step: length }));
            }
            let half = |kind| halved(&state, direction, length.min(left)).ok_or_else(|| stopped(&state, kind));
            let (step, coarse) = match self.method.step_and_estimates(problem, &state, &rates, signed) {
                Ok(step) => step,
                Err(kind) => {
                    length = half(kind)?;
                    lengths.fail();
                    continue;
                }
            };
            let error = self.scaled_error(&state, &step.state, &step.error, coarse.as_ref());
            let used = if last { left } else { length };
            if error.is_nan() || error > lengths.limit() {
                length = used * lengths.reject(error);
                continue;
            }
            let mut reached = step.state;
            if last {
                reached.t = end;
            }
            rates = match accept(problem, &mut reached, step.rates) {
                Ok(rates) => rates,
                Err(kind) => {
                    length = half(kind)?;
                    lengths.fail();
                    continue;
                }
            };
            state = reached;
            if emit(&state, &rates).is_break() || last {
                return Ok(state);
            }
            length = (used * lengths.accept(error)).min(longest);
        }
        Err(stopped(&state, IntegrationErrorKind::TooManySteps { limit }))
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

/// When a step fails a shorter one may do: half of its length, as long as that still changes the time.
fn halved<S: GaussSystem>(state: &State<S>, direction: f64, length: f64) -> Option<f64> {
    let half = 0.5 * length;
    (state.t + S::Scalar::from_f64(direction * half) != state.t).then_some(half)
}

impl<M> Adaptive<M> {
    /// The lengths of the first step and of the longest.
    fn first_and_longest<S, P>(
        &self,
        problem: &P,
        start: &State<S>,
        rates: &Rates<S>,
        span: f64,
    ) -> Result<(f64, f64), IntegrationErrorKind>
    where
        S: GaussSystem,
        P: Problem<System = S>,
        M: EstimatingStep<S>,
    {
        let longest = self.largest_step.min(span.abs());
        let first = self.first_step.unwrap_or_else(|| self.first_length(problem, start, rates, span.signum()));
        if first.is_finite() && first > 0.0 && longest > 0.0 {
            Ok((first.min(longest), longest))
        } else {
            Err(IntegrationErrorKind::InvalidStep { step: first.min(longest) })
        }
    }

    /// The error of a step in tolerances: the root mean square over the components, of the worst lane. NaN when an error is.
    #[inline(always)]
    fn scaled_error<S: GaussSystem>(
        &self,
        from: &State<S>,
        to: &State<S>,
        fine: &Rates<S>,
        coarse: Option<&Rates<S>>,
    ) -> f64 {
        let components = (TangentOf::<S>::DIM + S::Speeds::DIM).max(1) as f64;
        let mut worst = 0.0;
        for lane in 0..S::Scalar::LANES {
            let squares = |size: f64, fine: S::Scalar, coarse: Option<S::Scalar>| {
                // Purely relative control of a null component asks for what is null too.
                let per_tolerance = 1.0 / (self.absolute + self.relative * size).max(f64::MIN_POSITIVE);
                let square = |error: S::Scalar| {
                    let ratio = error.lane(lane) * per_tolerance;
                    ratio * ratio
                };
                [square(fine), coarse.map_or(0.0, square)]
            };
            let sum = |[a, b]: [f64; 2], [c, d]: [f64; 2]| [a + c, b + d];
            let (mut of_q, mut of_y) = ([0.0; 2], [0.0; 2]);
            for i in 0..TangentOf::<S>::DIM {
                let size = from.q.magnitude(i).max(to.q.magnitude(i));
                let coarse = coarse.map(|coarse| coarse.configuration.component(i));
                of_q = sum(of_q, squares(size, fine.configuration.component(i), coarse));
            }
            for i in 0..S::Speeds::DIM {
                let size = from.y.component(i).lane(lane).abs().max(to.y.component(i).lane(lane).abs());
                let coarse = coarse.map(|coarse| coarse.variables.component(i));
                of_y = sum(of_y, squares(size, fine.variables.component(i), coarse));
            }
            let [fine, coarse] = sum(of_q, of_y);
            let error = Real::sqrt(combined(fine, coarse) * (1.0 / components));
            // Written so that a NaN stays.
            worst = if error <= worst { worst } else { error };
        }
        worst
    }

    /// The root mean square of the components of `error`, each against its tolerance; the worst lane.
    fn scaled_norm<S: GaussSystem>(&self, from: &State<S>, to: &State<S>, error: &Rates<S>) -> f64 {
        self.scaled_error(from, to, error, None)
    }

    /// A first step from the sizes of the state, of its derivative and of the change of the derivative over an Euler step
    /// (Hairer, Nørsett & Wanner, II.4).
    fn first_length<S, P>(&self, problem: &P, start: &State<S>, rates: &Rates<S>, direction: f64) -> f64
    where
        S: GaussSystem,
        P: Problem<System = S>,
        M: EstimatingStep<S>,
    {
        let size = {
            // The state itself as an "error": |y| with the magnitudes of q.
            let mut sizes: Rates<S> = Rates { configuration: TangentOf::<S>::zero(), variables: start.y };
            for i in 0..TangentOf::<S>::DIM {
                sizes.configuration.set_component(i, S::Scalar::from_f64(start.q.magnitude(i)));
            }
            self.scaled_norm(start, start, &sizes)
        };
        let speed = self.scaled_norm(start, start, rates);
        let guess = if size < 1e-5 || speed < 1e-5 { 1e-6 } else { 0.01 * size / speed };
        // A component that is zero and moves has no size for a purely relative tolerance: any short step will do, and the
        // controller lengthens it.
        let guess = if guess > 0.0 && guess.is_finite() { guess } else { 1e-6 };
        // Not beyond a fraction of a turn.
        let turn = S::Configuration::increment_angle(&rates.configuration);
        let guess = if turn * guess > 0.1 { 0.1 / turn } else { guess };

        let h = S::Scalar::from_f64(direction * guess);
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
        let curvature = self.scaled_norm(start, start, &change) / guess;
        let steepest = speed.max(curvature);
        let second = if steepest <= 1e-15 {
            (guess * 1e-3).max(1e-6)
        } else {
            power(0.01 / steepest, 1.0 / self.method.estimate_order())
        };
        if second > 0.0 { second.min(100.0 * guess) } else { guess }
    }
}

/// The square of `e²/√(e² + ê²/100)` from the squares of e and ê: that of e itself where ê is too large or too small beside it
/// for the formula to be computed.
fn combined(fine: f64, coarse: f64) -> f64 {
    let part = fine / (fine + 0.01 * coarse);
    if part > 0.0 { fine * part } else { fine }
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

    use nalgebra::{UnitQuaternion, Vector3};

    use super::*;
    use crate::integrate::{Classical4, DormandPrince5, Feedback, Simulation, VelocityForm, Verner9};
    use crate::integrate::{InputSource, SystemProblem};
    use crate::testing::FreeTop;
    use crate::testing::order::{TOP, TORQUE, distance, fitted_order, march, start_by_velocity};

    #[test]
    fn two_estimates_make_one() {
        assert_eq!(combined(1e-6, 0.0), 1e-6);
        // e = 3, ê/10 = 4.
        assert!((combined(9.0, 1600.0) - (9.0_f64 / 5.0).powi(2)).abs() < 4.0 * f64::EPSILON);
        // What cannot be computed is not taken for small.
        assert_eq!(combined(0.0, 0.0), 0.0);
        assert_eq!(combined(0.0, 1.0), 0.0);
        assert_eq!(combined(1e-200, f64::INFINITY), 1e-200);
        assert_eq!(combined(f64::INFINITY, f64::INFINITY), f64::INFINITY);
        assert!(combined(f64::NAN, 1.0).is_nan());
    }

    /// Over some states of a motion together, because where a leading term vanishes the slope says nothing.
    #[test]
    fn estimates_go_with_the_power_that_the_control_takes() {
        fn measured(method: impl EstimatingStep<FreeTop<f64>>) -> (f64, f64) {
            let control = Adaptive::by(method, 0.0, 1.0);
            let problem = SystemProblem { system: &TOP, form: VelocityForm, input: TORQUE };
            let points = [0.05, 0.065, 0.08, 0.1].map(|h| {
                let mut start: State<FreeTop<f64>> = start_by_velocity();
                let mut sum = 0.0;
                for _ in 0..20 {
                    start = march(&control.method, &problem, &start, 0.5, 5);
                    let rates = problem.rates(&start);
                    let (step, coarse) = control.method.step_and_estimates(&problem, &start, &rates, h).expect("steps");
                    sum += control.scaled_error(&start, &step.state, &step.error, coarse.as_ref());
                }
                (h, sum)
            });
            // The sum of twenty estimates, each of steps a tenth long and less.
            (control.method.estimate_order(), fitted_order(&points, f64::EPSILON))
        }
        for (stated, found) in [
            measured(Rkmk::new(&Tableau::DORMAND_PRINCE_5)),
            measured(Rkmk::new(&Tableau::DORMAND_PRINCE_8)),
            measured(Rkmk::new(&Tableau::VERNER_9)),
            measured(RungeKutta(DormandPrince5)),
            measured(RungeKutta(DormandPrince8)),
            measured(RungeKutta(Verner9)),
        ] {
            assert!((found - stated).abs() < 0.5, "{found} instead of {stated}");
        }
    }

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
            let nobody = &mut |_: &State<_>, _: &Rates<_>| ControlFlow::Continue(());
            let run = Fixed::by(method, 0.1).drive(&problem, start_by_velocity(), 2.0, u64::from(STEPS), nobody);
            run.expect("runs");
            count.get()
        }
        assert_eq!(evaluations(RungeKutta(DormandPrince5)), 1 + 6 * STEPS);
        assert_eq!(evaluations(Rkmk::new(&Tableau::DORMAND_PRINCE_5)), 1 + 6 * STEPS);
        assert_eq!(evaluations(RungeKutta(Classical4)), 1 + 4 * STEPS);
    }

    /// Down to rounding, the pairs of orders 8 and 9 stay within a few tolerances and take fewer evaluations than order 5, the
    /// more so the smaller the tolerance.
    #[test]
    fn high_orders_keep_the_tolerance_for_less() {
        fn run(method: impl EstimatingStep<FreeTop<f64>>, stages: usize, tolerance: f64) -> (f64, usize, usize) {
            let start = start_by_velocity();
            let control = Adaptive::by(method, tolerance, tolerance);
            let run = Simulation::new(&TOP).input_from(TORQUE).control(control).run(start.q, start.y, 0.0..10.0);
            let run = run.expect("runs");
            let end = run.last();
            let problem = SystemProblem { system: &TOP, form: VelocityForm, input: TORQUE };
            let exact = march(&Rkmk::new(&Tableau::VERNER_9), &problem, &start, 10.0, 1000);
            let steps = run.len() - 1;
            (distance(&State { t: end.t, q: end.q, y: end.z }, &exact), steps, steps * stages)
        }
        for tolerance in [1e-6, 1e-8, 1e-10, 1e-12] {
            for [five, eight, nine] in [
                [
                    run(Rkmk::new(&Tableau::DORMAND_PRINCE_5), 6, tolerance),
                    run(Rkmk::new(&Tableau::DORMAND_PRINCE_8), 12, tolerance),
                    run(Rkmk::new(&Tableau::VERNER_9), 16, tolerance),
                ],
                [
                    run(RungeKutta(DormandPrince5), 6, tolerance),
                    run(RungeKutta(DormandPrince8), 12, tolerance),
                    run(RungeKutta(Verner9), 16, tolerance),
                ],
            ] {
                // Errors of steps add up, and are carried on about as large; sizes are up to 2.
                for (error, steps, _) in [five, eight, nine] {
                    assert!(error < 3.0 * steps as f64 * tolerance, "{tolerance:e}: {error:e} in {steps} steps");
                }
                assert!(eight.2 < five.2 && nine.2 < five.2, "{tolerance:e}: {} {} {}", five.2, eight.2, nine.2);
                if tolerance == 1e-12 {
                    assert!(3 * eight.2 < five.2 && nine.2 < eight.2, "{} {} {}", five.2, eight.2, nine.2);
                }
            }
        }
    }
}
