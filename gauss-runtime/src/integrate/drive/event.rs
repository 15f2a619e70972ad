//! Events: where a function of the state passes through zero during a run.
//!
//! After every step the signs of the functions at its two ends are compared. Where they differ, the length of the step is
//! varied until it ends at the zero: what is found is a state that the method itself reaches from the last one, as accurate
//! as the run, and not a point of an interpolant. The search is Chandrupatla's (1997): inverse quadratic interpolation where
//! that is safe, bisection else, with the zero always in brackets; a jump through zero is found as well.
//!
//! **What is not seen.** A function that has the same sign at both ends of a step has no event there: two zeros within one
//! step, and a zero that is touched without being crossed, pass unnoticed (unless a step happens to end on it). Bound the steps
//! where that matters ([`Simulation::largest_step`](crate::integrate::Simulation::largest_step)), or watch the derivative instead: a
//! function grazes zero where its derivative passes through it.

use core::ops::ControlFlow;

use crate::integrate::drive::control::Control;
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::error::{IntegrationErrorKind, Part};
use crate::integrate::problem::state::{Rates, State};
use crate::real::Real;
use crate::system::GaussSystem;

/// Which passages through zero are events, in the order of integration: a run backwards meets a function that grows with time
/// as falling.
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
    /// A value of zero before is none: what starts on zero has left it, or is there by an event that was seen.
    fn between(self, before: f64, after: f64) -> bool {
        let rising = before < 0.0 && after >= 0.0;
        let falling = before > 0.0 && after <= 0.0;
        match self {
            Self::Rising => rising,
            Self::Falling => falling,
            Self::Any => rising || falling,
        }
    }
}

/// What is remembered of one event from step to step.
#[derive(Clone, Copy, Debug)]
pub struct Mark {
    crossing: Crossing,
    terminal: bool,
    value: f64,
    /// The part of the present step at whose end the event is, when it has one that is not reported yet.
    part: Option<f64>,
}

/// A function of time, configuration and quasi-velocities.
type Function<'a, S> = &'a dyn Fn(
    <S as GaussSystem>::Scalar,
    &<S as GaussSystem>::Configuration,
    &<S as GaussSystem>::Speeds,
) -> <S as GaussSystem>::Scalar;

/// The events of a run, in the order in which they were asked for.
pub trait Events<S: GaussSystem> {
    /// Their number.
    const COUNT: usize;

