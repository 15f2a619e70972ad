//! Departure of the function of an event from zero: to which side, and whether it comes back at once.
//!
//! After a jump, and at a start on zero, the value of the function is rounding, and so is its sign. Where the motion
//! leads decides. The function is followed on the parabola of the motion (state, velocity, acceleration) at parts of
//! the step that grow by four, from far below what the time resolves. The first two in a row that differ from the value
//! at the start by more than rounding show the side. However short a flight is beside the step, some parts lie within
//! it: of a flight of height H one shows 0.64 H at least (one lies between a fifth and four fifths of it), and the one
//! before 0.19 H. So a flight of 5.3 roundings is seen, and a lower one is rest.

use crate::configuration::{Configuration, VectorSpace};
use crate::integrate::drive::control::Control;
use crate::integrate::drive::search::{Function, SHORT, StepSearch, same_side, value, values};
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::error::IntegrationErrorKind;
use crate::integrate::problem::state::{Rates, State, TangentOf};
use crate::real::Real;
use crate::system::GaussSystem;

/// Parts of a step that are looked at: from 4⁻³⁰, which no time resolves, to the whole.
const PARTS: usize = 31;

/// The part of a step over which rates are measured. Their error is the square of what the motion turns in it, below
/// 10⁻⁶ where a step turns by 5 radians; rounding is the smaller, the longer it is.
const SPAN: f64 = 1.0 / 4096.0;

/// Roundings of every number that a function depends on: states are sums of some rounded terms, and so is the function.
const ROUNDINGS: f64 = 16.0;

/// A rate that a jump has left is rest where it is less than this part of the one before: rates are measured to
/// [`SPAN`].
const DIFFERS: f64 = 1e-6;

/// A function that is on zero, to rounding.
#[derive(Clone, Copy, Debug)]
pub(in crate::integrate) struct RestAtZero {
    value: f64,
    /// Rounding error of the values here.
    rounding: f64,
    /// Side that the function came from, and its rate before the jump, of an event whose jump has to lead back.
    back: Option<(f64, f64)>,
}

/// Departure of a function from zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::integrate) struct Departure {
    /// The part of the step at which it is on a side, and a number of that sign and nothing of a size.
    pub(in crate::integrate) from: (f64, f64),
    /// The last part before it is back, on the parabola; 1 where it does not come back.
    pub(in crate::integrate) until: f64,
    /// Whether it goes there by its rate, not by its curvature.
    straight: bool,
    /// The part at which the side is seen.
    seen: f64,
}

impl Departure {
    /// A function that is on a side already.
    pub(in crate::integrate) fn known(value: f64) -> Self {
        Self { from: (0.0, value), until: 1.0, straight: true, seen: 0.0 }
    }
}

impl RestAtZero {
    /// At a start, or where a step ends.
    pub(in crate::integrate) fn exactly(rounding: f64) -> Self {
        Self { value: 0.0, rounding, back: None }
    }

    /// After a jump.
    pub(in crate::integrate) fn after(value: f64, rounding: f64, back: Option<(f64, f64)>) -> Self {
        Self { value, rounding, back }
    }

    /// Which way the function goes that has these values at growing parts of a step; none where it does not leave in
    /// it.
    fn leaves(&self, points: &[(f64, f64)]) -> Option<Departure> {
        let off = |n: usize| points[n].1 - self.value;
        let beyond = |n: usize| off(n).abs() > self.rounding;
        let next = |n: usize| n + 1 < points.len();
        let shows = |n: &usize| beyond(*n) && (!next(*n) || beyond(n + 1) && same_side(off(*n), off(n + 1)));
        let first = (0..points.len()).find(shows)?;
        let toward = off(first).signum();
        // Four times as far in four times the time, or sixteen times.
        let straight = next(first) && off(first + 1).abs() < 8.0 * off(first).abs();
        let reaches = |side: f64| (first..points.len()).find(|&n| points[n].1 * side > 0.0);
        let (side, at, straight) = match reaches(toward) {
            Some(at) => (toward, at, straight),
            // Still on the way, from a little beyond zero.
            None if off(points.len() - 1) * toward > 0.0 => return None,
            None => (-toward, reaches(-toward)?, false),
        };
        let back = (at + 1..points.len()).find(|&n| points[n].1 * side < 0.0);
        Some(Departure {
            from: (points[at].0, side * f64::MIN_POSITIVE),
            until: back.map_or(1.0, |n| points[n - 1].0),
            straight,
            seen: points[first].0,
        })
    }
}

/// Whether a function changes with the configuration, where time and speeds stay: moved by half of its digits, every
/// one of its components by itself.
pub fn is_of_the_configuration<S: GaussSystem, P: Problem<System = S>>(
    problem: &P,
    function: Function<'_, S>,
    lane: usize,
    state: &State<S>,
) -> bool {
    let z = problem.speeds(state.t, &state.q, &state.y);
    let at = |q: &S::Configuration| function(state.t, q, &z).lane(lane);
    let here = at(&state.q);
    let part = S::Scalar::from_f64(Real::sqrt(S::Scalar::EPSILON));
    (0..TangentOf::<S>::DIM).any(|i| {
        let mut sigma = TangentOf::<S>::zero();
        sigma.set_component(i, part * (S::Scalar::one() + state.q.magnitudes(i)));
        at(&state.q.retract(&sigma)) != here
    })
}

