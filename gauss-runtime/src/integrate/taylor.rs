//! Taylor's method: each step sums the power series of the solution, as far as the tolerance asks for.
//!
//! The coefficients come from the derive (`#[gauss(taylor)]`, [`TaylorSystem`]), exact up to rounding at any order, so
//! a step may be nearly as long as the radius of convergence allows: at tolerances of 1e-9 and less the cheapest way to
//! a trajectory of a smooth system. Order and step are those of Jorba & Zou (Experimental Mathematics 14, 2005): the
//! last two terms of the series are to be as small as the tolerance. A step is rejected only where the projection onto
//! constraints fails or moves it too far.

use core::ops::Range;

use crate::configuration::{Configuration, VectorSpace};
use crate::integrate::drive::cause::{StopPlace, StopReason, cause};
use crate::integrate::drive::control::{
    Control, Progress, StepCallback, StepStatistics, check_tolerances, longest, prepare, smallest, to_a_number,
    unresolved,
};
use crate::integrate::drive::pace::Pace;
use crate::integrate::drive::projection::{accept, check_move, is_hopeless, onto_constraints};
use crate::integrate::drive::simulation::Simulation;
use crate::integrate::drive::step_length::StepLength;
use crate::integrate::drive::tolerance::{Tolerance, Trial};
use crate::integrate::problem::equations::{Problem, SystemProblem};
use crate::integrate::problem::error::{IntegrationError, IntegrationErrorKind, RunPart};
use crate::integrate::problem::state::{Rates, State};
use crate::integrate::step::checks::check_chart;
use crate::real::Real;
use crate::series::{MAX_ORDER, PowerSeries, TaylorSystem, state_of};
use crate::system::GaussSystem;

/// Steps of Taylor's method, as long as the tolerances allow.
///
/// The momentum form is integrated as the velocity form is, from and to momenta at the ends of steps.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Taylor {
    /// The relative tolerance.
    pub relative: f64,
    /// The absolute tolerance.
    pub absolute: f64,
    /// The order of the series; chosen on the way where there is none.
    pub order: Option<usize>,
    /// The longest step.
    pub largest_step: Option<f64>,
}

/// Orders per e-fold of the tolerance, to begin with. At order p steps are as long as ρ ε^(1/p): ½ is best where the
/// cost of a step goes with p², 1 where it goes with p.
const ORDERS: f64 = 0.75;

/// The part of a tolerance that a series leaves out. All that is left out is an error of the step, where the estimate
/// of an embedded pair is the error of its lower order and the step is better: with a whole tolerance Taylor's method
/// is up to 23 times less exact than order 8 at the same one, most of all where errors grow (a pendulum upside down, a
/// wing nut), with a 32nd about as exact. It takes two or three orders more, or steps shorter by a sixth: a seventh
/// more work.
const LEFT_OUT: f64 = 1.0 / 32.0;

/// The part of a rounding of the state below which nothing need be left out of a series.
const LEAST: f64 = 1.0 / 64.0;

/// So many times a step is tried again that the projection onto constraints moves too far: each time the series is
/// expanded anew.
const SHORTENED: u32 = 8;

/// The lowest order that is chosen, and how far apart orders are compared.
const LOWEST: usize = 6;
const APART: usize = 4;

impl Taylor {
    /// The error of each component in a step is kept well below `absolute + relative·size`, as that of order 8 is,
    /// where the size is 1 for a rotation, the largest component of a translation, |q| for a plain coordinate and |z|
    /// for a speed.
    #[must_use]
    pub fn new(relative: f64, absolute: f64) -> Self {
        Self { relative, absolute, order: None, largest_step: None }
    }

    /// Series of one order, from 2 to [`MAX_ORDER`], instead of one that follows from the tolerance.
    #[must_use]
    pub fn of_order(mut self, order: usize) -> Self {
        self.order = Some(order.clamp(2, MAX_ORDER));
        self
    }

    /// The longest step.
    #[must_use]
    pub fn largest_step(mut self, length: f64) -> Self {
        self.largest_step = Some(length);
        self
    }

    /// About the ratio of the last term of the series to the first.
    fn tolerance(&self) -> f64 {
        (LEFT_OUT * self.relative.max(self.absolute)).clamp(1e-18, 0.1)
    }

