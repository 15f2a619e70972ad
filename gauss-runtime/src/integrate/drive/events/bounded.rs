//! Zeros of functions whose rate is bounded: of these none is missed, however long the step.
//!
//! Where a function is f₀ and f₁ at the ends of a part of a step of length h and changes by no more than L in a unit of
//! time, it stays above zero in that part if f₀ + f₁ > L h. Else the part is halved, on the curve of the step, up to
//! seven times; near zero the curve is replaced by states that the method itself reaches. In what is left, some
//! thousandths of a step next to zero, the slopes at its ends decide, where those within it are of the cubic that the
//! ends make; else it is halved again, and named where that is given up. At an eighth of a step they decide already
//! where the function is a parabola there, as the gaps of what bounces low are: else each of its bounces would be a
//! hundred steps.

use crate::integrate::drive::control::Control;
use crate::integrate::drive::cubic::StepCubic;
use crate::integrate::drive::departure::rounding;
use crate::integrate::drive::search::{Crossing, Function, SHORT, StepSearch, same_side, side, value};
use crate::integrate::drive::zero::{below_zero, locate};
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::error::IntegrationErrorKind;
use crate::integrate::problem::state::{Rates, State};
use crate::real::Real;
use crate::system::GaussSystem;

/// A bound of the rate of an event's function along the motion.
pub trait RateBound<S: GaussSystem> {
    /// Bounds of the rate of the function at the speeds of a state, whatever way its gradient turns, and of how fast
    /// that can grow.
    fn bound(&self, state: &State<S>, rates: &Rates<S>) -> [f64; 2];

    /// Its rate in a state.
    fn rate(&self, state: &State<S>) -> f64;

    /// The time within which the function is known by looks, where it depends on the time itself: what is flat at both
    /// ends of a longer one may have come and gone in it.
    fn look(&self) -> Option<f64>;

    /// Hears of a time in which the bound excludes no zero, and the function is not as smooth as to exclude one.
    fn sampled(&self, from: f64, to: f64);
}

/// A bound of the rate of a function, if there is one.
pub type Bound<'a, S> = Option<&'a dyn RateBound<S>>;

/// No bound.
#[derive(Clone, Copy, Debug)]
pub enum NoBound {}

impl<S: GaussSystem> RateBound<S> for NoBound {
    fn bound(&self, _: &State<S>, _: &Rates<S>) -> [f64; 2] {
        match *self {}
    }

    fn rate(&self, _: &State<S>) -> f64 {
        match *self {}
    }

    fn look(&self) -> Option<f64> {
        match *self {}
    }

    fn sampled(&self, _: f64, _: f64) {
        match *self {}
    }
}

/// A step is halved so often, and a part of that on which the function is not smooth so often again.
const HALVINGS: u32 = 7;
const AGAIN: u32 = 3;

/// The number of halvings that are left where one looks whether the rest is needed: at an eighth of a step.
const PLAIN: u32 = HALVINGS - 3;

/// The places within a part at which its slopes are looked at: of no order that turns could keep.
const WITHIN: [f64; 3] = [0.17, 0.44, 0.79];

/// Parts of fewer resolutions are not halved again.
const SHORTEST: f64 = 16.0;

/// So many parts are halved again in a step.
const MORE: u32 = 1024;

/// Bounds are those of states at the ends of steps; between them gradients may be longer by this factor.
const BETWEEN: f64 = 1.5;

/// A function that is followed on the curve of a step, by parts of it.
struct BoundedFunction<'a, S: GaussSystem, G, A> {
    bound: &'a dyn RateBound<S>,
    /// Its values on the curve with its rates there for the whole step, and its values in states that the method
    /// reaches.
    curve: G,
    along: A,
    crossing: Crossing,
    start: (f64, f64),
    /// Largest change of the function in a step.
    most: f64,
    /// The error of the function on the curve in the middle of the step.
    off: f64,
    rounding: f64,
    resolution: f64,
    /// The longest part that may be taken for smooth.
    longest: f64,
    /// The number of parts that may be halved again.
    more: u32,
    /// The time at the start, and the length.
    times: [f64; 2],
}

/// A part of the step with the value there.
type Point = (f64, f64);

type ZeroResult = Result<Option<Point>, IntegrationErrorKind>;