    /// Shows every one.
    fn each(&mut self, visit: &mut dyn FnMut(Function<'_, S>, &mut Mark));
}

/// None.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoEvents;

impl<S: GaussSystem> Events<S> for NoEvents {
    const COUNT: usize = 0;

    fn each(&mut self, _: &mut dyn FnMut(Function<'_, S>, &mut Mark)) {}
}

/// One event after others.
#[derive(Clone, Copy, Debug)]
pub struct Watched<E, G> {
    others: E,
    function: G,
    mark: Mark,
}

impl<E, G> Watched<E, G> {
    pub(in crate::integrate) fn after(others: E, crossing: Crossing, terminal: bool, function: G) -> Self {
        Self { others, function, mark: Mark { crossing, terminal, value: 0.0, part: None } }
    }
}

impl<S, E, G> Events<S> for Watched<E, G>
where
    S: GaussSystem,
    E: Events<S>,
    G: Fn(S::Scalar, &S::Configuration, &S::Speeds) -> S::Scalar,
{
    const COUNT: usize = E::COUNT + 1;

    fn each(&mut self, visit: &mut dyn FnMut(Function<'_, S>, &mut Mark)) {
        self.others.each(visit);
        visit(&self.function, &mut self.mark);
    }
}

/// Looks for events at the start of a run and within its steps.
pub(in crate::integrate) struct Watch<'a, P, C, E> {
    pub(in crate::integrate) control: &'a C,
    pub(in crate::integrate) problem: &'a P,
    pub(in crate::integrate) events: E,
}

impl<S, P, C, E> Watch<'_, P, C, E>
where
    S: GaussSystem,
    P: Problem<System = S>,
    C: Control<S>,
    E: Events<S>,
{
    /// Takes the values at the start.
    pub(in crate::integrate) fn begin(&mut self, start: &State<S>) -> Result<(), IntegrationErrorKind> {
        let problem = self.problem;
        let mut outcome = Ok(());
        self.events.each(&mut |function, mark| match value(problem, function, start) {
            Ok(value) => mark.value = value,
            Err(kind) => outcome = Err(kind),
        });
        outcome
    }

    /// Reports the events of a step, with their numbers, in the order in which they happen. Breaks with the state at which
    /// the run is to end.
    pub(in crate::integrate) fn step(
        &mut self,
        before: &State<S>,
        rates: &Rates<S>,
        after: &State<S>,
        report: &mut dyn FnMut(usize, &State<S>),
    ) -> Result<ControlFlow<State<S>>, IntegrationErrorKind> {
        let (control, problem) = (self.control, self.problem);
        let reach = |part: f64| {
            // The end of the step itself is that of the run, whose time is not the sum of lengths.
            if part >= 1.0 {
                return Ok(*after);
            }
            let h = (after.t - before.t) * S::Scalar::from_f64(part);
            control.within(problem, before, rates, h)
        };
        let mut outcome = Ok(());
        self.events.each(&mut |function, mark| {
            let found = value(problem, function, after).and_then(|value_after| {
                if mark.crossing.between(mark.value, value_after) {
                    let along = |part: f64| value(problem, function, &reach(part)?);
                    mark.part = Some(locate(along, mark.value, value_after, resolution(before, after))?);
                }
                Ok(value_after)
            });
            match found {
                Ok(value) => mark.value = value,
                Err(kind) => outcome = Err(kind),
            }
        });
        outcome?;

        let (mut last, mut stop) = (f64::INFINITY, None);
        while let Some((number, part, terminal)) = self.take_earliest() {
            // Others at the very end of the run are told of, later ones are not.
            if part > last {
                break;
            }
            let state = reach(part)?;
            report(number, &state);
            if terminal {
                (last, stop) = (part, Some(state));
            }
        }
        Ok(stop.map_or(ControlFlow::Continue(()), ControlFlow::Break))
    }

    /// The number of the event that was found earliest in the step, where that is, and whether it ends the run; it is then no
    /// longer to be reported.
    fn take_earliest(&mut self) -> Option<(usize, f64, bool)> {
        let mut first: Option<(usize, f64, bool)> = None;
        let mut number = 0;
        self.events.each(&mut |_, mark| {
            if let Some(part) = mark.part
                && first.is_none_or(|(_, earliest, _)| part < earliest)
            {
                first = Some((number, part, mark.terminal));
            }
            number += 1;
        });
        let mut n = 0;
        self.events.each(&mut |_, mark| {
            if first.is_some_and(|(number, ..)| number == n) {
                mark.part = None;
            }
            n += 1;
        });
        first
    }
}

/// The first lane of an event's function.
fn value<S: GaussSystem, P: Problem<System = S>>(
    problem: &P,
    function: Function<'_, S>,
    state: &State<S>,
) -> Result<f64, IntegrationErrorKind> {
    let z = problem.speeds(state.t, &state.q, &state.y);
    let value = function(state.t, &state.q, &z).lane(0);
    if value.is_finite() { Ok(value) } else { Err(IntegrationErrorKind::NonFinite { part: Part::Event }) }
}

/// The part of a step that changes its end by four roundings of the time, at least of the step itself.
fn resolution<S: GaussSystem>(before: &State<S>, after: &State<S>) -> f64 {
    let (from, to) = (before.t.lane(0), after.t.lane(0));
    let unit = S::Scalar::EPSILON.max(f64::EPSILON);
    4.0 * unit * (from.abs().max(to.abs()) / (to - from).abs()).max(1.0)
}

/// The zero of a function on [0, 1] with values of different signs, or zero, at the ends: to a distance of `resolution`, on the
/// side that has the sign of `at_one`. Chandrupatla, *A new hybrid quadratic/bisection algorithm for finding the zero of a
/// nonlinear function without using derivatives*, Advances in Engineering Software 28 (1997).
fn locate(
    mut function: impl FnMut(f64) -> Result<f64, IntegrationErrorKind>,
    at_zero: f64,
    at_one: f64,
    resolution: f64,
) -> Result<f64, IntegrationErrorKind> {
    // The zero is between a, the newest point, and b; c is the point before.
    let (mut a, mut at_a, mut b, mut at_b) = (1.0, at_one, 0.0, at_zero);
    let mut fraction = 0.5;
    let mut trials = 0;
    while at_a != 0.0 && (b - a).abs() > resolution {
        trials += 1;
        let x = a + fraction * (b - a);
        let at_x = function(x)?;
        let (c, at_c);
        if (at_x > 0.0) == (at_a > 0.0) && at_x != 0.0 {
            (c, at_c) = (a, at_a);
        } else {
            (c, at_c) = (b, at_b);
            (b, at_b) = (a, at_a);
        }
        (a, at_a) = (x, at_x);
        // Interpolate where the three points lie so that the inverse quadratic is monotone, else halve. A function that
        // is at odds with every interpolation is halved from the fiftieth trial on, which ends it.
        let (xi, phi) = ((a - b) / (c - b), (at_a - at_b) / (at_c - at_b));
        fraction = if trials < 50 && phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi {
            at_a / (at_b - at_a) * at_c / (at_b - at_c)
                + (c - a) / (b - a) * at_a / (at_c - at_a) * at_b / (at_c - at_b)
        } else {
            0.5
        };
        // Not so near to an end of the bracket that it could not shrink to the resolution from there.
        let margin = (0.5 * resolution / (b - a).abs()).min(0.5);
        fraction = fraction.max(margin).min(1.0 - margin);
    }
    let beyond = at_a == 0.0 || (at_a > 0.0) == (at_one > 0.0) && at_one != 0.0;
    Ok(if beyond { a } else { b })
}

#[cfg(all(test, feature = "alloc"))]
#[path = "event_tests.rs"]
mod tests;
