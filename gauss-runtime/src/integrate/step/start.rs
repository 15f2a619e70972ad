//! The equations in the chart about the start of a step, with their derivatives: what implicit methods solve.
//!
//! In the chart `q = q₀ ∘ exp(σ)` about the start of the step the equations are `σ̇ = dexp_inv(σ, V)` and ż = f on a
//! linear space, in which a method keeps its order. Their Jacobian at σ = 0 is that of (V, ż) and the first term of
//! dexp⁻¹: ½ [·, V].

use crate::configuration::{Configuration, VectorSpace};
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::error::{IntegrationErrorKind, RunPart};
use crate::integrate::problem::state::{Rates, State, TangentOf};
use crate::integrate::step::checks::{check_chart, check_increment};
use crate::integrate::step::one_step::Step;
use crate::linearize::{LinearModel, LinearizedSystem, brackets};
use crate::real::Real;
use crate::system::GaussSystem;

pub(in crate::integrate) type Model<S> = <S as LinearizedSystem>::Linearization;

/// (σ, δz), and their rates.
pub(in crate::integrate) type Vector<S> = <Model<S> as LinearModel<<S as GaussSystem>::Scalar>>::Vector;

/// The length of a step by which is divided: lanes without a run make steps of no length, for which one stands that
/// moves nothing.
pub(in crate::integrate) fn positive_length<T: Real>(h: T) -> T {
    let least = T::from_f64(1e-30);
    T::select_lt(h.abs(), least, least, h)
}

/// State at which a step starts, in z.
pub(in crate::integrate) struct Start<S: GaussSystem> {
    pub t: S::Scalar,
    pub q: S::Configuration,
    pub z: S::Speeds,
}

impl<S: LinearizedSystem> Start<S> {
    pub fn of<P: Problem<System = S>>(problem: &P, state: &State<S>) -> Self {
        Self { t: state.t, q: state.q, z: problem.speeds(state.t, &state.q, &state.y) }
    }

    /// (V, ż) with their derivatives in the chart, and the input.
    pub fn linearize<P: Problem<System = S>>(&self, problem: &P, rates: &Rates<S>) -> (Model<S>, S::Input) {
        let input = problem.input(self.t, &self.q, &self.z);
        let linear = problem.system().linearize(self.t, &self.q, &self.z, &input);
        let mut bracket = brackets::<S>(&linear, rates.configuration);
        let mut feedback = feedback(problem, self, &linear);
        let slopes = linear.with_state_slopes(|row, column| {
            linear.by_state(row, column) + bracket(row, column) + feedback(row, column)
        });
        (slopes, input)
    }

    /// The step by an increment (σ, δz), of which the estimated error is another one.
    pub fn step<P: Problem<System = S>>(
        &self,
        problem: &P,
        state: &State<S>,
        h: S::Scalar,
        (increment, error): (&Vector<S>, &Vector<S>),
    ) -> Result<Step<S>, IntegrationErrorKind> {
        let (q, z) = self.moved(increment)?;
        let (configuration, error) = self.split(error);
        let t = state.t + h;
        let q = q.renormalise();
        let y = problem.variables(t, &q, &z);
        let embedded = problem.variables(t, &q, &z.add_scaled(-S::Scalar::one(), &error));
        let error = Rates { configuration, variables: y.add_scaled(-S::Scalar::one(), &embedded) };
        let end = State { t, q, y };
        check_chart(problem.system(), state, &end)?;
        if !(end.q.is_finite() && end.y.is_finite() && error.is_finite()) {
            return Err(IntegrationErrorKind::NonFinite { part: RunPart::Step });
        }
        Ok(Step { state: end, error, rates: None })
    }

    /// (σ, δz).
    pub fn split(&self, increment: &Vector<S>) -> (TangentOf<S>, S::Speeds) {
        let (mut sigma, mut speeds) = (TangentOf::<S>::zero(), S::Speeds::zero());
        for i in 0..TangentOf::<S>::DIM {
            sigma.set_component(i, increment.component(i));
        }
        for i in 0..S::Speeds::DIM {
            speeds.set_component(i, increment.component(TangentOf::<S>::DIM + i));
        }
        (sigma, speeds)
    }

