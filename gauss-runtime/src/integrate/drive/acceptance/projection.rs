//! States of a run kept on the constraints. Without constraints nothing here does anything, at compile time.
//!
//! A step ends off the constraints by its local error. While the constraints are independent, the nearest state on them
//! is no farther from the solution than about twice that. So projecting after every accepted step keeps the order of
//! the method and nothing accumulates (Hairer, Lubich & Wanner, *Geometric Numerical Integration*, IV.4). Error
//! estimates are those of the step before it is projected.
//!
//! Where constraints become dependent on one another (a singular position of a mechanism) that fails: with a least
//! singular value σ of the Jacobian, an error e of the positions turns the admissible velocities by e/σ, and near the
//! singularity the nearest state may be on another branch of the motion. The projection in the metric of the kinetic
//! energy then takes away whatever it finds across, up to all of it. So what the projection moves is an error of the
//! step like others, and bounded: by half of the way that the step makes, and for a tolerance by
//! a multiple of it ([`check_move`]). A step that is moved farther is rejected: a shorter one has a smaller error, or
//! ends elsewhere. Where none will do, the run ends. Adaptive steps keep away from such places, and lead over them from
//! one side to the other ([`clear_part`]).

use core::ops::Range;

use crate::configuration::{Configuration, VectorSpace};
use crate::constraint::ConstraintLevel;
use crate::integrate::drive::tolerance::{PATTERNS, Tolerance, Trial, larger, rounded};
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::error::{IntegrationErrorKind, RunPart};
use crate::integrate::problem::state::{Rates, Sample, State, TangentOf};
use crate::integrate::step::checks::is_in_range;
use crate::real::Real;
use crate::system::GaussSystem;

/// The projection onto the constraints may move the end of a step by so many tolerances. The computed end is within one
/// of them of the true one, and so is what is nearest to it on independent constraints. But "nearest" is measured by
/// the kinetic energy: a light body on a short lever moves farther than the heavy one whose error it takes up. Ordinary
/// scenes are moved by a hundredth of a tolerance and less, because estimates are those of a method of lower order.
const PROJECTED: f64 = 10.0;

/// The part of a step that is to be left between its end and a place where constraints become dependent.
const CLEARANCE: f64 = 0.4;

/// A step that was rejected so often may end beside such a place.
pub const AVOIDED: u32 = 4;

/// Brings the end of an accepted step, of which the start is given with the derivatives there, onto the constraints,
/// where there are any, and gives the derivatives at the end; refuses speeds whose squares overflow. Derivatives that
/// came with the step belong to its end before it was projected, and serve without constraints only.
///
/// # Errors
/// When speeds or derivatives are not finite, or the projection fails or moves the state too far.
#[inline(always)]
pub fn accept<S: GaussSystem, P: Problem<System = S>>(
    problem: &P,
    from: (&State<S>, &Rates<S>),
    state: &mut State<S>,
    known: Option<Rates<S>>,
) -> Result<Rates<S>, IntegrationErrorKind> {
    if !is_in_range(&state.y) {
        return Err(IntegrationErrorKind::NonFinite { part: RunPart::Step });
    }
    if S::CONSTRAINED {
        *state = onto_constraints(problem, from, state)?;
    } else if let Some(rates) = known {
        return Ok(rates);
    }
    let rates = problem.rates(state);
    if rates.is_finite() { Ok(rates) } else { Err(IntegrationErrorKind::NonFinite { part: RunPart::Step }) }
}

/// The end of a step of a constrained system brought onto its constraints, and not farther than half of the way of the
/// step.
///
/// The true motion ends on the constraints. If it is farther from there to the computed end than half of what the step
/// changes, then so is the error of the step: not one binary digit of the change is right. The way is what the step
/// changes, or what the derivatives at its start do where that is more: a motion that turns back changes nothing. Half
/// of the digits of the state itself are allowed as they are to an initial state ([`consistent_start`]): at rest
/// nothing changes but by rounding.
pub(in crate::integrate) fn onto_constraints<S: GaussSystem, P: Problem<System = S>>(
    problem: &P,
    (from, rates): (&State<S>, &Rates<S>),
    end: &State<S>,
) -> Result<State<S>, IntegrationErrorKind> {
    let projected = on_constraints(problem, end)?;
    let (moved, changed) = (difference(end, &projected), difference(from, end));
    for lane in 0..S::Scalar::LANES {
        let h = (end.t - from.t).lane(lane).abs();
        let way = |changed: f64, rate: f64| 0.5 * changed.max(h * rate);
        let of_q = way(largest(&changed.configuration, lane), largest(&rates.configuration, lane));
        let of_y = way(largest(&changed.variables, lane), largest(&rates.variables, lane));
        let of_q = of_q + half_of_the_digits::<S>(size_of_configuration::<S>(&end.q, lane));
        let of_y = of_y + half_of_the_digits::<S>(largest(&end.y, lane));
        for (level, distance, allowed) in [
            (ConstraintLevel::Position, largest(&moved.configuration, lane), of_q),
            (ConstraintLevel::Velocity, largest(&moved.variables, lane), of_y),
        ] {
            if distance > allowed {
                return Err(IntegrationErrorKind::ProjectionTooFar { level, distance, allowed });
            }
        }
    }
    Ok(projected)
}

