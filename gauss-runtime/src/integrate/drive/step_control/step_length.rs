//! The lengths of adaptive steps, one decision after another.
//!
//! Smooth systems are stepped by a PI controller (Gustafsson; Hairer, Nørsett & Wanner II.4), which takes the error of
//! a step of length h for c·h^k with a c that changes slowly. On a step across a kink or a jump that is not so: the
//! error is of order h² or h there, whatever the method (Hairer, Nørsett & Wanner II.6), c says nothing about the steps
//! beyond it, and an estimate that is a difference of two methods of high order sees little of it. Where [`Smoothness`]
//! names kinks or jumps,
//!
//! - a rejected step is shortened by the order that it has across a kink or a jump, so that one crossing does not take
//!   many trials, each a little shorter;
//! - the steps that then lead over the place are held to a smaller error;
//! - the first step after a rejection is judged by its own error alone: the memory of the controller is from before it;
//! - steps grow by less at a time, which keeps them from leaping over what the stages have not seen.

use crate::integrate::drive::logarithms::{exponential, logarithm};
use crate::integrate::problem::error::IntegrationErrorKind;
use crate::real::Real;
use crate::system::Smoothness;

/// The part of the tolerance that an error may take near a kink or a jump. A jump at θ of a step makes the error
/// `h·jump·(Σ_{c > θ} b − 1 + θ)`, of which the estimate `h·jump·Σ_{c > θ} (b − b̂)` of the pair 5(4) shows 1/8 to
/// 1/170 at worst, depending on between which stages θ lies.
const NEAR_ROUGHNESS: f64 = 0.02;

/// So many steps lead over the place where one was rejected: with its length cut to r, at least 1/5, they are r, r and,
/// grown by 5 at most, 5r long.
const STEPS_ACROSS: u32 = 3;

/// ln 10⁻⁴: smaller errors are remembered as this one.
const LEAST_REMEMBERED: f64 = -9.210_340_371_976_182;

/// The factors by which an adaptive method changes the length of its steps.
#[derive(Clone, Copy, Debug)]
pub struct StepLength {
    /// k: the power of the step that the error estimate goes with where all is smooth.
    estimate_order: f64,
    smoothness: Smoothness,
    /// Logarithm of the error of the last accepted step; none when that is not to be relied on.
    previous: Option<f64>,
    rejected: bool,
    /// The part of a step that was made after which the present one is to end; else 1.
    stopped: f64,
    /// Steps still to be accepted before a kink or a jump is left behind.
    across: u32,
}

impl StepLength {
    /// Before the first step, of a method whose error estimate goes with this power of the step.
    pub fn new(estimate_order: f64, smoothness: Smoothness) -> Self {
        Self { estimate_order, smoothness, previous: Some(LEAST_REMEMBERED), rejected: false, stopped: 1.0, across: 0 }
    }

    /// The largest error, in tolerances, with which a step is accepted.
    pub fn limit(&self) -> f64 {
        if self.across > 0 { NEAR_ROUGHNESS } else { 1.0 }
    }

    /// A step of this error (in tolerances, above the limit) is tried again: the factor for its length.
    pub fn reject(&mut self, error: f64) -> f64 {
        let excess = error / self.limit();
        self.fail();
        let order = match self.smoothness {
            Smoothness::Smooth => self.estimate_order,
            Smoothness::Kinks => 2.0,
            Smoothness::Jumps => 1.0,
        };
        (0.9 * power(excess, -1.0 / order)).max(0.2)
    }

    /// A step that was made is to end elsewhere, after this part of it: the next one may be as long as it was.
    pub fn stop_before(&mut self, part: f64) -> f64 {
        self.stopped *= part;
        part
    }

    /// A step could not be made at all and is tried again.
    pub fn fail(&mut self) {
        (self.rejected, self.stopped) = (true, 1.0);
        if self.smoothness != Smoothness::Smooth {
            self.previous = None;
            self.across = STEPS_ACROSS;
        }
    }

    /// The part of a step that could not be made for some reason which is tried next. Of one that ends next to a
    /// singularity not a half: two halves end there again.
    pub fn part(reason: &IntegrationErrorKind) -> f64 {
        if matches!(reason, IntegrationErrorKind::ProjectionTooFar { .. }) { 0.7 } else { 0.5 }
    }

    /// A step of this error (in tolerances, within the limit) is accepted: the factor from its length to that of the
    /// next.
    pub fn accept(&mut self, error: f64) -> f64 {
        let logarithm = logarithm(Self::told(error));
        self.grow(logarithm, exponential(self.exponent(logarithm)))
    }

    /// Bounds the error that the controller is told from below: logarithms have no zero, and steps that are far too
    /// short grow no faster.
    pub fn told(error: f64) -> f64 {
        error.max(1e-10)
    }

