//! Steps of one length whose rounding errors are carried instead of dropped: for 10⁵ steps and more.
//!
//! A state is replaced by state + increment at every step, and rounded. The increments are of size h, so their own
//! errors are of size h ε; the sum is rounded by ε. Here what is rounded off the sum is kept and added to the next
//! increment, in y and in the configuration ([`Configuration::retract_carrying`]): after n steps the error of rounding
//! is about √n h ε instead of √n ε.
//!
//! That it grows like √n asks that no step makes the same error again. Explicit methods sum their stages relative to
//! the first one, so that weights that do not add up to 1 by a rounding do no harm, and have their coefficients in two
//! parts ([`IncrementStep`]); attitudes are held at norm 1 within the same sum. The example `long_runs` measures it.

use crate::configuration::{Configuration, VectorSpace, add_carrying};
use crate::integrate::drive::control::{Control, Progress, StepCallback, one_step};
use crate::integrate::drive::fixed::EqualSteps;
use crate::integrate::lie_group::rkmk::Rkmk;
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::error::{IntegrationError, IntegrationErrorKind, RunPart};
use crate::integrate::problem::state::{Rates, State, TangentOf};
use crate::integrate::runge_kutta::tableau::Tableau;
use crate::integrate::step::checks::check_chart;
use crate::integrate::step::one_step::IncrementStep;
use crate::real::Real;
use crate::system::GaussSystem;

/// Steps of one length by a method that gives its increments, the last one ending where it should.
///
/// With constraints nothing is gained: the projection after each step rounds the state.
#[derive(Clone, Copy, Debug)]
pub struct Compensated<T, M = Rkmk<T, 4>> {
    method: M,
    step: T,
}

impl<T: Real, const S: usize> Compensated<T, Rkmk<T, S>> {
    /// The Runge–Kutta–Munthe-Kaas method of any tableau.
    #[must_use]
    pub fn with(tableau: &Tableau<S>, step: T) -> Self {
        Self::by(Rkmk::new(tableau), step)
    }
}

impl<T: Real, M> Compensated<T, M> {
    /// Any method that is an [`IncrementStep`]; steps of length |step|, in the direction of the interval.
    #[must_use]
    pub fn by(method: M, step: T) -> Self {
        Self { method, step }
    }
}

impl<S: GaussSystem, M: IncrementStep<S>> Control<S> for Compensated<S::Scalar, M> {
    /// The steps, and what was rounded off the state so far.
    type StepMemory = (EqualSteps<S::Scalar>, Rates<S>);

    fn start<P: Problem<System = S>>(
        &self,
        problem: &P,
        start: State<S>,
        end: S::Scalar,
        limit: u64,
        emit: &mut StepCallback<'_, S>,
    ) -> Result<Progress<S, Self::StepMemory>, IntegrationError> {
        let carried = Rates { configuration: TangentOf::<S>::zero(), variables: S::Speeds::zero() };
        let how = (self.step, self.method.properties().stiff);
        EqualSteps::start((how, carried), problem, &start, end, limit, emit)
    }

    fn advance<P: Problem<System = S>>(
        &self,
        problem: &P,
        run: &mut Progress<S, Self::StepMemory>,
        emit: &mut StepCallback<'_, S>,
    ) -> Result<(), IntegrationError> {
        let flow = run.until(run.memory.0.steps(), problem, emit, |carried, state, rates, h| {
            let increment = self.method.increment(problem, state, rates, h)?;
            let q = state.q.retract_carrying(&increment.configuration, &mut carried.configuration);
            let (y, rest) = add_carrying(&state.y, &increment.variables, &carried.variables);
            carried.variables = rest;
            let end = State { t: state.t + h, q, y };
            check_chart(problem.system(), state, &end)?;
            if !(end.q.is_finite() && end.y.is_finite()) {
                return Err(IntegrationErrorKind::NonFinite { part: RunPart::Step });
            }
            Ok((end, None))
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

#[cfg(all(test, feature = "alloc"))]
#[path = "compensated_tests.rs"]
mod tests;
