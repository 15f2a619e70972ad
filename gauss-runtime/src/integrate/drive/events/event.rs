//! Events: where a function of the state passes through zero during a run, and jumps of the state there.
//!
//! **What is an event.** A function passes from one side of zero to zero or to the other side, in the chosen direction
//! ([`Crossing`](crate::integrate::Crossing)), in the order of integration.
//!
//! - *A zero at the start* is none: what starts on zero is on the side to which it leaves zero at first, and passes
//!   when it comes back. So a run goes on from where another one ended.
//! - *A touch* without passing is none; where rounding decides, it is two passages or none. A function grazes zero
//!   where its derivative passes through it: watch that.
//! - *A jump* of the function over zero is one. *A pole*, where it passes from one side to the other by way of
//!   infinity, is none.
//! - A function that is undefined (NaN) ends the run.
//!
//! **How they are found.** After every step the function is looked at between its ends as well: on the cubic through
//! the states and derivatives there, or on the series of Taylor's method. So passages there and back within one step
//! are seen, as long as that curve shows them; what is faster than the steps is not, and where that matters steps are
//! to be bounded ([`Simulation::largest_step`](crate::integrate::Simulation::largest_step)). Then the length of the
//! step is varied until it ends at the zero: what is found is a state that the method itself reaches from the last one,
//! as accurate as the run, and not a point of the curve.
//!
//! **Jumps.** [`Simulation::then`](crate::integrate::Simulation::then) changes the state at an event, and the run goes
//! on from there: a jump of velocities, as at an impact, or of the configuration. After the jump the function is zero
//! up to rounding, so its sign means nothing; the function counts as being on the side to which the motion leads, even
//! where the flight is much shorter than the step. So a ball that bounces has not fallen through the floor.
//!
//! - *A jump has to lead back.* Where a function of the configuration goes on through zero, the run ends with
//!   [`IntegrationErrorKind::NotTurnedBack`]: the velocity that was turned is not the one along which the function
//!   changes. `u` and `ω` of a body are in its own axes, and `z[2] *= -0.8` turns the velocity along the body's third
//!   axis. Where it is meant to go on, as at a gate that kicks or a place where something else jumps, write
//!   [`then_through`](crate::integrate::Simulation::then_through). Functions of time and speeds alone pass, and so does
//!   what changes no state, but a switch of the user's.
//! - *A jump to rest.* Where the function does not leave zero again but for what pulls it on (no restitution, and
//!   weight), or leaves it by less than rounding, the run ends with [`IntegrationErrorKind::Zeno`].
//! - *Infinitely many jumps* (a ball that bounces ever lower) pile up at one time. The run ends with `Zeno` as soon as
//!   the next flight is not higher than some roundings of the numbers that the function depends on, or shorter than
//!   what times are told apart by. For a ball at 1 m that is 10⁻¹⁴ m, some 10⁻⁷ s before the time of the last impact.
//! - *A great many jumps* (a ball that keeps nearly all of its speed, low above the floor) may use up the steps of a
//!   run before they pile up: it ends with `TooManyJumps`, above the floor.
//! - *Over other zeros.* Where a jump itself leads over the zero of another event, that one happens at once, in the
//!   state after the jump. Events whose zeros are the same, to the resolution of the time, happen at one time, in their
//!   order.
//!
//! **Derivatives.** Where numbers carry derivatives ([`Real::DERIVATIVES`]), the time of an event does too: values of
//! dual numbers find it as those of `f64` do, then Newton's method in the numbers themselves moves the state along the
//! motion to where the function is zero with all of its derivatives. A jump, and the run behind it, go on from there:
//! derivatives of the end are those of the run through its events (saltation). A function that touches zero, or jumps
//! over it, has no such time: the run ends with [`IntegrationErrorKind::NoDerivative`]. Events at one time are moved
//! one after the other, in their order; where they act on one another the derivative is one-sided, that of this order.
//!
//! What a jump sets is `q`, and `z` or `p`. Time goes on: a jump that sets it ends the run with
//! [`IntegrationErrorKind::InvalidJump`], and so does one that sets both `z` and `p` where they disagree.

use core::ops::Range;