/// Refuses a step that the projection onto the constraints moves by more than ten tolerances. `trial`, in the variables
/// of the form, ends where the state is moved to, `computed` is where it was before. What the projection makes of a
/// rounding at the start of the step cannot be told from its rounding at the end, up to half of the digits. Gives the
/// move, in speeds.
///
/// # Errors
/// [`IntegrationErrorKind::ProjectionTooFar`].
#[inline(always)]
pub fn check_move<S: GaussSystem, P: Problem<System = S>>(
    tolerance: &Tolerance,
    problem: &P,
    trial: &Trial<'_, S>,
    computed: &State<S>,
) -> Result<Rates<S>, IntegrationErrorKind> {
    let seen = [trial.from, trial.to, computed].map(|state| problem.in_speeds(state));
    let moved = difference(&seen[2], &seen[1]);
    let measured = Trial { from: &seen[0], to: &seen[1], ..*trial };
    if tolerance.error(&measured, &moved, None) <= PROJECTED {
        Ok(moved)
    } else {
        check_above_rounding(tolerance, &rounding_of_projection(problem, trial.from), &measured, &moved).map(|()| moved)
    }
}

/// The part of a step to try in place of all of it, in one lane, where it ends beside a place at which constraints
/// become dependent.
///
/// The motion goes through such a place on the branch by which it comes. But an error of the constraints, be it a
/// rounding, makes another motion of it there: from a distance δ a step of length h and order p makes (h/δ)^p of it. So
/// a step is to lead over the place from about as far before it as behind it, and the one before ends half of a step
/// before it. [`dependence`](GaussSystem::dependence) tells distances; it is asked where the projection changes
/// velocities by more than twice places over the time of the step: next to such a place they turn by 1/δ of what
/// places move.
#[inline(always)]
pub fn clear_part<S: GaussSystem, P: Problem<System = S>>(
    problem: &P,
    trial: &Trial<'_, S>,
    moved: &Rates<S>,
    lane: usize,
) -> Option<f64> {
    let turned = largest(&moved.variables, lane) * trial.length.lane(lane);
    let turns = turned > 2.0 * largest(&moved.configuration, lane);
    turns.then(|| part_before(problem, trial, lane)).flatten()
}

#[cold]
#[inline(never)]
fn part_before<S: GaussSystem, P: Problem<System = S>>(problem: &P, trial: &Trial<'_, S>, lane: usize) -> Option<f64> {
    let [before, after] = [trial.from, trial.to].map(|state| {
        let State { t, q, y } = problem.in_speeds(state);
        problem.system().dependence(t, &q, &y)
    });
    let along = (0..S::Speeds::DIM).map(|i| (before.component(i) * after.component(i)).lane(lane)).sum::<f64>();
    // From the start, and from the end: negative behind the place.
    let (near, far) = (1.0 / largest(&before, lane), (1.0 / largest(&after, lane)).copysign(along));
    let place = near / (near - far);
    // Where the place is ahead, in steps.
    ((1.0 - CLEARANCE..1.0 + CLEARANCE).contains(&place)).then_some(place - 0.5)
}

#[cold]
#[inline(never)]
fn check_above_rounding<S: GaussSystem>(
    tolerance: &Tolerance,
    rounding: &Rates<S>,
    trial: &Trial<'_, S>,
    moved: &Rates<S>,
) -> Result<(), IntegrationErrorKind> {
    let half = S::Scalar::from_f64(Real::sqrt(S::Scalar::EPSILON));
    let allowed = |tolerance: S::Scalar, rounding: S::Scalar, size: S::Scalar| {
        let rounding = S::Scalar::select_lt(rounding, half * size, rounding, half * size);
        S::Scalar::from_f64(PROJECTED) * larger(tolerance, rounding)
    };
    let mut worst = (1.0, Ok(()));
    let mut see = |level, moved: S::Scalar, allowed: S::Scalar| {
        for lane in 0..S::Scalar::LANES {
            let (distance, allowed) = (moved.lane(lane).abs(), allowed.lane(lane));
            if distance > worst.0 * allowed {
                let error = IntegrationErrorKind::ProjectionTooFar { level, distance, allowed };
                worst = (distance / allowed, Err(error));
            }
        }
    };
    for i in 0..TangentOf::<S>::DIM {
        let rounding = rounding.configuration.component(i);
        let allowed = allowed(tolerance.of_configuration(trial, i), rounding, trial.to.q.magnitudes(i));
        see(ConstraintLevel::Position, moved.configuration.component(i), allowed);
    }
    for i in 0..S::Speeds::DIM {
        let rounding = rounding.variables.component(i);
        let allowed = allowed(tolerance.of_variables(trial, i), rounding, trial.to.y.component(i).abs());
        see(ConstraintLevel::Velocity, moved.variables.component(i), allowed);
    }
    worst.1
}

