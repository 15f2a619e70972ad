//! From one instant of sampling to the next.

use core::cell::Cell;

use crate::integrate::drive::event::Events;
use crate::integrate::drive::schedule::Scheduled;
use crate::integrate::problem::error::{IntegrationErrorKind, SamplingMistake};
use crate::integrate::problem::state::Sample;
use crate::real::Real;
use crate::system::GaussSystem;

/// Does something with every controller that samples, by its number, until it fails.
fn each<S: GaussSystem, E: Events<S>>(
    events: &mut E,
    mut visit: impl FnMut(&mut dyn Scheduled<S>) -> Result<(), SamplingMistake>,
) -> Result<(), IntegrationErrorKind> {
    let (mut controller, mut outcome) = (0, Ok(()));
    events.schedule(&mut |scheduled| {
        if outcome.is_ok() {
            outcome = visit(scheduled).map_err(|mistake| IntegrationErrorKind::Sampling { controller, mistake });
        }
        controller += 1;
    });
    outcome
}

/// Checks of a run with controllers before the first sample. `holds`: whether its input has a place for what they give.
///
/// # Errors
/// An interval that is none, or goes backward; an input in the place of the controllers'; periods and delays that are
/// none, or too short for the times of the interval or the most steps.
#[cold]
pub fn begin<S: GaussSystem, E: Events<S>>(
    events: &mut E,
    holds: bool,
    (start, end): (S::Scalar, S::Scalar),
    limit: u64,
) -> Result<(), IntegrationErrorKind> {
    let (from, to) = (start.lane(0), end.lane(0));
    if !(start.is_finite() && end.is_finite()) {
        return Err(IntegrationErrorKind::InvalidInterval);
    }
    let mut period = f64::INFINITY;
    each(events, |controller| {
        if to < from {
            return Err(SamplingMistake::Backward);
        }
        if !holds {
            return Err(SamplingMistake::Replaced);
        }
        controller.begin(start)?;
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
    Ok(())
}

/// Lets controllers sample the state where the run is, and their input act; gives what they hold from there on, and
/// until when.
///
/// # Errors
/// An input that is not finite.
#[cold]
pub fn tick<S: GaussSystem, E: Events<S>>(
    events: &mut E,
    now: &Sample<S>,
    cell: Option<&Cell<S::Input>>,
    end: S::Scalar,
) -> Result<(Option<S::Input>, S::Scalar), IntegrationErrorKind> {
    let (mut held, mut next) = (None, end);
    each(events, |controller| {
        controller.tick(now)?;
        held = Some(controller.added_to(held));
        let instant = controller.next();
        // What is left behind an instant that is the end but for a few roundings is none.
        let rounding = 8.0 * S::Scalar::EPSILON * end.lane(0).abs().max(now.t.lane(0).abs());
        if instant.lane(0) < next.lane(0) && instant.lane(0) < end.lane(0) - rounding {
            next = instant;
        }
        Ok(())
    })?;
    if let (Some(cell), Some(input)) = (cell, held) {
        cell.set(input);
    }
    Ok((held, next))
}