    /// The order of the first series of a run.
    fn first_order(&self) -> usize {
        let order = -Real::ln(self.tolerance()) * ORDERS + 2.0;
        self.order.unwrap_or((order as usize).clamp(LOWEST, MAX_ORDER))
    }

    /// ln of the ratio of the remainder of a series to its last term: terms fall to the tolerance by a ratio r in each
    /// order, and the terms of the remainder are r/(1 − r) of the last one together.
    fn tail(&self, order: usize) -> f64 {
        let ratio = Real::exp(Real::ln(self.tolerance()) / order as f64);
        Real::ln(ratio / (1.0 - ratio))
    }

    /// ln of the longest steps at two orders with the given tails, so that what is left out of the series is within the
    /// tolerance. It is judged by the last two terms, since one of them may be small by chance. `guess` is about as
    /// long, for the sizes.
    ///
    /// Beside them, how many times the tolerance rounding is where it is more: less than that cannot be left out.
    fn lengths<S: TaylorSystem>(
        &self,
        series: &S::Series,
        judged: [(usize, f64); 2],
        guess: f64,
        lanes: Range<usize>,
    ) -> ([f64; 2], f64) {
        let mut beyond = 0.0_f64;
        let mut excess = [[0.0_f64; 2]; 2];
        let worse = |a: f64, b: f64| if b > a || b.is_nan() { b } else { a };
        let mut first = 0;
        for &group in S::GROUPS {
            for lane in lanes.clone() {
                let value = |k: usize, i: usize| series.coefficient(k).component(i).lane(lane);
                let (mut size, mut terms) = (0.0, [[0.0_f64; 2]; 2]);
                for i in first..first + group {
                    let start = value(0, i);
                    size = worse(worse(size, start.abs()), (start + guess * value(1, i)).abs());
                    for (terms, (order, _)) in terms.iter_mut().zip(judged) {
                        *terms = [worse(terms[0], value(order - 1, i).abs()), worse(terms[1], value(order, i).abs())];
                    }
                }
                let asked = (self.absolute + self.relative * size).max(f64::MIN_POSITIVE);
                let rounding = LEAST * S::Scalar::EPSILON * size;
                beyond = beyond.max(rounding / asked);
                let tolerance = (LEFT_OUT * asked).max(rounding);
                for (excess, terms) in excess.iter_mut().zip(terms) {
                    *excess = [worse(excess[0], terms[0] / tolerance), worse(excess[1], terms[1] / tolerance)];
                }
            }
            first += group;
        }
        let length = |[before, last]: [f64; 2], (order, tail): (usize, f64)| {
            let of = |excess: f64, k: usize| -(Real::ln(excess) + tail) / k as f64;
            let (before, last) = (of(before, order - 1), of(last, order));
            if before < last || before.is_nan() { before } else { last }
        };
        let lengths = [length(excess[0], judged[0]), length(excess[1], judged[1])];
        (lengths, if beyond > 1.0 { beyond } else { 0.0 })
    }
}

/// Relative cost of a step: a part for each step, one for each order, one for each product of two orders. Measured on
/// bodies.
fn cost(order: usize) -> f64 {
    let p = order as f64;
    1.0 + p / 3.0 + p * p / 200.0
}

/// The order of the series, and what goes with it.
#[derive(Clone, Copy)]
pub struct Order {
    /// Orders to judge steps at: [`APART`] lower, and the present one, with their tails.
    judged: [(usize, f64); 2],
    /// ln of the least gain in length that makes up for the lower order's lower cost, and for a higher order's higher
    /// cost.
    worth: [f64; 2],
}

impl Order {
    /// Before the first step of a run.
    #[must_use]
    pub fn first(control: &Taylor) -> Self {
        Self::new(control, control.first_order())
    }

    /// Series of this order, from 2 on.
    fn new(control: &Taylor, order: usize) -> Self {
        let lower = order.saturating_sub(APART).max(2);
        let worth = |from: usize, to: usize| Real::ln(cost(to) / cost(from));
        Self {
            judged: [lower, order].map(|order| (order, control.tail(order))),
            worth: [worth(lower, order), worth(order, order + APART)],
        }
    }

    /// The order.
    #[must_use]
    pub fn value(&self) -> usize {
        self.judged[1].0
    }

