//! The curve between the ends of a step.

use crate::configuration::{Configuration, VectorSpace};
use crate::integrate::problem::state::{Rates, State};
use crate::real::Real;
use crate::system::GaussSystem;

/// A step with the derivatives at its ends, of which one lane is looked at.
pub struct StepEnds<'a, S: GaussSystem> {
    /// The lane.
    pub lane: usize,
    /// The start of the step, and the derivatives there.
    pub before: (&'a State<S>, &'a Rates<S>),
    /// Its end, and the derivatives there.
    pub after: (&'a State<S>, &'a Rates<S>),
}

/// The cubic through the states at the ends of a step with the derivatives there: in the algebra at the start, where q
/// is `q₀ ∘ exp(σ)` and `σ̇ = dexp_inv(σ, V)`.
pub(in crate::integrate) struct StepCubic<'a, S: GaussSystem> {
    made: &'a StepEnds<'a, S>,
    h: S::Scalar,
    change: Rates<S>,
    end: Rates<S>,
}

impl<'a, S: GaussSystem> StepCubic<'a, S> {
    pub(in crate::integrate) fn of(made: &'a StepEnds<'a, S>) -> Self {
        let ((from, _), (to, rates)) = (made.before, made.after);
        let configuration = from.q.difference(&to.q);
        let end = S::Configuration::dexp_inv(&configuration, &rates.configuration);
        Self {
            made,
            h: to.t - from.t,
            change: Rates { configuration, variables: to.y.add_scaled(-S::Scalar::one(), &from.y) },
            end: Rates { configuration: end, variables: rates.variables },
        }
    }

    pub(in crate::integrate) fn at(&self, part: f64) -> State<S> {
        let (from, rates) = self.made.before;
        let rest = 1.0 - part;
        let number = S::Scalar::from_f64;
        let value = number(part * part * (1.0 + 2.0 * rest));
        let (left, right) = (number(part * rest * rest) * self.h, number(-part * part * rest) * self.h);
        let sigma = self.change.configuration.scale(value);
        let sigma = sigma.add_scaled(left, &rates.configuration).add_scaled(right, &self.end.configuration);
        let y = from.y.add_scaled(value, &self.change.variables);
        let y = y.add_scaled(left, &rates.variables).add_scaled(right, &self.end.variables);
        State { t: number(part).fma(self.h, from.t), q: from.q.retract(&sigma), y }
    }

    /// ẏ on the curve, a component.
    pub(in crate::integrate) fn slope(&self, part: f64, component: usize) -> f64 {
        let lane = self.made.lane;
        let h = self.h.lane(lane);
        let of = |variables: &S::Speeds| variables.component(component).lane(lane);
        let (left, right) = (of(&self.made.before.1.variables), of(&self.end.variables));
        let mean = of(&self.change.variables) / h;
        let rest = 1.0 - part;
        6.0 * part * rest * mean + rest * (1.0 - 3.0 * part) * left + part * (1.0 - 3.0 * rest) * right
    }
}
