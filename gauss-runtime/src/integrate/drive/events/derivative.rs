//! Derivatives of the time of an event.
//!
//! A run at dual numbers follows its values. They find the time of an event to rounding, without derivatives: there the
//! function w is zero but for its derivatives by whatever the numbers are differentiated by. Newton's step in the
//! numbers themselves, `δ = −w/ẇ`, has no value but derivatives, those of the time. The state is moved by δ along the
//! motion, to where w is zero with its derivatives (implicit function theorem). With nested dual numbers each step
//! adds orders.

use crate::configuration::{Configuration, VectorSpace};
use crate::integrate::drive::control::{Control, one_step};
use crate::integrate::drive::departure::{Parabola, rounding};
use crate::integrate::drive::search::{Function, StepSearch, values};
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::error::IntegrationErrorKind;
use crate::integrate::problem::state::{Rates, State, TangentOf};
use crate::integrate::runge_kutta::components::RungeKutta;
use crate::integrate::runge_kutta::tableau::Classical4;
use crate::real::{Real, largest_derivative};
use crate::system::GaussSystem;

/// The first part of a step over which the rate of a function is measured.
const SPAN: f64 = 1.0 / 4096.0;
/// Spans are lengthened until the function changes by so many roundings: its rate then has six digits, and each of
/// Newton's steps gains as many.
const RESOLVED: f64 = 1e6;
/// And no longer than the slower of configuration and speeds changes by this part of itself.
const LONGEST: f64 = 1e-3;
/// A function whose turning point is no further beyond zero than so many roundings touches zero: these are bounds, some
/// ten times what rounding is.
const TOUCHES: f64 = 4.0;
/// Roundings of each derivative that a function's own are made of: they are sums of some terms.
const ROUNDINGS: f64 = 16.0;
/// And what they add has fallen to this part of the sum: a cube, which passes at no rate, has nothing to settle.
const SETTLES: f64 = 1e-3;
/// Newton's steps.
const MOST_STEPS: u32 = 12;
/// Steps end where what they add is this part of the sum, and have failed where it is the other.
const ENDS: f64 = 1e-14;
const FAILS: f64 = 1e-9;