impl<S, G, A> BoundedFunction<'_, S, G, A>
where
    S: GaussSystem,
    G: FnMut(f64) -> Result<[f64; 2], IntegrationErrorKind>,
    A: FnMut(f64) -> Result<f64, IntegrationErrorKind>,
{
    /// No more than the value at a part of the step. The curve meets the motion at both ends with its slope: near them
    /// it is off by the square of how far they are.
    fn least(&mut self, part: f64) -> Result<f64, IntegrationErrorKind> {
        let [seen, _] = (self.curve)(part)?;
        let near = 4.0 * part * (1.0 - part);
        let off = self.off * near * near + self.rounding;
        if seen > 2.0 * off { Ok(seen - off) } else { (self.along)(part) }
    }

    /// The first zero between two points.
    fn first(&mut self, a: Point, b: Point, halvings: u32) -> ZeroResult {
        let width = b.0 - a.0;
        if a.1 > 0.0 && b.1 > 0.0 && a.1 + b.1 > self.most * width || width <= self.resolution {
            return Ok(None);
        }
        if halvings == 0 && width <= self.longest {
            return self.last(a, b, false);
        }
        let middle = 0.5 * (a.0 + b.0);
        if halvings == PLAIN && self.longest >= 1.0 && self.is_plain(a.0, b.0)? {
            return self.last(a, b, true);
        }
        let m = (middle, self.least(middle)?);
        let halvings = halvings.saturating_sub(1);
        match self.first(a, m, halvings)? {
            None => self.first(m, b, halvings),
            found => Ok(found),
        }
    }

    /// Whether the function is the parabola between two points that its values and slopes at both make, as the gap of a
    /// body that bounces is: to a hundredth of what they change it by, or to rounding, in the middle and at the end.
    /// Then these decide. Slopes are those of the motion: differences of values that are some roundings have none.
    fn is_plain(&mut self, from: f64, to: f64) -> Result<bool, IntegrationErrorKind> {
        let [first, middle, last] = [from, 0.5 * (from + to), to].map(&mut self.curve);
        let ([first, leaves], [middle, _], [last, comes]) = (first?, middle?, last?);
        let [leaves, comes] = [leaves, comes].map(|slope| (to - from) * slope);
        let off = (last - first - 0.5 * (leaves + comes)).abs();
        let off_middle = (middle - 0.5 * (first + last) - 0.125 * (leaves - comes)).abs();
        let plain = 0.01 * leaves.abs().max(comes.abs()) + self.rounding;
        Ok(off.max(off_middle) <= plain && self.most.is_finite())
    }

    /// Whether slopes within a part are those of a cubic, to a sixteenth of them: those at two places are of the
    /// parabola through three others. Those at the ends alone agree by chance where turns are between them, as one in
    /// two do. The change of the function has no part in it: on the curve of a step that is off by more than it is in a
    /// low flight.
    fn is_cubic(&mut self, (from, width): Point, [leaves, comes]: [f64; 2]) -> Result<bool, IntegrationErrorKind> {
        let [early, middle, late] = WITHIN.map(|s| (self.curve)(from + s * width).map(|[_, slope]| width * slope));
        let (early, middle, late) = (early?, middle?, late?);
        let at = WITHIN[1];
        let bend = (middle - leaves - at * (comes - leaves)) / (at * (1.0 - at));
        let near = leaves.abs().max(comes.abs()).max(middle.abs()) / 16.0 + 4.0 * self.rounding;
        let off = |s: f64, slope: f64| (leaves + s * (comes - leaves) + s * (1.0 - s) * bend - slope).abs();
        Ok(off(WITHIN[0], early) <= near && off(WITHIN[2], late) <= near)
    }

    /// The zero in a part that is not halved again, of which the function may be known to be plain.
    fn last(&mut self, a: Point, b: Point, plain: bool) -> ZeroResult {
        let start = if a.0 == self.start.0 { self.start } else { (a.0, (self.along)(a.0)?) };
        if start.1 <= 0.0 {
            return self.between(self.start, start);
        }
        let width = b.0 - a.0;
        let ([first, leaves], [last, comes]) = ((self.curve)(a.0)?, (self.curve)(b.0)?);
        let [leaves, comes] = [leaves, comes].map(|slope| width * slope);
        // As the slopes at its ends make it, to half of them and to rounding.
        let off = (last - first - 0.5 * (leaves + comes)).abs();
        let smooth = off <= 0.5 * leaves.abs().max(comes.abs()) + self.rounding && self.most.is_finite();
        let short = width <= SHORTEST * self.resolution;
        if plain || short || smooth && self.is_cubic((a.0, width), [leaves, comes])? {
            return self.of_cubic(start, b, [leaves, comes]);
        }
        if self.more > 0 {
            self.more -= 1;
            return self.first(start, b, AGAIN);
        }
        let [from, length] = self.times;
        self.bound.sampled(from + a.0 * length, from + b.0 * length);
        self.of_cubic(start, b, [leaves, comes])
    }

    /// The zero in a part in which the function has one least value at most, told by its slopes at the ends.
    fn of_cubic(&mut self, start: Point, b: Point, [leaves, comes]: [f64; 2]) -> ZeroResult {
        if b.1 <= 0.0 {
            return self.between(start, b);
        }
        if leaves < 0.0 && comes > 0.0 {
            let Some(dip) = below_zero(&mut self.along, start.0, b.0)? else { return Ok(None) };
            return self.between(start, dip);
        }
        Ok(None)
    }

    fn between(&mut self, a: Point, b: Point) -> ZeroResult {
        if !self.crossing.between(a.1, b.1) {
            return Ok(None);
        }
        Ok(locate(&mut self.along, a, b, self.resolution)?.map(|part| (part, side(b.1))))
    }
}

