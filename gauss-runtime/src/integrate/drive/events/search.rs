//! The search for events within a step.

use crate::integrate::drive::control::Control;
use crate::integrate::drive::cubic::StepCubic;
pub use crate::integrate::drive::cubic::StepEnds;
use crate::integrate::drive::zero::{below_zero, least_of_cubic, locate};
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::error::{IntegrationErrorKind, RunPart};
use crate::integrate::problem::state::State;
use crate::real::Real;
use crate::system::GaussSystem;

/// Which passages through zero are events, in the order of integration: a run backwards meets a function that grows
/// with time as falling.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Crossing {
    /// From below zero to zero or above.
    Rising,
    /// From above zero to zero or below.
    Falling,
    /// Both.
    Any,
}

impl Crossing {
    /// A value of zero before is none: what starts on zero is on the side to which it leaves, or stays there.
    pub(in crate::integrate) fn between(self, before: f64, after: f64) -> bool {
        let rising = before < 0.0 && after >= 0.0;
        let falling = before > 0.0 && after <= 0.0;
        match self {
            Self::Rising => rising,
            Self::Falling => falling,
            Self::Any => rising || falling,
        }
    }
}

/// A function of time, configuration and quasi-velocities.
pub type Function<'a, S> = &'a dyn Fn(
    <S as GaussSystem>::Scalar,
    &<S as GaussSystem>::Configuration,
    &<S as GaussSystem>::Speeds,
) -> <S as GaussSystem>::Scalar;

/// An event's function in a lane. It may be infinite, as on the way through a pole.
pub(in crate::integrate) fn value<S: GaussSystem, P: Problem<System = S>>(
    problem: &P,
    function: Function<'_, S>,
    lane: usize,
    state: &State<S>,
) -> Result<f64, IntegrationErrorKind> {
    of_lane(values(problem, function, state), lane)
}

/// An event's function in all lanes.
pub fn values<S: GaussSystem, P: Problem<System = S>>(
    problem: &P,
    function: Function<'_, S>,
    state: &State<S>,
) -> S::Scalar {
    function(state.t, &state.q, &problem.speeds(state.t, &state.q, &state.y))
}

/// One of the values of an event's function.
pub(in crate::integrate) fn of_lane<T: Real>(values: T, lane: usize) -> Result<f64, IntegrationErrorKind> {
    let value = values.lane(lane);
    if value.is_nan() { Err(IntegrationErrorKind::NonFinite { part: RunPart::Event }) } else { Ok(value) }
}

/// Whether two values are both below zero, or both above.
pub(in crate::integrate) fn same_side(a: f64, b: f64) -> bool {
    a < 0.0 && b < 0.0 || a > 0.0 && b > 0.0
}

/// The side of a value and nothing of its size; of zero none.
pub(in crate::integrate) fn side(value: f64) -> f64 {
    if value == 0.0 { 0.0 } else { value.signum() * f64::MIN_POSITIVE }
}

/// The parts into which a step is divided where the cubic between its ends is looked at, and where a series is.
const PARTS: (usize, usize) = (2, 32);

/// The part of a step over which slopes are measured.
pub(in crate::integrate) const SHORT: f64 = 1.0 / 1024.0;

/// A step that is searched.
pub struct StepSearch<'a, S: GaussSystem, P, C> {
    pub(super) control: &'a C,
    pub(in crate::integrate) problem: &'a P,
    pub(in crate::integrate) made: &'a StepEnds<'a, S>,
    /// The part of the step to which a zero is found.
    pub(in crate::integrate) resolution: f64,
    parts: usize,
}