    /// The logarithm of the factor, but for bounds and margin, after a step with this logarithm of its error.
    pub fn exponent(&self, logarithm: f64) -> f64 {
        match self.previous {
            Some(previous) => (0.4 * previous - 0.7 * logarithm) / self.estimate_order,
            None => -logarithm / self.estimate_order,
        }
    }

    /// [`accept`](Self::accept) with what lanes work out together: the logarithm of the error, and the exponential of
    /// [`exponent`](Self::exponent).
    pub fn grow(&mut self, logarithm: f64, growth: f64) -> f64 {
        let factor = 0.9 * growth;
        // No growth right after a rejection. Smooth systems may find their length fast; others keep to the usual 1.5 to
        // 5 (Hairer, Nørsett & Wanner II.4).
        let most = match (self.rejected, self.smoothness) {
            (true, _) => 1.0,
            (false, Smoothness::Smooth) => 10.0,
            (false, Smoothness::Kinks | Smoothness::Jumps) => 5.0,
        };
        self.previous = Some(logarithm.max(LEAST_REMEMBERED));
        self.rejected = false;
        self.across = self.across.saturating_sub(1);
        let factor = factor.clamp(0.2, most);
        let stopped = core::mem::replace(&mut self.stopped, 1.0);
        if stopped < 1.0 { factor.max(1.0 / stopped) } else { factor }
    }
}

/// `base^exponent` for base > 0.
pub(in crate::integrate) fn power(base: f64, exponent: f64) -> f64 {
    Real::exp(Real::ln(base) * exponent)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Errors of trials, in tolerances; those above 1 are rejected.
    const ERRORS: [f64; 12] = [0.3, 1e-13, 0.9, 40.0, 1.2, 0.8, 0.02, 1.0, 1e9, 0.0, 1.01, 0.7];

    /// Up to the rounding of powers: their exponents, up to ln 10¹⁰ by magnitude, are rounded a few times.
    fn same(a: f64, b: f64) -> bool {
        (a / b - 1.0).abs() < 4.0 * 24.0 * f64::EPSILON
    }

    #[test]
    fn smooth_systems_are_stepped_by_the_plain_controller() {
        let mut length = StepLength::new(5.0, Smoothness::Smooth);
        let (mut previous, mut rejected) = (1e-4_f64, false);
        for error in ERRORS {
            if error > 1.0 {
                assert_eq!(length.reject(error), (0.9 * power(error, -1.0 / 5.0)).max(0.2));
                rejected = true;
            } else {
                let floor = error.max(1e-10);
                let factor = 0.9 * power(floor, -0.7 / 5.0) * power(previous, 0.4 / 5.0);
                assert!(same(length.accept(error), factor.clamp(0.2, if rejected { 1.0 } else { 10.0 })));
                (previous, rejected) = (floor.max(1e-4), false);
            }
        }
    }

    #[test]
    fn a_step_that_stops_before_a_place_is_followed_by_one_as_long_as_it_would_have_been() {
        for smoothness in [Smoothness::Smooth, Smoothness::Jumps] {
            let mut length = StepLength::new(8.0, smoothness);
            assert_eq!(length.stop_before(0.5) * length.stop_before(0.5), 0.25);
            assert!(length.accept(0.9) >= 4.0);
            assert!(length.accept(0.9) < 1.0);
            // What the error shortens is no longer the step that was made.
            length.stop_before(0.5);
            length.reject(2.0);
            assert!(length.accept(1e-8) <= 1.0);
        }
    }

    #[test]
    fn kinks_and_jumps_are_met_with_care() {
        for (smoothness, order) in [(Smoothness::Kinks, 2.0), (Smoothness::Jumps, 1.0)] {
            let mut length = StepLength::new(5.0, smoothness);
            // Bounded growth, although the error says more.
            assert_eq!((length.limit(), length.accept(0.0)), (1.0, 5.0));
            // Shortened by the order that there is, to what is accepted from then on.
            assert_eq!(length.reject(3.0), 0.9 * power(3.0, -1.0 / order));
            assert_eq!(length.reject(0.05), (0.9 * power(0.05 / 0.02, -1.0 / order)).max(0.2));
            assert_eq!(length.reject(1e9), 0.2);
            // No growth, then memory starts anew; three steps on, the place is behind.
            assert_eq!((length.limit(), length.accept(1e-6)), (0.02, 1.0));
            let factor = 0.9 * power(0.01, -0.7 / 5.0) * power(1e-4, 0.4 / 5.0);
            assert!(length.limit() == 0.02 && same(length.accept(0.01), factor));
            assert_eq!((length.limit(), length.accept(1e-10)), (0.02, 5.0));
            assert_eq!(length.limit(), 1.0);
            // The error of the step before a failure does not count after it.
            assert!(length.accept(0.9) < 1.0);
            length.fail();
            assert_eq!(length.accept(0.015), 1.0);
        }
    }
}