    /// Chooses the order for the next step, where none was set: what is better for most of those that were taken.
    pub fn choose<'a>(&mut self, control: &Taylor, taken: impl Iterator<Item = &'a SeriesStep>) {
        if control.order.is_some() {
            return;
        }
        let (mut sum, mut count) = ([0.0; 2], 0.0);
        for SeriesStep { lengths, .. } in taken.filter(|step| step.tried < step.longest) {
            sum = [sum[0] + lengths[0], sum[1] + lengths[1]];
            count += 1.0;
        }
        if count > 0.0 {
            let better = self.better(sum.map(|lengths| lengths / count));
            if better != self.value() {
                *self = Self::new(control, better);
            }
        }
    }

    /// The order that makes more way for its cost, from ln of the lengths of steps.
    fn better(&self, [short, long]: [f64; 2]) -> usize {
        let ([(lower, _), (order, _)], gain) = (self.judged, long - short);
        if gain < self.worth[0] {
            return (order - 2).max(LOWEST.min(order));
        }
        // ln h is affine in 1/p.
        let further = gain * lower as f64 / (order + APART) as f64;
        if further > self.worth[1] { (order + 2).min(MAX_ORDER) } else { order }
    }
}

/// The choice of the lengths of steps of a run, or of a lane, as it goes on.
#[derive(Clone, Copy)]
pub struct SeriesStep {
    span: f64,
    longest: f64,
    /// About the length of the last step; 0 before the first.
    length: f64,
    /// The present trial: ln of the lengths that the series allows at the orders that are compared, its own length,
    /// whether it is the last step, and how much rounding is beyond the tolerance.
    lengths: [f64; 2],
    tried: f64,
    last: bool,
    excess: f64,
    /// The part of the length that the series allows, and why it is not all of it: the projection onto the constraints
    /// would move the step farther than its error.
    shortened: Option<(f64, IntegrationErrorKind)>,
    rejected: u32,
}

impl SeriesStep {
    /// Before a run over a span, whose longest step is not known yet.
    #[must_use]
    pub fn new(span: f64) -> Self {
        let (longest, length, lengths, tried, excess) = (0.0, 0.0, [0.0; 2], 0.0, 0.0);
        Self { span, longest, length, lengths, tried, last: false, excess, shortened: None, rejected: 0 }
    }

    /// The run begins, with so many steps allowed.
    ///
    /// # Errors
    /// When the longest step that was set is none, or too short for the steps.
    pub fn begin(&mut self, control: &Taylor, limit: u64) -> Result<(), IntegrationErrorKind> {
        self.longest = longest(control.largest_step, self.span, limit)?;
        Ok(())
    }

    /// About the length of the last step.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.length
    }

    /// Whether the present trial is the last step.
    #[must_use]
    pub fn is_last(&self) -> bool {
        self.last
    }

    fn part(&self) -> f64 {
        self.shortened.map_or(1.0, |(part, _)| part)
    }

    /// The step to try from a time with this time left, with its sign, as long as the series in some lanes allows.
    ///
    /// # Errors
    /// When it would do nothing, or the series has no length.
    pub fn propose<S: TaylorSystem, T: Real>(
        &mut self,
        control: &Taylor,
        (series, order): (&S::Series, &Order),
        (t, rest): (T, T),
        lanes: Range<usize>,
    ) -> Result<T, IntegrationErrorKind> {
        let direction = if self.span < 0.0 { -1.0 } else { 1.0 };
        (self.lengths, self.excess) = control.lengths::<S>(series, order.judged, direction * self.length, lanes);
        let length = Real::exp(self.lengths[1]);
        // A NaN among the coefficients makes no length; where they are all zero the system is at rest.
        if length.is_nan() {
            return Err(IntegrationErrorKind::NonFinite { part: RunPart::Derivative });
        }
        self.tried = (length * self.part()).min(self.longest);
        self.last = self.tried >= rest.lane(0).abs() * 0.999;
        let h = if self.last { rest } else { to_a_number(t, direction * self.tried) };
        if t + h == t || !self.last && self.tried <= smallest::<T>(t.lane(0), self.span) {
            let unresolved = unresolved::<T>(self.tried, t.lane(0), self.span);
            return Err(self.shortened.map_or(unresolved, |(_, kind)| kind));
        }
        Ok(h)
    }

    /// The trial is taken.
    pub fn take(&mut self) -> StepStatistics {
        (self.length, self.shortened) = (self.tried, None);
        StepStatistics { rejected: core::mem::take(&mut self.rejected), excess: self.excess }
    }

    /// After a step from a state that failed in some lanes: a shorter one may do.
    ///
    /// # Errors
    /// The one that is given, where none will.
    #[cold]
    pub fn shorten<S: TaylorSystem, P: Problem<System = S>>(
        &mut self,
        (problem, state): (&P, &State<S>),
        lanes: Range<usize>,
        kind: IntegrationErrorKind,
    ) -> Result<(), IntegrationErrorKind> {
        use IntegrationErrorKind::{Projection, ProjectionTooFar};
        self.rejected += 1;
        let again = self.rejected <= SHORTENED
            && matches!(kind, Projection { .. } | ProjectionTooFar { .. })
            && !is_hopeless(problem, state, lanes, (&kind, self.rejected));
        self.shortened = Some((self.part() * StepLength::part(&kind), kind));
        if again { Ok(()) } else { Err(kind) }
    }
}

