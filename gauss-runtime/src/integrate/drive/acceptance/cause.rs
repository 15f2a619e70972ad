//! Why a run cannot go on: the causes of a step that fails, or of steps without end.

use core::ops::Range;

use crate::configuration::{Configuration, VectorSpace};
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::error::{IntegrationErrorKind, RunPart};
use crate::integrate::problem::state::{Rates, State, TangentOf};
use crate::integrate::step::iteration::worst;
use crate::real::Real;
use crate::system::{GaussSystem, Smoothness};

/// Ways in which a run comes to its end.
#[derive(Clone, Copy, Debug)]
pub enum StopReason {
    /// A step of the length that it had to have cannot be made.
    Step(IntegrationErrorKind),
    /// No step can be made, however short.
    AnyStep(IntegrationErrorKind),
    /// This number of steps was made: the limit that the user set, or one at which no end is in prospect.
    StepLimit {
        /// The limit.
        limit: u64,
        /// Whether there is no prospect of an end.
        hopeless: bool,
    },
}

/// State and step at which a run came to its end.
pub struct StopPlace<'a, S: GaussSystem> {
    /// The last state that it reached.
    pub state: &'a State<S>,
    /// The derivatives there.
    pub rates: &'a Rates<S>,
    /// The length of its steps, or of those that were tried.
    pub length: f64,
    /// The time that is left.
    pub left: f64,
    /// Whether the method passes over what decays fast.
    pub stiff: bool,
    /// The lanes that are to blame.
    pub lanes: Range<usize>,
}

/// Coordinates that are nearer to a singularity than this have to do with what fails there: velocities in them are ten
/// thousand times as large as those of the bodies, or change the coordinates by ten thousand times their size.
const NEAR_SINGULARITY: f64 = 1e-4;

/// So have those that are nearer than this and come to it within so many steps of the length that fails: where
/// coordinates become infinite, the iteration of an implicit step is not solved from two steps before on. Farther away
/// it is steps that are too long.
const AHEAD: (f64, f64) = (0.1, 4.0);

/// Speeds or momenta that are larger have run away, in whatever units.
const RUN_AWAY: f64 = 1e12;

/// Time constants of which no run is long enough to hold so many.
const OUT_OF_REACH: f64 = 1e10;

/// Finds the cause of the end of a run.
pub fn cause<S: GaussSystem, P: Problem<System = S>>(
    problem: &P,
    place: &StopPlace<'_, S>,
    gave: StopReason,
) -> IntegrationErrorKind {
    let &StopPlace { state, rates, length, left, stiff, ref lanes } = place;
    let (kind, lost, shrunk) = match gave {
        StopReason::Step(kind) => (kind, false, false),
        StopReason::AnyStep(kind) => (kind, false, true),
        StopReason::StepLimit { limit, hopeless } => (IntegrationErrorKind::TooManySteps { limit }, hopeless, false),
    };
    let undefined = matches!(kind, IntegrationErrorKind::NonFinite { part: RunPart::Step | RunPart::Derivative });
    let vanish = matches!(kind, IntegrationErrorKind::StepTooSmall { .. });
    let used_up = matches!(kind, IntegrationErrorKind::TooManySteps { .. });
    // What is undefined at once, and not because it grew, has another reason.
    let run_away = undefined && largest(&state.y, lanes) > RUN_AWAY;
    let unsolved =
        matches!(kind, IntegrationErrorKind::NotConverged { .. } | IntegrationErrorKind::IncrementTooLarge { .. });
    if (used_up || vanish || undefined || unsolved)
        && let Some(regularity) = near_singularity(problem.system(), place)
    {
        return IntegrationErrorKind::SingularChart { regularity };
    }
    if !(used_up || vanish || run_away || undefined && shrunk) {
        return kind;
    }
    if lost && problem.system().smoothness() == Smoothness::Jumps {
        return IntegrationErrorKind::StepTooSmall { step: length };
    }
    let moves = change(state, rates, lanes);
    let fastest = fastest(problem, (state, rates), lanes).unwrap_or(FastestMotion { rate: moves, decays: false });
    let rate = fastest.rate.max(moves);
    if !stiff && fastest.decays && fastest.rate * length > 1.0 && (run_away || moves * length < 0.05) {
        return IntegrationErrorKind::Stiff { rate: fastest.rate, step: length };
    }
    // Where the motion itself becomes infinite, its rate is as large as the time can be told.
    let ticks = rate * S::Scalar::EPSILON * state.t.lane(lanes.start).abs();
    let singular = (1e-3..1e3).contains(&ticks);
    let out_of_reach = rate * left > OUT_OF_REACH;
    // Steps that a larger limit would allow are no matter of the motion.
    if lost && out_of_reach || run_away && !stiff && rate * length > 2.0 || shrunk && !singular && out_of_reach {
        return IntegrationErrorKind::TooFast { rate, step: length };
    }
    kind
}