/// The state after a jump, on the constraints where there are any. The nearest velocities, as the kinetic energy
/// measures them, are those after an impact.
pub(in crate::integrate) fn consistent<S: GaussSystem, P: Problem<System = S>>(
    problem: &P,
    (given, set): (&Sample<S>, &Sample<S>),
    lanes: &Range<usize>,
) -> Result<(S::Configuration, S::Speeds), IntegrationErrorKind> {
    let Sample { t, q, z, .. } = *set;
    if !(q.is_finite() && z.is_finite()) {
        return Err(IntegrationErrorKind::NonFinite { part: RunPart::Jump });
    }
    if !S::CONSTRAINED {
        return Ok((q.renormalise(), z));
    }
    let projected = problem.system().project(t, &q, &z).map_err(|error| IntegrationErrorKind::Projection { error })?;
    check_jump(problem.system(), given, set, (&projected, lanes))?;
    Ok(projected)
}

/// Refuses what the projection makes of a jump where that is farther from the state that was set than the jump itself
/// goes.
///
/// The state before is on the constraints of that time. So the nearest one to what was set is no farther from it than
/// the jump: as the kinetic energy measures it, and by largest components within [`PROJECTED`]. Where the configuration
/// stays, velocities are projected onto one linear space, and the kinetic energy of what that takes away is no more
/// than that of the jump. Else it is all rounding of constraints that depend on one another.
fn check_jump<S: GaussSystem>(
    system: &S,
    before: &Sample<S>,
    set: &Sample<S>,
    ((q, z), lanes): (&(S::Configuration, S::Speeds), &Range<usize>),
) -> Result<(), IntegrationErrorKind> {
    let minus = -S::Scalar::one();
    let (jumped, moved) = (before.q.difference(&set.q), set.q.difference(q));
    // Twice the kinetic energy of a difference of velocities, lane by lane.
    let energy = |from: &S::Speeds, to: &S::Speeds, lane: usize| {
        let speeds = to.add_scaled(minus, from);
        let momenta = system.momentum(set.t, q, to).add_scaled(minus, &system.momentum(set.t, q, from));
        (0..S::Speeds::DIM).map(|i| (speeds.component(i) * momenta.component(i)).lane(lane)).sum::<f64>()
    };
    for lane in lanes.clone() {
        let (far, distance) = (largest(&jumped, lane), largest(&moved, lane));
        let allowed = PROJECTED * far + half_of_the_digits::<S>(size_of_configuration::<S>(&set.q, lane));
        if distance > allowed {
            return Err(IntegrationErrorKind::ProjectionTooFar { level: ConstraintLevel::Position, distance, allowed });
        }
        let (taken, given) = (energy(&set.z, z, lane), energy(&before.z, &set.z, lane));
        let [taken, given, all] =
            [taken, given, energy(&S::Speeds::zero(), &set.z, lane)].map(|e: f64| Real::sqrt(e.max(0.0)));
        let allowed = given + half_of_the_digits::<S>(all);
        if far == 0.0 && taken > allowed {
            let distance = largest(&z.add_scaled(minus, &set.z), lane);
            let allowed = distance * (allowed / taken);
            return Err(IntegrationErrorKind::ProjectionTooFar { level: ConstraintLevel::Velocity, distance, allowed });
        }
    }
    Ok(())
}

/// After this many trials of a step that the projection moved too far, the start of the step is examined: its
/// constraints may have become dependent.
const TRIALS: u32 = 4;

/// Whether a step that the projection moved too far, so many times shortened, starts next to a position where the
/// constraints are dependent, so that steps would only shrink towards it.
///
/// With a least singular value σ the projection makes ε/σ of a rounding, and admissible velocities at positions that
/// are known to that turn by ε/σ²: half of the digits are lost where the projection makes ε^¾ of ε.
#[cold]
pub fn is_hopeless<S: GaussSystem, P: Problem<System = S>>(
    problem: &P,
    state: &State<S>,
    lanes: Range<usize>,
    (kind, rejected): (&IntegrationErrorKind, u32),
) -> bool {
    if rejected < TRIALS || !matches!(kind, IntegrationErrorKind::ProjectionTooFar { .. }) {
        return false;
    }
    let (rounding, speeds) = (rounding_of_projection(problem, state), problem.in_speeds(state).y);
    let digits = Real::sqrt(Real::sqrt(S::Scalar::EPSILON));
    let lost = digits * digits * digits;
    lanes.into_iter().any(|lane| {
        largest(&rounding.variables, lane) > lost * largest(&speeds, lane)
            || largest(&rounding.configuration, lane) > lost * size_of_configuration::<S>(&state.q, lane)
    })
}