use crate::configuration::{Configuration, VectorSpace};
use crate::integrate::drive::bounded::Bound;
use crate::integrate::drive::control::Control;
use crate::integrate::drive::departure::{Departure, RestAtZero};
pub use crate::integrate::drive::departure::{is_of_the_configuration, rounding};
use crate::integrate::drive::jump::differs;
pub use crate::integrate::drive::jump::{Jump, JumpFunction, NoJump};
use crate::integrate::drive::projection::consistent;
use crate::integrate::drive::search::{Function, StepEnds, StepSearch, side, value};
use crate::integrate::drive::watched::JumpApproach;
pub use crate::integrate::drive::watched::{Events, Mark, NoEvents, Watched};
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::error::{IntegrationErrorKind, JumpMistake};
use crate::integrate::problem::state::{Sample, State, TangentOf};
use crate::real::Real;
use crate::system::GaussSystem;

/// Outcome of the events of a step.
pub enum Outcome<S: GaussSystem> {
    /// The step stands as it is.
    On,
    /// The run ends within the step or goes on from there in another state.
    Here {
        /// The state at the event.
        state: State<S>,
        /// The state after the jump.
        after: Option<State<S>>,
        /// The event that made it jump, or ended the run.
        number: usize,
        /// The event that ended the run.
        stopped_by: Option<usize>,
    },
}

/// Cut of a run: the state, the state after the jump, the first event there, and the one that ends the run.
type EventCut<S> = (State<S>, Option<State<S>>, usize, Option<usize>);

impl Mark {
    /// The first event of the step.
    fn first<S: GaussSystem, P: Problem<System = S>, C: Control<S>>(
        &mut self,
        looking: &StepSearch<'_, S, P, C>,
        (function, bound): (Function<'_, S>, Bound<'_, S>),
        number: usize,
    ) -> Result<Option<(f64, f64)>, IntegrationErrorKind> {
        let StepEnds { lane, before: (state, _), .. } = *looking.made;
        if self.value == 0.0 && self.resting.is_none() {
            self.resting = Some(RestAtZero::exactly(rounding(looking.problem, function, lane, state)));
        }
        let leaving = match &self.resting {
            None => Departure::known(self.value),
            Some(on) => {
                let Some(leaving) = looking.leaves(function, on)? else { return Ok(None) };
                looking.led_back(function, number, (on, &leaving))?;
                leaving
            }
        };
        (self.resting, self.value) = (None, leaving.from.1);
        looking.first_of((function, bound), self.crossing, (leaving.from, leaving.until))
    }

    /// The next event of the step behind the one that was found.
    fn following<S: GaussSystem, P: Problem<System = S>, C: Control<S>>(
        &mut self,
        looking: &StepSearch<'_, S, P, C>,
        (function, bound): (Function<'_, S>, Bound<'_, S>),
    ) -> Result<Option<(f64, f64)>, IntegrationErrorKind> {
        let Some(from) = self.next else { return Ok(None) };
        let Some(leaving) = looking.going_on(function, from)? else { return Ok(None) };
        self.value = leaving.from.1;
        looking.first_of((function, bound), self.crossing, (leaving.from, leaving.until))
    }

    /// Takes the value at the start of a run, or where it goes on after a jump.
    fn begin<S: GaussSystem, P: Problem<System = S>>(
        &mut self,
        (problem, lane): (&P, usize),
        function: Function<'_, S>,
        start: &State<S>,
    ) -> Result<(), IntegrationErrorKind> {
        let value = value(problem, function, lane, start)?;
        let (passed, jumped) = (core::mem::take(&mut self.passed), core::mem::take(&mut self.jumped));
        self.resting = self.cut.take().and_then(|cut| {
            let rounding = rounding(problem, function, lane, start);
            let back = (jumped && !self.through).then_some((cut.side, cut.rate));
            // Else the jump has led away from zero.
            (value.abs() <= rounding + cut.beyond).then(|| RestAtZero::after(value, rounding, back))
        });
        // Of another event, that is to come at this very time.
        let to_come = value == 0.0 && self.value != 0.0 && !passed && !core::mem::take(&mut self.here);
        self.value = if to_come { side(self.value) } else { value };
        Ok(())
    }
}