/// The regularity of the coordinates where they are at a singularity or come to one at once, in the worst of the lanes.
fn near_singularity<S: GaussSystem>(system: &S, place: &StopPlace<'_, S>) -> Option<f64> {
    let &StopPlace { state, rates, length, ref lanes, .. } = place;
    let part = Real::sqrt(S::Scalar::EPSILON);
    let soon = S::Scalar::from_f64(part * length);
    let here = system.regularity(state.t, &state.q);
    let change = system.regularity(state.t + soon, &state.q.retract(&rates.configuration.scale(soon))) - here;
    let near = |lane: &usize| {
        let (regularity, change) = (here.lane(*lane).abs(), change.lane(*lane).abs() / part);
        regularity < NEAR_SINGULARITY || regularity < AHEAD.0 && regularity < AHEAD.1 * change
    };
    lanes.clone().filter(near).map(|lane| here.lane(lane).abs()).reduce(f64::min)
}

/// The fastest of the motions near a state.
struct FastestMotion {
    /// |λ| of the largest eigenvalue of the derivatives by the state, per unit of time.
    rate: f64,
    /// Whether it is about real and negative.
    decays: bool,
}

/// Estimates the fastest rate by the power method, with differences in place of derivatives; none where these are
/// undefined.
fn fastest<S: GaussSystem, P: Problem<System = S>>(
    problem: &P,
    (state, rates): (&State<S>, &Rates<S>),
    lanes: &Range<usize>,
) -> Option<FastestMotion> {
    let sizes = sizes(state, lanes);
    let (norm, product) = (|v: &Rates<S>| norm(v, lanes), |a: &Rates<S>, b: &Rates<S>| product(a, b, lanes));
    // J v, with v in units of the sizes, and v small beside them.
    let times = |v: &Rates<S>| {
        let small = S::Scalar::from_f64(Real::sqrt(S::Scalar::EPSILON));
        let (v, sizes) = (scaled(v, &sizes, |v, size| v * size), &sizes);
        let near = problem.rates(&State {
            t: state.t,
            q: state.q.retract(&v.configuration.scale(small)),
            y: state.y.add_scaled(small, &v.variables),
        });
        let one = -S::Scalar::one();
        let change = Rates::<S> {
            configuration: near.configuration.add_scaled(one, &rates.configuration).scale(small.recip()),
            variables: near.variables.add_scaled(one, &rates.variables).scale(small.recip()),
        };
        scaled(&change, sizes, |change, size| change / size)
    };
    let mut v = start();
    for _ in 0..8 {
        let next = times(&v);
        v = scale(&next, 1.0 / norm(&next).filter(|size| *size > 0.0)?);
    }
    let once = times(&v);
    let twice = times(&scale(&once, 1.0 / norm(&once).filter(|size| *size > 0.0)?));
    let (first, second) = (norm(&once)?, norm(&twice)?);
    let along = product(&v, &once) / first;
    let back = product(&v, &twice) / second;
    let rate = Real::sqrt(first) * Real::sqrt(second);
    rate.is_finite().then_some(FastestMotion { rate, decays: along < -0.5 && back > 0.5 })
}

/// Rate of change of the state relative to its own size, per unit of time: the largest of the components.
pub fn change<S: GaussSystem>(state: &State<S>, rates: &Rates<S>, lanes: &Range<usize>) -> f64 {
    let relative = scaled(rates, &sizes(state, lanes), |rate, size| rate / size);
    largest(&relative.configuration, lanes).max(largest(&relative.variables, lanes))
}