    /// (q ∘ exp σ, z + δz).
    pub fn moved(&self, increment: &Vector<S>) -> Result<(S::Configuration, S::Speeds), IntegrationErrorKind> {
        let (configuration, variables) = self.split(increment);
        check_increment::<S>(&Rates { configuration, variables })?;
        Ok((self.q.retract(&configuration), self.z.add_scaled(S::Scalar::one(), &variables)))
    }

    /// (dexp_inv(σ, V), ż) at a state that an increment leads to.
    pub fn rates<P: Problem<System = S>>(
        &self,
        problem: &P,
        increment: &Vector<S>,
        (q, z): &(S::Configuration, S::Speeds),
        t: S::Scalar,
    ) -> Vector<S> {
        let input = problem.input(t, q, z);
        let velocity = problem.system().configuration_rates(t, q, z, &input);
        let velocity = S::Configuration::dexp_inv(&self.split(increment).0, &velocity);
        let acceleration = problem.system().acceleration(t, q, z, &input);
        let mut rates = Vector::<S>::zero();
        for i in 0..TangentOf::<S>::DIM {
            rates.set_component(i, velocity.component(i));
        }
        for i in 0..S::Speeds::DIM {
            rates.set_component(TangentOf::<S>::DIM + i, acceleration.component(i));
        }
        rates
    }

    /// ∂(V, ż)/∂t, that through the input included. The derivative of the input is that of the polynomial through five
    /// points of the step, so that no input is evaluated at times outside the run.
    pub fn by_time<P: Problem<System = S>>(
        &self,
        problem: &P,
        linear: &Model<S>,
        now: &S::Input,
        h: S::Scalar,
    ) -> Vector<S> {
        let mut slope = *linear.by_time();
        if S::Input::DIM == 0 {
            return slope;
        }
        let mut rate = now.scale(S::Scalar::ratio(-25, 3) / h);
        for (k, thirds) in [(1, 48), (2, -36), (3, 16), (4, -3)] {
            let later = problem.input(S::Scalar::ratio(k, 4).fma(h, self.t), &self.q, &self.z);
            rate = rate.add_scaled(S::Scalar::ratio(thirds, 3) / h, &later);
        }
        for row in 0..Vector::<S>::DIM {
            slope.set_component(row, through_input::<S>(linear, row, &rate, slope.component(row)));
        }
        slope
    }
}

/// `∂(V, ż)/∂input · rate + onto`, one row.
fn through_input<S: LinearizedSystem>(linear: &Model<S>, row: usize, rate: &S::Input, onto: S::Scalar) -> S::Scalar {
    (0..S::Input::DIM).fold(onto, |sum, k| linear.by_input(row, k).fma(rate.component(k), sum))
}

/// The contribution of an input that depends on the state to ∂(V, ż)/∂(σ, z), entry by entry, column after column: by
/// central differences over a distance of ε^⅓, where truncation and rounding errors are about equal.
fn feedback<S: LinearizedSystem, P: Problem<System = S>>(
    problem: &P,
    start: &Start<S>,
    linear: &Model<S>,
) -> impl FnMut(usize, usize) -> S::Scalar {
    let input = |column: usize, distance: f64| {
        let mut axis = Vector::<S>::zero();
        axis.set_component(column, S::Scalar::from_f64(distance));
        let (sigma, speeds) = start.split(&axis);
        let z = start.z.add_scaled(S::Scalar::one(), &speeds);
        problem.input(start.t, &start.q.retract(&sigma), &z)
    };
    let slope = move |column: usize| {
        let size = match column.checked_sub(TangentOf::<S>::DIM) {
            None => start.q.magnitude(column),
            Some(k) => (0..S::Scalar::LANES).map(|lane| start.z.component(k).lane(lane).abs()).fold(0.0, f64::max),
        };
        let distance = Real::exp(Real::ln(S::Scalar::EPSILON) * (1.0 / 3.0)) * size.max(1.0);
        let difference = input(column, distance).add_scaled(-S::Scalar::one(), &input(column, -distance));
        difference.scale(S::Scalar::from_f64(0.5 / distance))
    };
    let mut known = (usize::MAX, S::Input::zero());
    move |row, column| {
        if S::Input::DIM == 0 {
            return S::Scalar::zero();
        }
        if known.0 != column {
            known = (column, slope(column));
        }
        through_input::<S>(linear, row, &known.1, S::Scalar::zero())
    }
}