/// Estimates the change of a function by rounding of time, configuration and speeds: the sum of its changes with each
/// of them.
pub fn rounding<S: GaussSystem, P: Problem<System = S>>(
    problem: &P,
    function: Function<'_, S>,
    lane: usize,
    state: &State<S>,
) -> f64 {
    let unit = S::Scalar::from_f64(S::Scalar::EPSILON.max(f64::EPSILON));
    let at = |state: &State<S>| values(problem, function, state).lane(lane);
    let here = at(state);
    let mut sum = 0.0;
    let mut add = |there: f64| {
        let change = (there - here).abs();
        // Undefined on the other side of an edge of where it is defined.
        sum += if change.is_finite() { change } else { 0.0 };
    };
    add(at(&State { t: state.t * (S::Scalar::one() + unit), ..*state }));
    let dimension = TangentOf::<S>::DIM;
    let larger = |a: S::Scalar, b: S::Scalar| S::Scalar::select_lt(a, b, b, a);
    // A projection moves every coordinate by roundings of all.
    let all = (0..dimension).fold(S::Scalar::zero(), |all, i| larger(all, state.q.magnitudes(i)));
    for i in 0..dimension {
        let mut sigma = TangentOf::<S>::zero();
        sigma.set_component(i, unit * if S::CONSTRAINED { all } else { state.q.magnitudes(i) });
        add(at(&State { q: state.q.retract(&sigma), ..*state }));
    }
    for i in 0..S::Speeds::DIM {
        let mut y = state.y;
        y.set_component(i, y.component(i) * (S::Scalar::one() + unit));
        add(at(&State { y, ..*state }));
    }
    ROUNDINGS * sum
}

/// The motion near a state, to the second order.
pub(in crate::integrate) struct Parabola<'a, S: GaussSystem> {
    state: &'a State<S>,
    rates: &'a Rates<S>,
    second: Rates<S>,
    h: S::Scalar,
}

impl<'a, S: GaussSystem> Parabola<'a, S> {
    /// Over a time h. The second derivatives are differences: what they are off by changes less than they do within a
    /// step.
    pub(in crate::integrate) fn of<P: Problem<System = S>>(
        problem: &P,
        state: &'a State<S>,
        rates: &'a Rates<S>,
        h: S::Scalar,
    ) -> Self {
        let short = h * S::Scalar::from_f64(SHORT);
        let next = problem.rates(&moved(state, rates, short));
        let minus = -S::Scalar::one();
        let second = Rates {
            configuration: next.configuration.add_scaled(minus, &rates.configuration).scale(short.recip()),
            variables: next.variables.add_scaled(minus, &rates.variables).scale(short.recip()),
        };
        Self { state, rates, second, h }
    }

    pub(in crate::integrate) fn at(&self, part: f64) -> State<S> {
        let h = self.h * S::Scalar::from_f64(part);
        let half = h * S::Scalar::from_f64(0.5);
        let mean = Rates {
            configuration: self.rates.configuration.add_scaled(half, &self.second.configuration),
            variables: self.rates.variables.add_scaled(half, &self.second.variables),
        };
        moved(self.state, &mean, h)
    }
}

/// The state a time h later at these rates.
fn moved<S: GaussSystem>(state: &State<S>, rates: &Rates<S>, h: S::Scalar) -> State<S> {
    State {
        t: state.t + h,
        q: state.q.retract(&rates.configuration.scale(h)),
        y: state.y.add_scaled(h, &rates.variables),
    }
}