/// The change of the projection by a rounding of the state, component by component of q and z.
fn rounding_of_projection<S: GaussSystem, P: Problem<System = S>>(problem: &P, state: &State<S>) -> Rates<S> {
    let mut rounding: Rates<S> = Rates { configuration: TangentOf::<S>::zero(), variables: S::Speeds::zero() };
    let here = problem.in_speeds(state);
    for pattern in PATTERNS {
        let Ok(near) = on_constraints(problem, &rounded(state, pattern).0) else { continue };
        let moved = difference(&here, &problem.in_speeds(&near));
        let more = |moved: S::Scalar, known: S::Scalar| larger(moved.abs(), known);
        for i in 0..TangentOf::<S>::DIM {
            let most = more(moved.configuration.component(i), rounding.configuration.component(i));
            rounding.configuration.set_component(i, most);
        }
        for i in 0..S::Speeds::DIM {
            let most = more(moved.variables.component(i), rounding.variables.component(i));
            rounding.variables.set_component(i, most);
        }
    }
    rounding
}

/// From one state to another of the same time.
fn difference<S: GaussSystem>(from: &State<S>, to: &State<S>) -> Rates<S> {
    Rates { configuration: from.q.difference(&to.q), variables: to.y.add_scaled(-S::Scalar::one(), &from.y) }
}

/// The largest magnitude among the components, in one lane.
fn largest<T: Real, V: VectorSpace<T>>(vector: &V, lane: usize) -> f64 {
    (0..V::DIM).map(|i| vector.component(i).lane(lane).abs()).fold(0.0, f64::max)
}

/// The largest component of the configuration, in one lane.
fn size_of_configuration<S: GaussSystem>(q: &S::Configuration, lane: usize) -> f64 {
    (0..TangentOf::<S>::DIM).map(|i| q.magnitudes(i).lane(lane)).fold(0.0, f64::max)
}

/// √ε of a size, and in addition 64 ε for numbers of order 1 that cancel where the state itself is zero.
fn half_of_the_digits<S: GaussSystem>(size: f64) -> f64 {
    Real::sqrt(S::Scalar::EPSILON) * size + 64.0 * S::Scalar::EPSILON
}

/// The state of a constrained system brought onto its constraints.
pub(in crate::integrate) fn on_constraints<S: GaussSystem, P: Problem<System = S>>(
    problem: &P,
    state: &State<S>,
) -> Result<State<S>, IntegrationErrorKind> {
    let (system, State { t, q, y }) = (problem.system(), *state);
    let z = problem.speeds(t, &q, &y);
    let (q, z) = system.project(t, &q, &z).map_err(|error| IntegrationErrorKind::Projection { error })?;
    Ok(State { t, q, y: problem.variables(t, &q, &z) })
}

/// The initial state projected onto the constraints, which removes the rounding of the given numbers; an error when the
/// state violates the constraints by more than that.
///
/// The bound is √ε of the largest component of the configuration, of z respectively: a state that agrees with the
/// constraints in half of the digits was meant to satisfy them. With less than half of the digits the projected state
/// would be another one than the user gave.
#[inline(always)]
pub(in crate::integrate) fn consistent_start<S: GaussSystem, P: Problem<System = S>>(
    problem: &P,
    start: &State<S>,
) -> Result<State<S>, IntegrationErrorKind> {
    if !S::CONSTRAINED {
        return Ok(*start);
    }
    let projected = on_constraints(problem, start)?;
    let speeds = |state: &State<S>| problem.speeds(state.t, &state.q, &state.y);
    let (given, nearest) = (speeds(start), speeds(&projected));
    let increment = start.q.difference(&projected.q);
    let size = (0..TangentOf::<S>::DIM).map(|i| start.q.magnitude(i)).fold(0.0, f64::max);
    for (level, distance, size) in [
        (ConstraintLevel::Position, increment.max_norm(), size),
        (ConstraintLevel::Velocity, nearest.add_scaled(-S::Scalar::one(), &given).max_norm(), given.max_norm()),
    ] {
        if distance > half_of_the_digits::<S>(size) {
            return Err(IntegrationErrorKind::InconsistentStart { level, distance });
        }
    }
    Ok(projected)
}

#[cfg(all(test, feature = "alloc"))]
#[path = "projection_tests.rs"]
mod tests;
