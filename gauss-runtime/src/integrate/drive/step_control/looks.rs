//! Looks at what acts between the stages of a step.
//!
//! Where the error that a step estimates is far below the tolerance, nothing limits the length of the next one but what
//! its stages see: at rest, or in free flight, steps grow tenfold, and lead over a push that comes and goes between
//! stages. There the run looks at the accelerations, on the curve of the step, at points that are no further apart than
//! a part of the run. A step on which they leave what its ends and its curve show ends at the first point that does; a
//! sixteenth of the distance is looked at from there on, so that stages come to lie in the push.

use crate::integrate::drive::cubic::{StepCubic, StepEnds};
use crate::integrate::drive::tolerance::{Tolerance, Trial};
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::error::IntegrationErrorKind;
use crate::real::Real;
use crate::system::GaussSystem;
use crate::vector_space::VectorSpace;

/// Looks in a run, where nobody says how fast inputs change.
const LOOKS: f64 = 256.0;

/// An error, in tolerances, that limits no step is less: such steps are looked at, and those that follow them.
const UNLIMITED: f64 = 1e-4;

/// Shorter steps, in distances of looks, have stages enough.
const SHORT: f64 = 4.0;

/// Factor by which looks are nearer after something was seen.
const FINER: f64 = 16.0;

/// Accelerations may leave the range that the ends and the curve of a step show by this part of it.
const LEAVES: f64 = 0.5;

/// When a run looks.
#[derive(Clone, Copy, Debug)]
pub struct Looks {
    distance: f64,
    /// Whether the distance is that of the user.
    given: bool,
    /// Interval in which looks are nearer, in time since the start of the run.
    fine: [f64; 2],
    start: f64,
    /// Whether the length of the step was chosen after one that limits none.
    free: bool,
}

impl Looks {
    /// Refuses a distance that is none.
    ///
    /// # Errors
    /// [`IntegrationErrorKind::InvalidStep`].
    pub fn check(given: Option<f64>) -> Result<(), IntegrationErrorKind> {
        match given.filter(|time| !(time.is_finite() && *time > 0.0)) {
            Some(step) => Err(IntegrationErrorKind::InvalidStep { step }),
            None => Ok(()),
        }
    }

    /// The looks of a run over a span.
    #[must_use]
    pub fn new(given: Option<f64>, start: f64, span: f64) -> Self {
        let distance = given.unwrap_or(span.abs() / LOOKS);
        Self { distance, given: given.is_some(), fine: [f64::INFINITY, f64::NEG_INFINITY], start, free: true }
    }

    /// Whether a step from a time, of a length and an error, is to be looked at.
    #[must_use]
    pub fn want(&self, from: f64, length: f64, error: f64) -> bool {
        let since = (from - self.start).abs();
        let long = length > SHORT * self.distance && (self.free || error < UNLIMITED || self.given);
        long || since < self.fine[1] && since + length > self.fine[0] && length * FINER > SHORT * self.distance
    }

    /// Takes the error of a step that was made.
    pub fn take(&mut self, error: f64) {
        self.free = error < UNLIMITED;
    }

    /// The length of a step that ends where something is first seen that acts within this one.
    #[cold]
    #[inline(never)]
    pub fn unseen<S: GaussSystem, P: Problem<System = S>>(
        &mut self,
        problem: &P,
        made: &StepEnds<'_, S>,
        tolerance: &Tolerance,
    ) -> Option<f64> {
        let (lane, cubic) = (made.lane, StepCubic::of(made));
        let trial = Trial { from: made.before.0, to: made.after.0, length: S::Scalar::one(), floor: None };
        let hidden = problem.hides_action();
        let [first, last] = [made.before, made.after].map(|(state, rates)| problem.action(state, Some(rates)));
        let from = made.before.0.t.lane(lane);
        let (since, length) = ((from - self.start).abs(), (made.after.0.t.lane(lane) - from).abs());
        let mut at = 0.0;
        loop {
            let now = since + at;
            let fine = now >= self.fine[0] && now < self.fine[1];
            let distance = if fine { self.distance / FINER } else { self.distance };
            // Up to where looks are nearer, not beyond.
            at += if now < self.fine[0] { distance.min(self.fine[0] - now).max(1e-3 * distance) } else { distance };
            if at >= 0.99 * length {
                return None;
            }
            let part = at / length;
            let seen = problem.action(&cubic.at(part), None);
            let leaves = |i: usize| {
                let of = |rates: &S::Speeds| rates.component(i).lane(lane);
                let curve = if hidden { of(&last) } else { cubic.slope(part, i) };
                let shown = [of(&first), of(&last), curve];
                let (low, high) = shown
                    .iter()
                    .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &rate| (low.min(rate), high.max(rate)));
                let beyond = (of(&seen) - high).max(low - of(&seen));
                let allowed = tolerance.of_variables(&trial, i).lane(lane);
                beyond > LEAVES * (high - low) && beyond * distance > allowed
            };
            if (0..S::Speeds::DIM).any(leaves) {
                let now = since + at;
                self.fine = [now - distance, now + distance.max(self.distance)];
                return Some(at);
            }
        }
    }
}