/// The state a time h after the one that the series starts from.
pub fn summed<S, P>(problem: &P, t: S::Scalar, series: &S::Series, order: usize, h: S::Scalar) -> State<S>
where
    S: TaylorSystem,
    P: Problem<System = S>,
{
    let (q, z) = state_of::<S>(&series.at(order, h));
    problem.state(t + h, q.renormalise(), &z)
}

/// The series from a state, to this order.
pub fn expanded<S: TaylorSystem, P: Problem<System = S>>(
    problem: &P,
    state: &State<S>,
    order: usize,
    series: &mut S::Series,
) {
    let State { t, q, y } = state;
    problem.system().expand(*t, q, &problem.speeds(*t, q, y), order, series);
}

impl Taylor {
    /// Checks the end of a step and brings it onto the constraints; gives the derivatives there.
    ///
    /// # Errors
    /// When the step is to be refused.
    pub fn accepted<S: TaylorSystem, P: Problem<System = S>>(
        &self,
        problem: &P,
        from: (&State<S>, &Rates<S>),
        reached: &mut State<S>,
    ) -> Result<Rates<S>, IntegrationErrorKind> {
        if !(reached.q.is_finite() && reached.y.is_finite()) {
            return Err(IntegrationErrorKind::NonFinite { part: RunPart::Step });
        }
        check_chart(problem.system(), from.0, reached)?;
        let computed = *reached;
        let rates = accept(problem, from, reached, None)?;
        if S::CONSTRAINED {
            let tolerance = Tolerance { relative: self.relative, absolute: self.absolute };
            let length = (reached.t - from.0.t).abs();
            check_move(&tolerance, problem, &Trial { from: from.0, to: reached, length, floor: None }, &computed)?;
        }
        Ok(rates)
    }
}

// What a run needs is asked where it runs: there the message can name the clause that is missing.
impl<'k, S: GaussSystem, F, I, C, O, E> Simulation<SystemProblem<'k, S, F, I>, C, O, E> {
    /// Taylor's method with steps and orders as the tolerances ask: the cheapest way to a trajectory of a smooth
    /// system, from tolerances of about 1e-6 on, and further than other methods can go.
    ///
    #[cfg_attr(
        feature = "derive",
        doc = r##"
The energy of a fast top after a hundred turns, to some roundings:

```
use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(motion = fixed_point, taylor)]
struct Top {
    #[gauss(mass)]           mass: f64,
    #[gauss(center_of_mass)] center: Vector3<f64>,
    #[gauss(inertia)]        inertia: Vector3<f64>,
    #[gauss(gravity)]        g: f64,
}

# fn main() -> Result<(), Box<dyn std::error::Error>> {
let top = Top { mass: 1.0, center: Vector3::new(0.0, 0.0, 0.4), inertia: Vector3::new(0.2, 0.2, 0.05), g: 9.81 };
let kernel = top.kernel()?;
let (tilted, spinning) = (UnitQuaternion::from_euler_angles(0.3, 0.0, 0.0), Vector3::new(0.0, 0.0, 40.0));
let end = Simulation::new(&kernel).taylor(1e-16, 1e-16).run_to_end(tilted, spinning, 0.0..16.0)?;
let (before, after) = (kernel.energy(0.0, &tilted, &spinning), kernel.energy(end.t, &end.q, &end.z));
assert!((after - before).abs() < 1e-13 * before);
# Ok(())
# }
```
"##
    )]
    pub fn taylor(self, relative: f64, absolute: f64) -> Simulation<SystemProblem<'k, S, F, I>, Taylor, O, E> {
        self.control(Taylor::new(relative, absolute))
    }
}

