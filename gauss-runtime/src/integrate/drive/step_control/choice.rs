//! Choice of the lengths of adaptive steps: of a run, or of one lane among others, from the errors of its trials.

use core::ops::Range;

use crate::integrate::drive::cause::change;
use crate::integrate::drive::control::{StepStatistics, smallest, to_a_number, unresolved};
use crate::integrate::drive::cubic::StepEnds;
use crate::integrate::drive::looks::Looks;
use crate::integrate::drive::projection::{AVOIDED, clear_part, is_hopeless};
use crate::integrate::drive::step_length::StepLength;
use crate::integrate::drive::tolerance::{Tolerance, Trial};
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::error::IntegrationErrorKind;
use crate::integrate::problem::state::{Rates, State};
use crate::real::Real;
use crate::system::GaussSystem;

/// The error, in tolerances, for which one that is but rounding is taken: steps then grow by a sixth.
const ROUNDED: f64 = 1e-3;

/// The choice of steps of a run, or of a lane, as it goes on.
#[derive(Clone, Copy, Debug)]
pub struct StepChoice {
    pub(in crate::integrate) span: f64,
    pub(in crate::integrate) longest: f64,
    /// The length to try next.
    pub(in crate::integrate) length: f64,
    lengths: StepLength,
    looks: Looks,
    /// The longest step since the rounding error was measured, or the step for which it was measured.
    looked: f64,
    rejected: u32,
    /// The present trial: its length, whether it is the last step, its error.
    used: f64,
    last: bool,
    error: f64,
}

impl StepChoice {
    /// Before a run over a span; its first length and the longest are to be set.
    pub(in crate::integrate) fn new(span: f64, lengths: StepLength, looks: Looks) -> Self {
        let (longest, length, looked, used, error) = (0.0, 0.0, 0.0, 0.0, 0.0);
        Self { span, longest, length, lengths, looks, looked, rejected: 0, used, last: false, error }
    }

    /// The length of the step to try next, without its sign.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.length
    }

    /// The length of the present trial, without its sign.
    #[must_use]
    pub fn used(&self) -> f64 {
        self.used
    }

    /// Whether the present trial is the last step.
    #[must_use]
    pub fn is_last(&self) -> bool {
        self.last
    }

    fn signed(&self) -> f64 {
        if self.span < 0.0 { -self.length } else { self.length }
    }

    /// The step to try from a time with this time left, with its sign.
    ///
    /// # Errors
    /// When it would do nothing.
    #[inline(always)]
    pub fn propose<T: Real>(&mut self, t: T, rest: T) -> Result<T, IntegrationErrorKind> {
        let left = rest.lane(0).abs();
        // Stretch by 1 % rather than leave a sliver.
        self.last = self.length >= left * 0.99;
        let signed = if self.last { rest } else { to_a_number(t, self.signed()) };
        if t + signed == t || !self.last && self.vanishes(t) {
            return Err(unresolved::<T>(self.length, t.lane(0), self.span));
        }
        self.used = if self.last { left } else { self.length };
        Ok(signed)
    }

    fn vanishes<T: Real>(&self, t: T) -> bool {
        self.length <= smallest::<T>(t.lane(0), self.span)
    }

    /// Takes the error of the trial, as a part of the tolerance; whether it is too large.
    #[inline(always)]
    pub fn judge(&mut self, error: f64) -> bool {
        self.error = error;
        self.rejects()
    }

    /// Whether the error of the trial is too large.
    #[inline(always)]
    #[must_use]
    pub fn rejects(&self) -> bool {
        self.error.is_nan() || self.error > self.lengths.limit()
    }

    /// The trial is rejected for its error: a shorter one is next.
    #[inline(always)]
    pub fn reject(&mut self) {
        let factor = self.lengths.reject(self.error);
        self.shorten(self.used * factor);
    }

    fn shorten(&mut self, length: f64) {
        self.length = length;
        self.rejected += 1;
    }

    /// Whether the trial ends beside a place where constraints become dependent: then the next one ends before it.
    #[inline(always)]
    pub fn ends_beside<S: GaussSystem, P: Problem<System = S>>(
        &mut self,
        problem: &P,
        trial: &Trial<'_, S>,
        moved: &Rates<S>,
        lane: usize,
    ) -> bool {
        if self.last || self.rejected >= AVOIDED {
            return false;
        }
        let Some(part) = clear_part(problem, trial, moved, lane) else { return false };
        let part = self.lengths.stop_before(part);
        self.shorten(self.used * part);
        true
    }

    /// Whether something acts within the trial that its stages have not seen, as far as looks tell: then the next one
    /// ends there.
    #[inline(always)]
    pub fn leads_over_input<S: GaussSystem, P: Problem<System = S>>(
        &mut self,
        problem: &P,
        made: &StepEnds<'_, S>,
        tolerance: &Tolerance,
    ) -> bool {
        if !self.looks.want(made.before.0.t.lane(made.lane), self.used, self.error) {
            return false;
        }
        let Some(shorter) = self.looks.unseen(problem, made, tolerance) else { return false };
        self.shorten(shorter);
        true
    }

    /// The error that the control is told of a trial to which rounding adds so many tolerances, if they are more than
    /// one: its logarithm is asked for by [`exponent`](Self::exponent).
    #[inline(always)]
    #[must_use]
    pub fn told(&self, excess: f64) -> f64 {
        // Well below what rounding does there is nothing to be learnt of the step.
        StepLength::told(if excess > 0.0 && self.error < 0.5 { self.error.min(ROUNDED) } else { self.error })
    }

    /// The logarithm of the factor from this length to the next.
    #[inline(always)]
    #[must_use]
    pub fn exponent(&self, logarithm: f64) -> f64 {
        self.lengths.exponent(logarithm)
    }

    /// The trial is taken, with the logarithm of the error that was told and the exponential of
    /// [`exponent`](Self::exponent). Whether rounding is to be measured where it ends: where it limits the step,
    /// elsewhere when steps have become short.
    #[inline(always)]
    pub fn take(&mut self, excess: f64, logarithm: f64, growth: f64) -> (StepStatistics, bool) {
        self.looks.take(self.error);
        self.length = (self.used * self.lengths.grow(logarithm, growth)).min(self.longest);
        let again = excess > 0.0 || self.length < 0.5 * self.looked;
        self.looked = if again { self.length } else { self.looked.max(self.length) };
        (StepStatistics { rejected: core::mem::take(&mut self.rejected), excess }, again)
    }

    /// A step that failed in some lanes, of which t is the time: a shorter one may do, as long as it changes the time,
    /// and the state if anything does.
    ///
    /// # Errors
    /// The one that is given, where none will.
    #[cold]
    pub fn halve<S: GaussSystem, P: Problem<System = S>, T: Real>(
        &mut self,
        problem: &P,
        (state, rates): (&State<S>, &Rates<S>),
        (lanes, t, left): (Range<usize>, T, f64),
        kind: IntegrationErrorKind,
    ) -> Result<(), IntegrationErrorKind> {
        self.shorten(StepLength::part(&kind) * self.length.min(left));
        self.lengths.fail();
        let moves = change(state, rates, &lanes) * self.length;
        let still = moves > 0.0 && moves < 0.5 * S::Scalar::EPSILON;
        let vanishes = self.vanishes(t) || t + T::from_f64(self.signed()) == t;
        let hopeless = || is_hopeless(problem, state, lanes, (&kind, self.rejected));
        if still || vanishes || hopeless() { Err(kind) } else { Ok(()) }
    }
}