impl<S, P, C> StepSearch<'_, S, P, C>
where
    S: GaussSystem,
    P: Problem<System = S>,
    C: Control<S>,
{
    /// The first event behind a point of the step, from which a function goes on, as [`StepSearch::first`] finds it;
    /// with a bound of a function that is above zero none is missed.
    pub(in crate::integrate) fn first_of(
        &self,
        (function, bound): (Function<'_, S>, Bound<'_, S>),
        crossing: Crossing,
        (from, back): (Point, f64),
    ) -> ZeroResult {
        let Some(bound) = bound.filter(|_| from.1 > 0.0 && crossing != Crossing::Rising) else {
            return self.first(function, crossing, (from, back));
        };
        let lane = self.made.lane;
        let known = if back < 1.0 { self.first(function, crossing, (from, back))? } else { None };
        let until = match known {
            Some((part, _)) => (part, -f64::MIN_POSITIVE),
            None => (1.0, value(self.problem, function, lane, self.made.after.0)?),
        };
        let ends = [self.made.before, self.made.after].map(|(state, rates)| bound.bound(state, rates));
        let [[fast, grows], [faster, growing]] = ends;
        let length = self.duration();
        let middle = 0.5 * (fast + faster + length * grows.max(growing));
        let most = BETWEEN * length * fast.max(faster).max(middle);
        if same_side(from.1, until.1) && from.1 + until.1 > most * (until.0 - from.0) {
            return Ok(known);
        }
        let mut states = self.control.along(self.problem, self.made.before.0, self.made.before.1);
        let along = |part: f64| {
            let within = part < 1.0;
            let state = if within { states(self.length() * S::Scalar::from_f64(part))? } else { *self.made.after.0 };
            value(self.problem, function, lane, &state)
        };
        let mut glance = self.glances();
        let length = self.length().lane(lane);
        let curve = |part: f64| {
            let state = glance(part)?;
            Ok([value(self.problem, function, lane, &state)?, length * bound.rate(&state)])
        };
        let times = [self.made.before.0.t, self.length()].map(|t| t.lane(lane));
        let rounding = rounding(self.problem, function, lane, self.made.before.0);
        let off = if self.control.long_steps() { 0.0 } else { self.off(function, bound)? };
        let resolution = self.resolution;
        let longest = bound.look().map_or(1.0, |look| look / self.duration());
        let (start, more) = (from, MORE);
        let mut followed = BoundedFunction {
            bound,
            curve,
            along,
            crossing,
            start,
            most,
            off,
            rounding,
            resolution,
            longest,
            more,
            times,
        };
        Ok(followed.first(from, until, HALVINGS)?.or(known))
    }

    /// The error of a function on the curve of the step. Its slope there is that of the motion at the ends and in the
    /// middle; a quarter of the way from an end it is off by most, in a part of the step by three times as much as the
    /// function in the middle.
    fn off(&self, function: Function<'_, S>, bound: &dyn RateBound<S>) -> Result<f64, IntegrationErrorKind> {
        let (lane, cubic) = (self.made.lane, StepCubic::of(self.made));
        let at = |part: f64| value(self.problem, function, lane, &cubic.at(part));
        let mut most = 0.0_f64;
        for part in [0.25, 0.75] {
            let slope = (at(part + SHORT)? - at(part - SHORT)?) / (2.0 * SHORT);
            most = most.max((slope - bound.rate(&cubic.at(part)) * self.length().lane(lane)).abs());
        }
        Ok(2.0 / 3.0 * most)
    }
}