impl<S, P, C> StepSearch<'_, S, P, C>
where
    S: GaussSystem,
    P: Problem<System = S>,
    C: Control<S>,
{
    /// The state at the zero of the function of an event, moved along the motion to where its derivatives are zero.
    pub(in crate::integrate) fn differentiated(
        &self,
        (event, function): (usize, Function<'_, S>),
        state: &State<S>,
    ) -> Result<State<S>, IntegrationErrorKind> {
        let refused = |rate: f64| Err(IntegrationErrorKind::NoDerivative { event, rate });
        if S::Scalar::LANES > 1 {
            return refused(f64::NAN);
        }
        let left = |state: &State<S>| {
            let w = values(self.problem, function, state);
            w - S::Scalar::from_f64(w.lane(0))
        };
        let rates = self.problem.rates(state);
        let slope = match self.slope(function, (state, &rates)) {
            Ok(slope) => slope,
            Err(rate) => return refused(rate),
        };
        let rounding = self.rounding_of_derivatives(function, state);
        let (mut state, mut rates, mut sum, mut before) = (*state, rates, S::Scalar::zero(), f64::INFINITY);
        for _ in 0..MOST_STEPS {
            let by = -left(&state) / slope;
            if !by.is_finite() {
                break;
            }
            sum += by;
            let (last, all) = (largest_derivative(by), largest_derivative(sum));
            // Beyond that there is rounding alone: of the time, or of what the function is the difference of.
            if (last <= SETTLES * all && last * slope.lane(0).abs() <= rounding)
                || last <= ENDS * all
                || last <= FAILS * all && last >= 0.5 * before
            {
                return Ok(state);
            }
            state = one_step(&RungeKutta(Classical4), self.problem, &state, &rates, by)?;
            rates = self.problem.rates(&state);
            before = last;
        }
        refused(slope.lane(0))
    }

    /// The rounding of the derivatives of a function: those of time, configuration and speeds are rounded, each times
    /// what the function changes by with it.
    fn rounding_of_derivatives(&self, function: Function<'_, S>, state: &State<S>) -> f64 {
        let at = |state: &State<S>| values(self.problem, function, state).lane(0);
        let (here, part) = (at(state), Real::sqrt(S::Scalar::EPSILON));
        let components = state.q.components();
        let largest = |count: usize, of: &dyn Fn(usize) -> S::Scalar| {
            (0..count).map(|i| largest_derivative(of(i))).fold(0.0, f64::max)
        };
        let of_q = largest(<S::Configuration as Configuration>::Components::DIM, &|i| components.component(i));
        let of_y = largest(S::Speeds::DIM, &|i| state.y.component(i));
        // By half of the digits of what it is made of, so that it changes by more than its own rounding.
        let size = |of: f64| part * (1.0 + of);
        let mut sum = 0.0;
        let mut add = |there: &State<S>, by: f64, derivative: f64| {
            let change = (at(there) - here).abs() * derivative / by;
            sum += if change.is_finite() { change } else { 0.0 };
        };
        let by = size(state.t.lane(0).abs());
        add(&State { t: state.t + S::Scalar::from_f64(by), ..*state }, by, largest_derivative(state.t));
        for i in 0..TangentOf::<S>::DIM {
            let by = size(state.q.magnitude(i));
            let mut sigma = TangentOf::<S>::zero();
            sigma.set_component(i, S::Scalar::from_f64(by));
            add(&State { q: state.q.retract(&sigma), ..*state }, by, of_q);
        }
        for i in 0..S::Speeds::DIM {
            let by = size(state.y.component(i).lane(0).abs());
            let mut y = state.y;
            y.set_component(i, y.component(i) + S::Scalar::from_f64(by));
            add(&State { y, ..*state }, by, of_y);
        }
        ROUNDINGS * S::Scalar::EPSILON.max(f64::EPSILON) * sum
    }

    /// The rate of a function along the motion where it passes through zero; its value alone where it does not pass at
    /// a rate.
    fn slope(&self, function: Function<'_, S>, (state, rates): (&State<S>, &Rates<S>)) -> Result<S::Scalar, f64> {
        let noise = rounding(self.problem, function, 0, state);
        let at = values(self.problem, function, state);
        let longest = LONGEST * slow(state, rates);
        let mut span = SPAN * self.duration();
        loop {
            let parabola = Parabola::of(self.problem, state, rates, S::Scalar::from_f64(span));
            let [near, far] = [1.0, 2.0].map(|part| values(self.problem, function, &parabola.at(part)) - at);
            let number = S::Scalar::from_f64;
            let slope = (number(4.0) * near - far) / number(2.0 * span);
            let (rate, curvature) = (slope.lane(0), ((far - near - near) / number(span * span)).lane(0));
            let resolved = near.lane(0).abs() > RESOLVED * noise;
            if !resolved && span < longest {
                span *= 4.0;
                continue;
            }
            let passes = rate.abs() * span > TOUCHES * noise && rate * rate > 2.0 * curvature.abs() * TOUCHES * noise;
            // Found to a part of the step, it is no further from zero than that makes; else it jumps over it.
            let beyond = noise + 8.0 * self.resolution * self.duration() * rate.abs();
            return if passes && at.lane(0).abs() <= beyond { Ok(slope) } else { Err(rate) };
        }
    }
}

/// Time in which configuration or speeds change by their size.
fn slow<S: GaussSystem>(state: &State<S>, rates: &Rates<S>) -> f64 {
    let place = (0..TangentOf::<S>::DIM).map(|i| state.q.magnitude(i)).fold(0.0, f64::max);
    let times = [place / rates.configuration.max_norm(), state.y.max_norm() / rates.variables.max_norm()];
    times.into_iter().filter(|time| time.is_finite()).fold(0.0, f64::max)
}
