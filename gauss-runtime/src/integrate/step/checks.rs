//! Checks of a step: it may not pass over a singularity of the coordinates, nor turn so far that the increment is
//! ambiguous.

use crate::configuration::{Configuration, VectorSpace};
use crate::integrate::problem::error::IntegrationErrorKind;
use crate::integrate::problem::state::{Rates, State, TangentOf};
use crate::real::Real;
use crate::system::GaussSystem;

/// Coordinates that become infinite and lose no digits are not followed by a step in which they grow or shrink by more
/// than this.
const GROWTH: f64 = 32.0;

/// Refuses steps that touch a singularity of the coordinates or pass over one: they would go on with numbers that mean
/// nothing. At a regularity of √ε velocities have lost half of their digits, where they lose any.
#[inline(always)]
pub(in crate::integrate) fn check_chart<S: GaussSystem>(
    system: &S,
    start: &State<S>,
    end: &State<S>,
) -> Result<(), IntegrationErrorKind> {
    let before = system.regularity(start.t, &start.q);
    let after = system.regularity(end.t, &end.q);
    for lane in 0..S::Scalar::LANES {
        let (before, after) = (before.lane(lane), after.lane(lane));
        let (least, most) = (before.abs().min(after.abs()), before.abs().max(after.abs()));
        let near =
            if S::CHART.loses_digits() { least <= Real::sqrt(S::Scalar::EPSILON) } else { GROWTH * least < most };
        // A NaN passes here and is caught at the end of the step.
        if near || (before < 0.0) != (after < 0.0) {
            // What lies between the two sides is the singularity itself.
            let regularity = if (before < 0.0) == (after < 0.0) { least } else { 0.0 };
            return Err(IntegrationErrorKind::SingularChart { regularity });
        }
    }
    Ok(())
}

/// Whether all components are finite and their squares are as well: those of speeds are in every equation of motion,
/// and where they overflow nothing that follows means anything, finite or not.
#[inline(always)]
pub(in crate::integrate) fn is_in_range<T: Real, V: VectorSpace<T>>(variables: &V) -> bool {
    (0..V::DIM).all(|i| (variables.component(i) * variables.component(i)).is_finite())
}

/// Refuses rotations beyond half a turn. A NaN passes here and is caught at the end of the step.
#[inline(always)]
pub(in crate::integrate) fn check_increment<S: GaussSystem>(increment: &Rates<S>) -> Result<(), IntegrationErrorKind> {
    check_turn::<S>(&increment.configuration)
}

/// [`check_increment`] of the increment of a configuration: one test for all lanes, nearly always.
#[inline(always)]
pub(in crate::integrate) fn check_turn<S: GaussSystem>(increment: &TangentOf<S>) -> Result<(), IntegrationErrorKind> {
    let half = S::Scalar::from_f64(core::f64::consts::PI);
    if S::Scalar::all_lt(S::Configuration::increment_angles(increment), half) {
        return Ok(());
    }
    let angle = S::Configuration::increment_angle(increment);
    if angle > core::f64::consts::PI && angle.is_finite() {
        Err(IntegrationErrorKind::IncrementTooLarge { angle })
    } else {
        Ok(())
    }
}