impl<S, P, C> StepSearch<'_, S, P, C>
where
    S: GaussSystem,
    P: Problem<System = S>,
    C: Control<S>,
{
    /// Finds the side to which a function that is on zero at the start of the step leaves it; none where it does not in
    /// this step.
    pub(in crate::integrate) fn leaves(
        &self,
        function: Function<'_, S>,
        on: &RestAtZero,
    ) -> Result<Option<Departure>, IntegrationErrorKind> {
        self.leaves_from(function, on, self.made.before, 0.0)
    }

    /// The same from a state within the step, with the derivatives there.
    fn leaves_from(
        &self,
        function: Function<'_, S>,
        on: &RestAtZero,
        (state, rates): (&State<S>, &Rates<S>),
        start: f64,
    ) -> Result<Option<Departure>, IntegrationErrorKind> {
        let lane = self.made.lane;
        let whole = |part: f64| start + (1.0 - start) * part;
        let parabola = Parabola::of(self.problem, state, rates, self.length() * S::Scalar::from_f64(1.0 - start));
        let (mut points, mut count, mut part) = ([(1.0, 0.0); PARTS], 0, 1.0);
        (1..PARTS).for_each(|_| part *= 0.25);
        while part < 1.0 {
            let value = values(self.problem, function, &parabola.at(part)).lane(lane);
            // Where the parabola leads to what is undefined, the motion need not.
            if value.is_nan() {
                break;
            }
            points[count] = (whole(part), value);
            (count, part) = (count + 1, 4.0 * part);
        }
        // The end of the step is known.
        points[count] = (1.0, value(self.problem, function, lane, self.made.after.0)?);
        Ok(on.leaves(&points[..=count]))
    }

    /// Finds the side on which a function goes on that had a value, perhaps zero, at a part of the step.
    pub(in crate::integrate) fn going_on(
        &self,
        function: Function<'_, S>,
        (part, at): (f64, f64),
    ) -> Result<Option<Departure>, IntegrationErrorKind> {
        if at != 0.0 || part >= 1.0 {
            return Ok(Some(Departure { from: (part, at), ..Departure::known(at) }));
        }
        let state = self.reach(part)?;
        let on = RestAtZero::exactly(rounding(self.problem, function, self.made.lane, &state));
        self.leaves_from(function, &on, (&state, &self.problem.rates(&state)), part)
    }

    /// The rate of a function along the motion at a state, per unit of time in the direction of integration, measured
    /// over a part of the step.
    pub(in crate::integrate) fn rate(&self, function: Function<'_, S>, state: &State<S>, rates: &Rates<S>) -> f64 {
        let along = |part: f64| {
            let state = moved(state, rates, self.length() * S::Scalar::from_f64(part));
            values(self.problem, function, &state).lane(self.made.lane)
        };
        let change = 4.0 * along(SPAN) - along(2.0 * SPAN) - 3.0 * along(0.0);
        let slope = change / (2.0 * SPAN * self.duration());
        if slope.is_finite() { slope } else { 0.0 }
    }

    /// Whether the jump of an event has led its function back, where it has to.
    pub(in crate::integrate) fn led_back(
        &self,
        function: Function<'_, S>,
        event: usize,
        (on, leaving): (&RestAtZero, &Departure),
    ) -> Result<(), IntegrationErrorKind> {
        let Some((side, before)) = on.back.filter(|(side, _)| !same_side(*side, leaving.from.1)) else { return Ok(()) };
        let (state, rates) = self.made.before;
        let after = self.rate(function, state, rates);
        let goes_on = leaving.straight
            && same_side(before, after)
            && !same_side(side, after)
            && after.abs() > DIFFERS * before.abs();
        if !goes_on {
            return Err(IntegrationErrorKind::Zeno { event, interval: leaving.seen * self.duration() });
        }
        // What no velocity turns back, such as the time, is not meant to be.
        if is_of_the_configuration(self.problem, function, self.made.lane, state) {
            return Err(IntegrationErrorKind::NotTurnedBack { event, before, after });
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values of a function at the parts that are looked at.
    fn leaves(on: &RestAtZero, function: impl Fn(f64) -> f64) -> Option<Departure> {
        let points: [(f64, f64); PARTS] = core::array::from_fn(|n| {
            let part = 0.25_f64.powi((PARTS - 1 - n) as i32);
            (part, function(part))
        });
        on.leaves(&points)
    }

    #[test]
    fn flights_are_seen_however_short_and_low_ones_are_rest() {
        // From a little beyond zero by rounding, flights of lengths from 10⁻⁹ of the step on.
        let on = RestAtZero::after(-1e-16, 1e-15, None);
        for n in 0..60 {
            let length = 1e-9 * 1.4_f64.powi(n);
            let flight = |x: f64| -1e-16 + 1e3 * x * (length - x);
            let (height, found) = (250.0 * length * length, leaves(&on, flight).expect("moves"));
            if height > 5.3e-15 {
                assert!(found.from.1 > 0.0 && found.from.0 < length, "{length} {found:?}");
                assert!(found.until > 0.2 * length && found.until <= length.min(1.0), "{length} {found:?}");
            } else if height < 1e-15 {
                assert!(found.from.1 < 0.0 && !found.straight, "{length} {found:?}");
            }
        }
        // What passes on, what falls from rest, what stays.
        assert!(leaves(&on, |x| -1e-16 - x).is_some_and(|found| found.straight && found.from.1 < 0.0));
        assert!(leaves(&on, |x| -1e-16 - x * x).is_some_and(|found| !found.straight && found.from.1 < 0.0));
        assert_eq!(leaves(&on, |x| 1e-16 * x), None);
        // Beyond zero by more than it rises: it is not on the other side, and falls again.
        let beyond = RestAtZero::after(-1e-12, 1e-15, None);
        assert!(leaves(&beyond, |x| -1e-12 + 1e-6 * x * (1e-8 - x)).is_some_and(|found| found.from.1 < 0.0));
        assert_eq!(leaves(&beyond, |x| -1e-12 + 0.9e-12 * x), None);
    }
}