impl<'a, S, P, C> StepSearch<'a, S, P, C>
where
    S: GaussSystem,
    P: Problem<System = S>,
    C: Control<S>,
{
    /// A step that a control has made.
    pub fn of(control: &'a C, problem: &'a P, made: &'a StepEnds<'a, S>) -> Self {
        let (from, to) = (made.before.0.t.lane(made.lane), made.after.0.t.lane(made.lane));
        let unit = S::Scalar::EPSILON.max(f64::EPSILON);
        // The part of a step that changes its end by four roundings of the time, at least of the step itself.
        let resolution = 4.0 * unit * (from.abs().max(to.abs()) / (to - from).abs()).max(1.0);
        Self { control, problem, made, resolution, parts: if control.long_steps() { PARTS.1 } else { PARTS.0 } }
    }

    pub(in crate::integrate) fn length(&self) -> S::Scalar {
        self.made.after.0.t - self.made.before.0.t
    }

    /// The state that the method reaches at a part of the step.
    pub(in crate::integrate) fn reach(&self, part: f64) -> Result<State<S>, IntegrationErrorKind> {
        // The end of the step itself is that of the run, whose time is not the sum of lengths.
        if part >= 1.0 {
            return Ok(*self.made.after.0);
        }
        let (state, rates) = self.made.before;
        self.control.within(self.problem, state, rates, self.length() * S::Scalar::from_f64(part))
    }

    /// Duration of the step, without a sign.
    pub(in crate::integrate) fn duration(&self) -> f64 {
        self.length().lane(self.made.lane).abs()
    }

    /// The parts of the step at which it is looked at: where a function is about to be back, four times as far and so
    /// on, then all of one length.
    fn parts(&self, from: f64, back: f64) -> impl Iterator<Item = f64> + use<S, P, C> {
        let parts = self.parts;
        let near = core::iter::successors(Some(back), |part| Some(4.0 * part));
        let near = near.take_while(move |part| part * (parts as f64) < 1.0);
        near.chain((1..=parts).map(move |k| k as f64 / parts as f64)).filter(move |part| *part > from)
    }

    /// The first event behind a point of the step, from which a function goes on: its part, and the value at it.
    pub(in crate::integrate) fn first(
        &self,
        function: Function<'_, S>,
        crossing: Crossing,
        (from, back): ((f64, f64), f64),
    ) -> Result<Option<(f64, f64)>, IntegrationErrorKind> {
        if back >= 1.0 && !self.suspicious(function, from)? {
            return Ok(None);
        }
        let lane = self.made.lane;
        let (before, rates) = self.made.before;
        let mut states = self.control.along(self.problem, before, rates);
        // As `reach`, with what belongs to the step worked out once.
        let mut along = |part: f64| {
            let within = part < 1.0;
            let state = if within { states(self.length() * S::Scalar::from_f64(part))? } else { *self.made.after.0 };
            value(self.problem, function, lane, &state)
        };
        let mut glance = self.glances();
        let mut slope = |from: f64, to: f64| -> Result<f64, IntegrationErrorKind> {
            let mut at = |part: f64| value(self.problem, function, lane, &glance(part)?);
            Ok((at(to)? - at(from)?) / (to - from))
        };
        let mut a = from;
        for part in self.parts(from.0, back) {
            let b = (part, along(part)?);
            // There and back between these two.
            if same_side(a.1, b.1) {
                let sign = a.1.signum();
                let short = SHORT * (b.0 - a.0);
                let falls = sign * slope(a.0, a.0 + short)? < 0.0 && sign * slope(b.0 - short, b.0)? > 0.0;
                if falls && let Some((x, beyond)) = below_zero(|part| Ok(sign * along(part)?), a.0, b.0)? {
                    let x = (x, sign * beyond);
                    if let Some(found) = self.between(&mut along, crossing, a, x)? {
                        return Ok(Some(found));
                    }
                    a = x;
                }
            }
            if let Some(found) = self.between(&mut along, crossing, a, b)? {
                return Ok(Some(found));
            }
            a = b;
        }
        Ok(None)
    }

    /// The event between two points, if it is one.
    fn between(
        &self,
        along: &mut impl FnMut(f64) -> Result<f64, IntegrationErrorKind>,
        crossing: Crossing,
        a: (f64, f64),
        b: (f64, f64),
    ) -> Result<Option<(f64, f64)>, IntegrationErrorKind> {
        if !crossing.between(a.1, b.1) {
            return Ok(None);
        }
        // Where it is zero at last, whatever sign the rounding there has.
        let zero = |part: f64| (part, side(b.1));
        Ok(locate(along, a, b, self.resolution)?.map(zero))
    }

    /// Whether the curve between the ends of the step shows a sign, or comes so near to zero within, that it is worth a
    /// search.
    fn suspicious(&self, function: Function<'_, S>, from: (f64, f64)) -> Result<bool, IntegrationErrorKind> {
        let (lane, mut glance) = (self.made.lane, self.glances());
        let mut at = |part: f64| value(self.problem, function, lane, &glance(part)?);
        let (mut a, mut on_curve) = (from, at(from.0)?);
        for part in self.parts(from.0, 1.0) {
            let b = (part, at(part)?);
            let short = SHORT * (b.0 - a.0);
            let mut slopes = || Ok([(at(a.0 + short)? - on_curve) / SHORT, (b.1 - at(b.0 - short)?) / SHORT]);
            if shows_zero([a.1, b.1], &mut slopes)? {
                return Ok(true);
            }
            (a, on_curve) = (b, b.1);
        }
        Ok(false)
    }

    /// Looks at a whole step in all lanes at once: whether the curve in a lane that starts from a value shows a zero,
    /// or comes so near to one that the step is worth a search.
    ///
    /// # Errors
    /// When a state within the step cannot be made.
    #[cfg(feature = "alloc")]
    pub fn glimpse(
        &self,
        function: Function<'_, S>,
    ) -> Result<impl Fn(usize, f64) -> Result<bool, IntegrationErrorKind>, IntegrationErrorKind> {
        let mut glance = self.glances();
        let mut at = |part: f64| -> Result<S::Scalar, IntegrationErrorKind> {
            Ok(values(self.problem, function, &glance(part)?))
        };
        let width = 1.0 / self.parts as f64;
        let mut seen = alloc::vec::Vec::with_capacity(self.parts);
        let mut a = at(0.0)?;
        for k in 1..=self.parts {
            let (from, to) = ((k - 1) as f64 * width, k as f64 * width);
            let b = at(to)?;
            seen.push([a, at(from + SHORT * width)?, at(to - SHORT * width)?, b]);
            a = b;
        }
        Ok(move |lane: usize, start: f64| {
            let mut before = start;
            for points in &seen {
                let [on_curve, off, near, b] = points.map(|values| of_lane(values, lane));
                let (off, b) = (off?, b?);
                let slopes = || Ok([(off - on_curve?) / SHORT, (b - near?) / SHORT]);
                if shows_zero([before, b], slopes)? {
                    return Ok(true);
                }
                before = b;
            }
            Ok(false)
        })
    }

    /// States within the step for a first look: the series where steps are long, else the cubic between the ends.
    pub(super) fn glances(&self) -> impl FnMut(f64) -> Result<State<S>, IntegrationErrorKind> {
        let (before, rates) = self.made.before;
        let length = self.length();
        let long = self.control.long_steps();
        let mut along = long.then(|| self.control.along(self.problem, before, rates));
        let cubic = (!long).then(|| StepCubic::of(self.made));
        move |part| match (&mut along, &cubic) {
            (Some(along), _) => along(length * S::Scalar::from_f64(part)),
            (None, Some(cubic)) => Ok(cubic.at(part)),
            (None, None) => Ok(*before),
        }
    }
}

/// Whether a part of a step from value to value, with these slopes at its ends where they are needed, shows a zero
/// or comes near to one.
fn shows_zero(
    [a, b]: [f64; 2],
    slopes: impl FnOnce() -> Result<[f64; 2], IntegrationErrorKind>,
) -> Result<bool, IntegrationErrorKind> {
    // What was zero all along has not left it.
    if a != 0.0 && !same_side(a, b) || !b.is_finite() {
        return Ok(true);
    }
    let sign = b.signum();
    let [leaves, comes] = slopes()?.map(|slope| sign * slope);
    // Its slopes lead towards zero from both sides.
    Ok(leaves < 0.0
        && comes > 0.0
        && least_of_cubic([sign * a, sign * b], [leaves, comes]) < 0.1 * a.abs().max(b.abs()))
}
