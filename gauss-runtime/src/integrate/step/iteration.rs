//! When an iteration of an implicit step has come to its end.

use crate::integrate::problem::error::{IntegrationErrorKind, RunPart};
use crate::real::Real;

/// Sweeps after which an iteration is given up: 53 gain a binary digit each, and where a sweep gains less a shorter
/// step is cheaper.
const MOST_SWEEPS: u32 = 64;

/// Sweeps without progress after which only rounding is left: any iteration that would converge in time gains a digit
/// in as many.
const IDLE_SWEEPS: u32 = 4;

/// A sweep that still changes so much of the state is not near a solution.
const FAR: f64 = 0.1;

/// Follows how much the sweeps of an iteration change, relative to the size of the state.
pub(in crate::integrate) struct Convergence {
    sweeps: u32,
    least: f64,
    last: f64,
    idle: u32,
}

impl Convergence {
    pub(in crate::integrate) fn new() -> Self {
        Self { sweeps: 0, least: f64::INFINITY, last: 0.0, idle: 0 }
    }

    /// Takes the change of one more sweep; whether it was the last one.
    ///
    /// What is infinite or undefined at once, or where sweeps changed little, is [`IntegrationErrorKind::NonFinite`];
    /// where they changed much, [`IntegrationErrorKind::NotConverged`].
    ///
    /// To rounding, and until that gets no better: an iteration that stops earlier leaves an error of one sign.
    pub(in crate::integrate) fn finished<T: Real>(&mut self, residual: f64) -> Result<bool, IntegrationErrorKind> {
        self.sweeps += 1;
        if !residual.is_finite() {
            // What the iteration itself has driven out of range is no fault of the equations: it ran away.
            return Err(if self.last > FAR {
                IntegrationErrorKind::NotConverged { iterations: self.sweeps, residual: self.last }
            } else {
                IntegrationErrorKind::NonFinite { part: RunPart::Step }
            });
        }
        self.last = residual;
        self.idle = if residual < self.least { 0 } else { self.idle + 1 };
        self.least = self.least.min(residual);
        let rounding = residual <= 64.0 * T::EPSILON && self.idle > 0;
        // Equations that cancel have more rounding than the state, which then is all that is left to change.
        let noise = self.least <= Real::sqrt(T::EPSILON) && self.idle >= IDLE_SWEEPS;
        if residual == 0.0 || rounding || noise {
            return Ok(true);
        }
        if self.sweeps == MOST_SWEEPS {
            return Err(IntegrationErrorKind::NotConverged { iterations: self.sweeps, residual });
        }
        Ok(false)
    }
}

/// The larger one; NaN where one of them is.
pub(in crate::integrate) fn worst(a: f64, b: f64) -> f64 {
    if a > b || a.is_nan() { a } else { b }
}

/// The largest change between two numbers over their lanes, relative to a size. It is 0 where both numbers are equal,
/// also where the size is 0.
pub(in crate::integrate) fn relative_change<T: Real>(old: T, new: T, size: f64) -> f64 {
    (0..T::LANES).fold(0.0, |result, lane| {
        let difference = (new.lane(lane) - old.lane(lane)).abs();
        worst(result, if difference == 0.0 { 0.0 } else { difference / size })
    })
}