/// Looks for events at the start of a run and within its steps.
pub struct Watch<'a, P, C, E> {
    control: &'a C,
    problem: &'a P,
    events: E,
    /// The numbers of a pack that belong to the run; events are of the first.
    lanes: Range<usize>,
}

impl<'a, S, P, C, E> Watch<'a, P, C, E>
where
    S: GaussSystem,
    P: Problem<System = S>,
    C: Control<S>,
    E: Events<S>,
{
    /// Events of a run in some of the numbers of a pack.
    pub fn new(control: &'a C, problem: &'a P, events: E, lanes: Range<usize>) -> Self {
        Self { control, problem, events, lanes }
    }

    /// The events, with the controllers that sample.
    pub fn events(&mut self) -> &mut E {
        &mut self.events
    }

    /// Does something with every event, by its number, until it fails.
    fn each(
        &mut self,
        mut visit: impl FnMut(usize, Function<'_, S>, &mut Mark) -> Result<(), IntegrationErrorKind>,
    ) -> Result<(), IntegrationErrorKind> {
        self.each_bounded(|number, (function, _), mark| visit(number, function, mark))
    }

    /// The same with what bounds their rates.
    fn each_bounded(
        &mut self,
        mut visit: impl FnMut(usize, (Function<'_, S>, Bound<'_, S>), &mut Mark) -> Result<(), IntegrationErrorKind>,
    ) -> Result<(), IntegrationErrorKind> {
        let (mut number, mut outcome) = (0, Ok(()));
        self.events.each_bounded(&mut |function, bound, mark| {
            if outcome.is_ok() {
                outcome = visit(number, (function, bound), mark);
            }
            number += 1;
        });
        outcome
    }

    /// Takes the values at the start of a run, or where it goes on after a jump.
    ///
    /// # Errors
    /// When a function is not a number there.
    pub fn begin(&mut self, start: &State<S>) -> Result<(), IntegrationErrorKind> {
        let (problem, lane) = (self.problem, self.lanes.start);
        self.each(|_, function, mark| mark.begin((problem, lane), function, start))
    }

    /// Whether the event with this number may lie in the step, judged by its function from the last value on.
    pub fn may_pass(&mut self, number: usize, shows: impl Fn(f64) -> Result<bool, IntegrationErrorKind>) -> bool {
        let (mut n, mut may) = (0, false);
        self.events.each(&mut |_, mark| {
            // What leaves zero, or has no value, is for the search to tell.
            let open = mark.value == 0.0 || mark.resting.is_some();
            may |= n == number && (open || shows(mark.value).unwrap_or(true));
            n += 1;
        });
        may
    }

    /// The value of the event of this number at the end of a step that had none.
    pub fn remember(&mut self, number: usize, value: f64) {
        let mut n = 0;
        self.events.each(&mut |_, mark| {
            if n == number {
                mark.value = value;
            }
            n += 1;
        });
    }

    /// Reports the events of a step, with their numbers, in the order in which they happen.
    ///
    /// # Errors
    /// When a function is not a number, a state within the step cannot be made, or a jump is refused.
    pub fn step(
        &mut self,
        made: &StepEnds<'_, S>,
        report: &mut dyn FnMut(usize, &State<S>),
    ) -> Result<Outcome<S>, IntegrationErrorKind> {
        let looking = StepSearch::of(self.control, self.problem, made);
        self.each_bounded(|number, function, mark| {
            (mark.last, mark.here) = (None, false);
            mark.next = mark.first(&looking, function, number)?;
            Ok(())
        })?;

        // What is no further than zeros are found to is at the same time.
        let together = 2.0 * looking.resolution;
        let (mut cut, mut here) = (f64::INFINITY, None::<EventCut<S>>);
        while let Some((number, part, terminal)) = self.earliest() {
            // Others at the very end of the run are told of, later ones are not.
            if part > cut + together {
                break;
            }
            let now = match here.take() {
                // Its own time may have other derivatives than that of the event before.
                Some((at, after, first, stopped_by)) => {
                    match self.differentiated(&looking, number, at) {
                        Ok(at) => report(number, &at),
                        // Behind the end of the run nothing depends on it: no more events are told of.
                        Err(_) if stopped_by.is_some() => {
                            here = Some((at, after, first, stopped_by));
                            break;
                        }
                        Err(kind) => return Err(kind),
                    }
                    let after = after.map(|after| self.differentiated(&looking, number, after)).transpose()?;
                    (at, after, first, stopped_by)
                }
                None => {
                    let at = self.differentiated(&looking, number, looking.reach(part)?)?;
                    report(number, &at);
                    (at, None, number, None)
                }
            };
            let now = self.happens(&looking, (number, terminal), now)?;
            if now.1.is_some() || now.3.is_some() {
                cut = cut.min(part);
                here = Some(now);
            }
        }
        if let Some((state, mut after, number, mut stopped_by)) = here {
            self.each(|_, _, mark| {
                mark.here = mark.last.is_some_and(|(part, _)| (part - cut).abs() <= together);
                Ok(())
            })?;
            self.led_over(&state, (&mut after, &mut stopped_by), report)?;
            // What goes on from there, after a jump or in another run, leaves zero.
            self.cut(&looking, &state)?;
            return Ok(Outcome::Here { state, after, number, stopped_by });
        }
        let (problem, lane) = (self.problem, self.lanes.start);
        self.each(|_, function, mark| {
            mark.value = value(problem, function, lane, made.after.0)?;
            Ok(())
        })?;
        Ok(Outcome::On)
    }

    /// A state at an event, moved to where the derivatives of its function are zero as well.
    fn differentiated(
        &mut self,
        looking: &StepSearch<'_, S, P, C>,
        number: usize,
        mut state: State<S>,
    ) -> Result<State<S>, IntegrationErrorKind> {
        if S::Scalar::DERIVATIVES {
            self.each(|n, function, _| {
                if n == number {
                    state = looking.differentiated((number, function), &state)?;
                }
                Ok(())
            })?;
        }
        Ok(state)
    }

    /// An event happens, which may end the run or make the state jump, perhaps after others there.
    fn happens(
        &mut self,
        looking: &StepSearch<'_, S, P, C>,
        (number, terminal): (usize, bool),
        (at, after, first, stopped_by): EventCut<S>,
    ) -> Result<EventCut<S>, IntegrationErrorKind> {
        let jumped = self.jump(number, &after.unwrap_or(at))?;
        let changed = jumped.is_some_and(|(_, changed)| changed);
        let jumped = jumped.map(|(state, _)| state);
        self.each_bounded(|n, function, mark| {
            if n == number {
                mark.last = mark.next.map(|(part, _)| (part, mark.value));
                mark.jumped |= changed;
                let cuts = jumped.is_some() || terminal;
                mark.next = if cuts { None } else { mark.following(looking, function)? };
            }
            Ok(())
        })?;
        Ok((at, jumped.or(after), first, stopped_by.or(terminal.then_some(number))))
    }

    /// Remembers of all functions that are on zero where the state jumps how they came there.
    fn cut(&mut self, looking: &StepSearch<'_, S, P, C>, state: &State<S>) -> Result<(), IntegrationErrorKind> {
        let rates = self.problem.rates(state);
        self.each(|_, function, mark| {
            mark.cut = mark.last.filter(|_| mark.here).map(|(_, before)| {
                let rate = looking.rate(function, state, &rates);
                let beyond = 2.0 * looking.resolution * looking.duration() * rate.abs();
                JumpApproach { side: side(before), rate, beyond }
            });
            Ok(())
        })
    }

    /// The state after the jump of an event, if it has one, and whether it is another; it may be something else that
    /// has changed.
    fn jump(&mut self, number: usize, from: &State<S>) -> Result<Option<(State<S>, bool)>, IntegrationErrorKind> {
        let problem = self.problem;
        let jumped = jump(&mut self.events, problem, (number, &problem.sample(from)), &self.lanes)?;
        Ok(jumped.map(|((q, z), changed)| (problem.state(from.t, q, &z), changed)))
    }

    /// Reports the events over whose zeros a jump has led, each once, with what follows from them.
    fn led_over(
        &mut self,
        before: &State<S>,
        (after, stopped_by): (&mut Option<State<S>>, &mut Option<usize>),
        report: &mut dyn FnMut(usize, &State<S>),
    ) -> Result<(), IntegrationErrorKind> {
        let (problem, lane) = (self.problem, self.lanes.start);
        while let Some(state) = *after {
            let mut first = None;
            self.each(|number, function, mark| {
                if first.is_none() && !mark.here && !mark.passed {
                    let (from, to) = (value(problem, function, lane, before)?, value(problem, function, lane, &state)?);
                    if mark.crossing.between(from, to) {
                        (mark.passed, first) = (true, Some((number, mark.terminal)));
                    }
                }
                Ok(())
            })?;
            let Some((number, terminal)) = first else { break };
            report(number, &state);
            if let Some((jumped, _)) = self.jump(number, &state)? {
                *after = Some(jumped);
            }
            if terminal && stopped_by.is_none() {
                *stopped_by = Some(number);
            }
        }
        Ok(())
    }

    /// The number of the event that comes next in the step, where, and whether it ends the run.
    fn earliest(&mut self) -> Option<(usize, f64, bool)> {
        let mut first: Option<(usize, f64, bool)> = None;
        let mut number = 0;
        self.events.each(&mut |_, mark| {
            if let Some((part, _)) = mark.next
                && first.is_none_or(|(_, earliest, _)| part < earliest)
            {
                first = Some((number, part, mark.terminal));
            }
            number += 1;
        });
        first
    }
}

/// Configuration and speeds after the jump of an event, on the constraints, and whether they are others; none where it
/// has no jump.
///
/// # Errors
/// [`IntegrationErrorKind::InvalidJump`]; a state that is not finite, or that constraints move farther than the jump.
#[expect(clippy::type_complexity, reason = "a state as two things, with what is asked of it")]
pub fn jump<S: GaussSystem, P: Problem<System = S>, E: Events<S>>(
    events: &mut E,
    problem: &P,
    (number, given): (usize, &Sample<S>),
    lanes: &Range<usize>,
) -> Result<Option<((S::Configuration, S::Speeds), bool)>, IntegrationErrorKind> {
    let mut set = *given;
    if !events.jump(number, &mut set) {
        return Ok(None);
    }
    let t = given.t;
    let mistake = |mistake| Err(IntegrationErrorKind::InvalidJump { event: number, mistake });
    if lanes.clone().any(|lane| set.t.lane(lane) != t.lane(lane)) {
        return mistake(JumpMistake::Time);
    }
    let speeds = |q: &S::Configuration, p: &S::Speeds| problem.speeds(t, q, &problem.of_momentum(t, q, p));
    if differs(&set.p, &given.p, lanes, 0.0) {
        let z = speeds(&set.q, &set.p);
        // Half of the digits: what agrees in them was meant to.
        let half = Real::sqrt(S::Scalar::EPSILON);
        if differs(&set.z, &given.z, lanes, 0.0) && differs(&set.z, &z, lanes, half) {
            return mistake(JumpMistake::SpeedsAndMomenta);
        }
        set.z = z;
    } else if S::Scalar::DERIVATIVES {
        // Momenta may be set to other derivatives at the same values.
        let [set_to, was] = [&set.p, &given.p].map(|p| speeds(&set.q, p));
        set.z = set.z.add_scaled(S::Scalar::one(), &set_to.add_scaled(-S::Scalar::one(), &was));
    }
    // The least change of a velocity counts: that of an axis which happens to lie level is meant as any other.
    let touched = |a: &S::Speeds, b: &S::Speeds, lane| {
        (0..S::Speeds::DIM).any(|i| a.component(i).lane(lane).to_bits() != b.component(i).lane(lane).to_bits())
    };
    let (increment, rounding) = (given.q.difference(&set.q), 64.0 * S::Scalar::EPSILON);
    let changed = lanes.clone().any(|lane| {
        let moved = (0..TangentOf::<S>::DIM).any(|i| increment.component(i).lane(lane).abs() > rounding);
        moved || touched(&given.z, &set.z, lane) || touched(&given.p, &set.p, lane)
    });
    Ok(Some((consistent(problem, (given, &set), lanes)?, changed)))
}

#[cfg(all(test, feature = "alloc"))]
#[path = "event_tests.rs"]
mod tests;

#[cfg(all(test, feature = "alloc"))]
#[path = "bounce_tests.rs"]
mod bounces;