/// The choice of orders and steps of a run, as it goes on.
#[derive(Clone, Copy)]
pub struct OrderChoice {
    limit: u64,
    pace: Pace,
    order: Order,
    step: SeriesStep,
}

impl<S: TaylorSystem> Control<S> for Taylor {
    type StepMemory = OrderChoice;

    fn start<P: Problem<System = S>>(
        &self,
        problem: &P,
        start: State<S>,
        end: S::Scalar,
        limit: u64,
        emit: &mut StepCallback<'_, S>,
    ) -> Result<Progress<S, OrderChoice>, IntegrationError> {
        let stopped = |state: &State<S>, kind| IntegrationError::at(problem, state, kind);
        check_tolerances(self.relative, self.absolute).map_err(|kind| stopped(&start, kind))?;
        let (span, state, rates) = prepare(problem, &start, end).map_err(|kind| stopped(&start, kind))?;
        let (pace, order) = (Pace::new(state.t.lane(0), limit), Order::first(self));
        let choice = OrderChoice { limit, pace, order, step: SeriesStep::new(span) };
        let mut run = Progress::new((state, rates), end, choice, emit);
        if !run.ended {
            run.memory.step.begin(self, limit).map_err(|kind| stopped(&state, kind))?;
        }
        Ok(run)
    }

    fn advance<P: Problem<System = S>>(
        &self,
        problem: &P,
        run: &mut Progress<S, OrderChoice>,
        emit: &mut StepCallback<'_, S>,
    ) -> Result<(), IntegrationError> {
        let stopped = |state: &State<S>, kind| IntegrationError::at(problem, state, kind);
        let mut series = S::Series::zero();
        let Progress { state, rates, end, ended, memory } = run;
        let (OrderChoice { limit, pace, order, step }, end) = (memory, *end);
        loop {
            let left = (end - state.t).lane(0).abs();
            let lanes = 0..S::Scalar::LANES;
            let place = StopPlace { state, rates, length: step.length(), left, stiff: false, lanes: lanes.clone() };
            let gave = |gave| stopped(state, cause(problem, &place, gave));
            if let Some(hopeless) = pace.spent(state.t.lane(0), left) {
                return Err(gave(StopReason::StepLimit { limit: *limit, hopeless }));
            }
            expanded(problem, state, order.value(), &mut series);
            let h = step.propose::<S, _>(self, (&series, order), (state.t, end - state.t), lanes.clone());
            let h = h.map_err(|kind| gave(StopReason::AnyStep(kind)))?;
            let mut reached = summed(problem, state.t, &series, order.value(), h);
            if step.is_last() {
                reached.t = end;
            }
            let next = match self.accepted(problem, (state, rates), &mut reached) {
                Ok(next) => next,
                Err(kind) => {
                    let again = step.shorten((problem, state), lanes, kind);
                    again.map_err(|kind| gave(StopReason::AnyStep(kind)))?;
                    continue;
                }
            };
            let (last, taken) = (step.is_last(), step.take());
            (*state, *rates, *ended) = (reached, next, last);
            order.choose(self, core::iter::once(&*step));
            if emit(state, rates, taken).is_break() || last {
                return Ok(());
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
        self.along(problem, state, rates)(h)
    }

    fn along<P: Problem<System = S>>(
        &self,
        problem: &P,
        state: &State<S>,
        rates: &Rates<S>,
    ) -> impl FnMut(S::Scalar) -> Result<State<S>, IntegrationErrorKind> {
        let mut series = S::Series::zero();
        let (state, rates, order) = (*state, *rates, self.order.unwrap_or(MAX_ORDER));
        expanded(problem, &state, order, &mut series);
        move |h| {
            let end = summed(problem, state.t, &series, order, h);
            if !(end.q.is_finite() && end.y.is_finite()) {
                return Err(IntegrationErrorKind::NonFinite { part: RunPart::Step });
            }
            if S::CONSTRAINED { onto_constraints(problem, (&state, &rates), &end) } else { Ok(end) }
        }
    }

    fn long_steps(&self) -> bool {
        true
    }
}