/// The largest magnitude among the components of some lanes; NaN where there is one.
fn largest<T: Real, V: VectorSpace<T>>(vector: &V, lanes: &Range<usize>) -> f64 {
    let all = (0..V::DIM).flat_map(|i| lanes.clone().map(move |lane| vector.component(i).lane(lane).abs()));
    all.fold(0.0, worst)
}

/// The sizes of the components. A component that is less than a millionth of the others counts as a millionth of them.
fn sizes<S: GaussSystem>(state: &State<S>, lanes: &Range<usize>) -> Rates<S> {
    let mut sizes: Rates<S> = Rates { configuration: TangentOf::<S>::zero(), variables: S::Speeds::zero() };
    let of = |sizes: S::Scalar| lanes.clone().map(|lane| sizes.lane(lane).abs()).fold(0.0, f64::max);
    let fastest = largest(&state.y, lanes);
    let floor = |largest: f64| if largest > 0.0 { 1e-6 * largest } else { 1.0 };
    for i in 0..S::Speeds::DIM {
        let size = of(state.y.component(i));
        sizes.variables.set_component(i, S::Scalar::from_f64(size.max(floor(fastest))));
    }
    let of = |i: usize| of(state.q.magnitudes(i));
    let largest = (0..TangentOf::<S>::DIM).map(of).fold(0.0, f64::max);
    for i in 0..TangentOf::<S>::DIM {
        sizes.configuration.set_component(i, S::Scalar::from_f64(of(i).max(floor(largest))));
    }
    sizes
}

fn scaled<S: GaussSystem>(v: &Rates<S>, by: &Rates<S>, one: impl Fn(S::Scalar, S::Scalar) -> S::Scalar) -> Rates<S> {
    let mut result = *v;
    for i in 0..TangentOf::<S>::DIM {
        result.configuration.set_component(i, one(v.configuration.component(i), by.configuration.component(i)));
    }
    for i in 0..S::Speeds::DIM {
        result.variables.set_component(i, one(v.variables.component(i), by.variables.component(i)));
    }
    result
}

fn scale<S: GaussSystem>(v: &Rates<S>, by: f64) -> Rates<S> {
    let by = S::Scalar::from_f64(by);
    Rates { configuration: v.configuration.scale(by), variables: v.variables.scale(by) }
}

/// Unlike any eigenvector by its regularity.
fn start<S: GaussSystem>() -> Rates<S> {
    let mut v: Rates<S> = Rates { configuration: TangentOf::<S>::zero(), variables: S::Speeds::zero() };
    for i in 0..TangentOf::<S>::DIM {
        v.configuration.set_component(i, S::Scalar::ratio(1 + i as i64, 7 + 2 * i as i64));
    }
    for i in 0..S::Speeds::DIM {
        v.variables.set_component(i, S::Scalar::ratio(3 + 2 * i as i64, 5 + i as i64));
    }
    v
}

/// Over some lanes.
fn product<S: GaussSystem>(a: &Rates<S>, b: &Rates<S>, lanes: &Range<usize>) -> f64 {
    let dot = |a: S::Scalar, b: S::Scalar| -> f64 { lanes.clone().map(|lane| a.lane(lane) * b.lane(lane)).sum() };
    let of_q = (0..TangentOf::<S>::DIM).map(|i| dot(a.configuration.component(i), b.configuration.component(i)));
    let of_y = (0..S::Speeds::DIM).map(|i| dot(a.variables.component(i), b.variables.component(i)));
    of_q.chain(of_y).sum()
}

/// None where it is not finite.
fn norm<S: GaussSystem>(v: &Rates<S>, lanes: &Range<usize>) -> Option<f64> {
    let largest = worst(largest(&v.configuration, lanes), largest(&v.variables, lanes));
    if !(largest.is_finite() && largest > 0.0) {
        return largest.is_finite().then_some(0.0);
    }
    let v = scale(v, 1.0 / largest);
    Some(largest * Real::sqrt(product(&v, &v, lanes)))
}
