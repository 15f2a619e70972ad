//! States of a run kept on the constraints. Without constraints nothing here does anything, at compile time.
//!
//! A step ends off the constraints by its local error; the nearest state on them is no farther from the solution than twice
//! that. So projecting after every accepted step keeps the order of the method and nothing accumulates (Hairer, Lubich &
//! Wanner, *Geometric Numerical Integration*, IV.4). Error estimates are those of the step before it is projected.

use crate::configuration::{Configuration, VectorSpace};
use crate::constraint::ConstraintLevel;
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::error::{IntegrationErrorKind, Part};
use crate::integrate::problem::state::{Rates, State};
use crate::integrate::step::checks::is_in_range;
use crate::real::Real;
use crate::system::GaussSystem;

/// Brings the end of an accepted step onto the constraints, where there are any, and gives the derivatives there; refuses speeds
/// whose squares overflow. Derivatives that
/// came with the step belong to its end before it was projected, and serve without constraints only.
#[inline(always)]
pub(crate) fn accept<S: GaussSystem, P: Problem<System = S>>(
    problem: &P,
    state: &mut State<S>,
    known: Option<Rates<S>>,
) -> Result<Rates<S>, IntegrationErrorKind> {
    if !is_in_range(&state.y) {
        return Err(IntegrationErrorKind::NonFinite { part: Part::Step });
    }
    if S::CONSTRAINED {
        *state = on_constraints(problem, state)?;
    } else if let Some(rates) = known {
        return Ok(rates);
    }
    let rates = problem.rates(state);
    if rates.is_finite() { Ok(rates) } else { Err(IntegrationErrorKind::NonFinite { part: Part::Step }) }
}

/// The state of a constrained system brought onto its constraints.
pub(in crate::integrate) fn on_constraints<S: GaussSystem, P: Problem<System = S>>(
    problem: &P,
    state: &State<S>,
) -> Result<State<S>, IntegrationErrorKind> {
    let (system, State { t, q, y }) = (problem.system(), *state);
    let z = problem.speeds(t, &q, &y);
    let (q, z) = system.project(t, &q, &z).map_err(|error| IntegrationErrorKind::Projection { error })?;
    Ok(State { t, q, y: problem.variables(t, &q, &z) })
}

/// The initial state, rid of the rounding of what was typed; an error when it is not on the constraints otherwise.
///
/// The bound is √ε of the largest component of the configuration, of z respectively: a state that agrees with the
/// constraints in half of the digits was meant to satisfy them, and with less than half it is another state, which nobody
/// asked to run from. Beside it 64 ε are allowed for numbers of order 1 that cancel where the state itself is zero.
#[inline(always)]
pub(in crate::integrate) fn consistent_start<S: GaussSystem, P: Problem<System = S>>(
    problem: &P,
    start: &State<S>,
) -> Result<State<S>, IntegrationErrorKind> {
    if !S::CONSTRAINED {
        return Ok(*start);
    }
    let projected = on_constraints(problem, start)?;
    let speeds = |state: &State<S>| problem.speeds(state.t, &state.q, &state.y);
    let (given, nearest) = (speeds(start), speeds(&projected));
    let increment = start.q.difference(&projected.q);
    let components = <<S::Configuration as Configuration>::Tangent as VectorSpace<S::Scalar>>::DIM;
    let size = (0..components).map(|i| start.q.magnitude(i)).fold(0.0, f64::max);
    for (level, distance, size) in [
        (ConstraintLevel::Position, increment.max_norm(), size),
        (ConstraintLevel::Velocity, nearest.add_scaled(-S::Scalar::one(), &given).max_norm(), given.max_norm()),
    ] {
        let allowed = Real::sqrt(S::Scalar::EPSILON) * size + 64.0 * S::Scalar::EPSILON;
        if distance > allowed {
            return Err(IntegrationErrorKind::InconsistentStart { level, distance });
        }
    }
    Ok(projected)
}

#[cfg(all(test, feature = "alloc"))]
#[path = "projection_tests.rs"]
mod tests;
