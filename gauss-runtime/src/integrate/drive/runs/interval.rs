//! From one instant of sampling to the next.

use crate::integrate::drive::control::Control;
use crate::integrate::drive::event::{Events, Watch};
use crate::integrate::drive::projection::consistent_start;
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::error::{IntegrationErrorKind, SamplingMistake};
use crate::integrate::problem::state::State;
use crate::real::Real;
use crate::system::GaussSystem;

/// The start of a run with controllers, on its constraints; all checks before the first sample.
#[cold]
pub(in crate::integrate) fn begin<S: GaussSystem, P: Problem<System = S>, C: Control<S>, E: Events<S>>(
    problem: &P,
    watch: &mut Watch<'_, P, C, E>,
    (start, end): (State<S>, S::Scalar),
    limit: u64,
) -> Result<State<S>, IntegrationErrorKind> {
    let (from, to) = (start.t.lane(0), end.lane(0));
    if !(start.t.is_finite() && end.is_finite()) {
        return Err(IntegrationErrorKind::InvalidInterval);
    }
    let mut period = f64::INFINITY;
    watch.schedule(|controller| {
        if to < from {
            return Err(SamplingMistake::Backward);
        }
        if problem.held().is_none() {
            return Err(SamplingMistake::Replaced);
        }
        controller.begin(start.t)?;
        period = period.min(controller.period());
        Ok(())
    })?;
    let time = from.abs().max(to.abs());
    if period < 64.0 * S::Scalar::EPSILON * time {
        return Err(IntegrationErrorKind::TimeTooCoarse { step: period, time });
    }
    if (to - from) / period > limit as f64 {
        return Err(IntegrationErrorKind::TooManySteps { limit });
    }
    consistent_start(problem, &start)
}

/// Lets controllers sample the state where the run is; gives what they hold from there on, and until when.
#[cold]
pub(in crate::integrate) fn tick<S: GaussSystem, P: Problem<System = S>, C: Control<S>, E: Events<S>>(
    problem: &P,
    watch: &mut Watch<'_, P, C, E>,
    state: &State<S>,
    end: S::Scalar,
) -> Result<(Option<S::Input>, S::Scalar), IntegrationErrorKind> {
    let now = problem.sample(state);
    let (mut held, mut next) = (None, end);
    watch.schedule(|controller| {
        controller.tick(&now)?;
        held = Some(controller.added_to(held));
        let instant = controller.next();
        // What is left behind an instant that is the end but for a few roundings is none.
        let rounding = 8.0 * S::Scalar::EPSILON * end.lane(0).abs().max(now.t.lane(0).abs());
        if instant.lane(0) < next.lane(0) && instant.lane(0) < end.lane(0) - rounding {
            next = instant;
        }
        Ok(())
    })?;
    if let (Some(cell), Some(input)) = (problem.held(), held) {
        cell.set(input);
    }
    Ok((held, next))
}
