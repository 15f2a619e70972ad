//! Events: where a function of the state passes through zero during a run, and jumps of the state there.
//!
//! **What is an event.** A function passes from one side of zero to zero or to the other side, in a direction that is asked for, in
//! the order of integration.
//!
//! - *A zero at the start* is none: what starts on zero is on the side to which it leaves zero at first, and passes when it comes
//!   back. So a run goes on from where another one ended.
//! - *A touch* without passing is none; where rounding decides, it is two passages or none. A function grazes zero where its
//!   derivative passes through it: watch that.
//! - *A jump* of the function over zero is one. *A pole*, where it passes from one side to the other by way of infinity, is none.
//! - A function that is undefined (NaN) ends the run.
//!
//! **How they are found.** After every step the function is looked at between its ends as well: on the cubic through the states and
//! derivatives there, or on the series of Taylor's method. So passages there and back within one step are seen, as
//! long as that curve shows them; what is faster than the steps is not, and where that matters steps are to be bounded
//! ([`Simulation::largest_step`](crate::integrate::Simulation::largest_step)). Then the length of the step is varied until it ends at the
//! zero: what is found is a state that the method itself reaches from the last one, as accurate as the run, and not a point
//! of the curve.
//!
//! **Jumps.** [`Simulation::then`](crate::integrate::Simulation::then) changes the state at an event, and the run goes on from there. After
//! the jump the function is on the side that it came from, also where rounding left it a little beyond zero: a ball that bounces
//! has not fallen through the floor. Only where it passes on in the same direction, as at a gate that kicks, it is on the other. Where a jump itself leads over the zero of another event, that one happens at once, in the
//! state after the jump. Where it does not leave zero again, or events come ever faster and pile up at one time
//! (a ball that bounces infinitely often before it rests), the run ends with
//! [`IntegrationErrorKind::Zeno`].

use crate::configuration::{Configuration, VectorSpace};
use crate::integrate::drive::control::Control;
use crate::integrate::drive::search::{Crossing, Function, Looking, Made, same_side, value};
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::error::{IntegrationErrorKind, Part};
use crate::integrate::problem::state::{Rates, Sample, State};
use crate::real::Real;
use crate::system::GaussSystem;

/// What is remembered of one event from step to step.
#[derive(Clone, Copy, Debug)]
pub struct Mark {
    crossing: Crossing,
    terminal: bool,
    value: f64,
    /// Where in the present step the next one is, if there is one, with the value there.
    next: Option<(f64, f64)>,
    /// The value before the event that was found last.
    before: f64,
    /// Whether the state has jumped there, and stays on the side that it came from.
    jumped: bool,
    /// Whether a jump has led over it.
    passed: bool,
}

/// The events of a run, in the order in which they were asked for.
pub trait Events<S: GaussSystem> {
    /// Their number.
    const COUNT: usize;

    /// Shows every one.
    fn each(&mut self, visit: &mut dyn FnMut(Function<'_, S>, &mut Mark));

    /// Changes the state as the event of this number does; whether it does.
    fn jump(&mut self, number: usize, state: &mut Sample<S>) -> bool;
}

/// None.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoEvents;

impl<S: GaussSystem> Events<S> for NoEvents {
    const COUNT: usize = 0;

    fn each(&mut self, _: &mut dyn FnMut(Function<'_, S>, &mut Mark)) {}

    fn jump(&mut self, _: usize, _: &mut Sample<S>) -> bool {
        false
    }
}

/// One event after others, with what becomes of the state there.
#[derive(Clone, Copy, Debug)]
pub struct Watched<E, G, J = Stay> {
    others: E,
    function: G,
    jump: J,
    mark: Mark,
}

impl<E, G> Watched<E, G> {
    pub(crate) fn after(others: E, crossing: Crossing, terminal: bool, function: G) -> Self {
        let mark = Mark { crossing, terminal, value: 0.0, next: None, before: 0.0, jumped: false, passed: false };
        Self { others, function, jump: Stay, mark }
    }

    pub(crate) fn then<J>(self, jump: J) -> Watched<E, G, Then<J>> {
        let Self { others, function, mark, .. } = self;
        Watched { others, function, jump: Then(jump), mark }
    }
}

/// What becomes of the state at an event.
pub trait Jump<S: GaussSystem> {
    /// Changes it; whether it does.
    fn jump(&mut self, state: &mut Sample<S>) -> bool;
}

/// The state stays as it is.
#[derive(Clone, Copy, Debug, Default)]
pub struct Stay;

impl<S: GaussSystem> Jump<S> for Stay {
    fn jump(&mut self, _: &mut Sample<S>) -> bool {
        false
    }
}

/// A function changes the state.
#[derive(Clone, Copy, Debug)]
pub struct Then<J>(J);

impl<S: GaussSystem, J: FnMut(&mut Sample<S>)> Jump<S> for Then<J> {
    fn jump(&mut self, state: &mut Sample<S>) -> bool {
        (self.0)(state);
        true
    }
}

impl<S, E, G, J> Events<S> for Watched<E, G, J>
where
    S: GaussSystem,
    E: Events<S>,
    G: Fn(S::Scalar, &S::Configuration, &S::Speeds) -> S::Scalar,
    J: Jump<S>,
{
    const COUNT: usize = E::COUNT + 1;

    fn each(&mut self, visit: &mut dyn FnMut(Function<'_, S>, &mut Mark)) {
        self.others.each(visit);
        visit(&self.function, &mut self.mark);
    }

    fn jump(&mut self, number: usize, state: &mut Sample<S>) -> bool {
        if number == E::COUNT { self.jump.jump(state) } else { self.others.jump(number, state) }
    }
}

/// What the events of a step come to.
pub(in crate::integrate) enum Outcome<S: GaussSystem> {
    /// The step stands as it is.
    On,
    /// The run ends within the step or goes on from there in another state.
    Here {
        /// The state at the event.
        state: State<S>,
        /// What it jumped to.
        after: Option<State<S>>,
        /// The event that made it jump, or ended the run.
        number: usize,
        /// The event that ended the run.
        stopped_by: Option<usize>,
    },
}

/// The part of a step over which it is seen where a function goes after a jump.
const INSTANT: f64 = 1.0 / 1_048_576.0;

/// Looks for events at the start of a run and within its steps.
pub(in crate::integrate) struct Watch<'a, P, C, E> {
    control: &'a C,
    problem: &'a P,
    events: E,
    lane: usize,
}

impl<'a, S, P, C, E> Watch<'a, P, C, E>
where
    S: GaussSystem,
    P: Problem<System = S>,
    C: Control<S>,
    E: Events<S>,
{
    pub(in crate::integrate) fn new(control: &'a C, problem: &'a P, events: E, lane: usize) -> Self {
        Self { control, problem, events, lane }
    }

    /// Takes the values at the start of a run, or where it goes on after a jump.
    pub(in crate::integrate) fn begin(&mut self, start: &State<S>) -> Result<(), IntegrationErrorKind> {
        let (problem, lane) = (self.problem, self.lane);
        let mut outcome = Ok(());
        self.events.each(&mut |function, mark| match value(problem, function, lane, start) {
            Ok(value) => {
                let side = |of: f64| if of < 0.0 { -f64::MIN_POSITIVE } else { f64::MIN_POSITIVE };
                let beyond = value.abs() <= mark.value.abs() && !same_side(value, mark.before);
                let passed = core::mem::take(&mut mark.passed);
                mark.value = match core::mem::take(&mut mark.jumped) {
                    // On the side that it came from, unless the jump has led away from zero.
                    true if beyond => side(mark.before),
                    // Another event that is to come at this very time.
                    false if value == 0.0 && mark.value != 0.0 && !passed => side(mark.value),
                    _ => value,
                };
            }
            Err(kind) => outcome = Err(kind),
        });
        outcome
    }

    /// Whether the step may have the event of this number, as what is seen of its function from the last value says.
    #[cfg(feature = "alloc")]
    pub(in crate::integrate) fn may_pass(
        &mut self,
        number: usize,
        shows: impl Fn(f64) -> Result<bool, IntegrationErrorKind>,
    ) -> bool {
        let (mut n, mut may) = (0, false);
        self.events.each(&mut |_, mark| {
            // What has no value is for the search to tell.
            may |= n == number && shows(mark.value).unwrap_or(true);
            n += 1;
        });
        may
    }

    /// The value of the event of this number at the end of a step that had none.
    #[cfg(feature = "alloc")]
    pub(in crate::integrate) fn remember(&mut self, number: usize, value: f64) {
        let mut n = 0;
        self.events.each(&mut |_, mark| {
            if n == number {
                mark.value = value;
            }
            n += 1;
        });
    }

    /// Reports the events of a step, with their numbers, in the order in which they happen.
    pub(in crate::integrate) fn step(
        &mut self,
        made: &Made<'_, S>,
        report: &mut dyn FnMut(usize, &State<S>),
    ) -> Result<Outcome<S>, IntegrationErrorKind> {
        let looking = Looking::of(self.control, self.problem, made);
        let mut outcome = Ok(());
        self.events.each(&mut |function, mark| {
            let found = looking.leaving(function, (0.0, mark.value)).and_then(|from| {
                mark.value = from.1;
                looking.first(function, mark.crossing, from)
            });
            match found {
                Ok(next) => mark.next = next,
                Err(kind) => outcome = Err(kind),
            }
        });
        outcome?;

        let (mut last, mut here) = (f64::INFINITY, None);
        while let Some((number, part, terminal)) = self.earliest() {
            // Others at the very end of the run are told of, later ones are not.
            if part > last {
                break;
            }
            let state = looking.reach(part)?;
            report(number, &state);
            self.go_on(&looking, number)?;
            let (at, mut after, first, mut stopped_by) = here.take().unwrap_or((state, None, number, None));
            let from = after.unwrap_or(at);
            let mut sample = self.problem.sample(&from);
            if self.events.jump(number, &mut sample) {
                let (q, z) = consistent(self.problem, &sample)?;
                after = Some(self.problem.state(from.t, q, &z));
                self.leave(number, &state)?;
            }
            if terminal && stopped_by.is_none() {
                stopped_by = Some(number);
            }
            if after.is_some() || stopped_by.is_some() {
                last = part;
                here = Some((at, after, first, stopped_by));
            }
        }
        if let Some((state, mut after, number, mut stopped_by)) = here {
            self.led_over(&state, (&mut after, &mut stopped_by), report)?;
            if let Some(after) = &after {
                self.passing(&state, after, looking.length() * S::Scalar::from_f64(INSTANT))?;
            }
            return Ok(Outcome::Here { state, after, number, stopped_by });
        }
        let (problem, lane) = (self.problem, self.lane);
        let mut outcome = Ok(());
        self.events.each(&mut |function, mark| match value(problem, function, lane, made.after.0) {
            Ok(value) => mark.value = value,
            Err(kind) => outcome = Err(kind),
        });
        outcome.map(|()| Outcome::On)
    }

    /// Where the function of an event passes on through zero after the jump as before it, slower or faster, it is on the other side.
    fn passing(&mut self, before: &State<S>, after: &State<S>, h: S::Scalar) -> Result<(), IntegrationErrorKind> {
        let (problem, lane) = (self.problem, self.lane);
        let (slopes_before, slopes) = (problem.rates(before), problem.rates(after));
        let mut outcome = Ok(());
        self.events.each(&mut |function, mark| {
            let change = |at: &State<S>, rates: &Rates<S>| {
                let on = State {
                    t: at.t + h,
                    q: at.q.retract(&rates.configuration.scale(h)),
                    y: at.y.add_scaled(h, &rates.variables),
                };
                Ok(value(problem, function, lane, &on)? - value(problem, function, lane, at)?)
            };
            if mark.jumped {
                match change(before, &slopes_before).and_then(|was| Ok((was, change(after, &slopes)?))) {
                    Ok((was, is)) => mark.jumped = !(same_side(was, is) && is.abs() > 1e-6 * was.abs()),
                    Err(kind) => outcome = Err(kind),
                }
            }
        });
        outcome
    }

    /// Reports the events over whose zeros a jump has led, each once, with what follows from them.
    fn led_over(
        &mut self,
        before: &State<S>,
        (after, stopped_by): (&mut Option<State<S>>, &mut Option<usize>),
        report: &mut dyn FnMut(usize, &State<S>),
    ) -> Result<(), IntegrationErrorKind> {
        let (problem, lane) = (self.problem, self.lane);
        while let Some(state) = *after {
            let (mut first, mut n, mut outcome) = (None, 0, Ok(()));
            self.events.each(&mut |function, mark| {
                if first.is_none() && !mark.jumped && !mark.passed {
                    match value(problem, function, lane, before)
                        .and_then(|from| Ok((from, value(problem, function, lane, &state)?)))
                    {
                        Ok((from, to)) if mark.crossing.between(from, to) => {
                            (mark.passed, first) = (true, Some((n, mark.terminal)));
                        }
                        Ok(_) => {}
                        Err(kind) => outcome = Err(kind),
                    }
                }
                n += 1;
            });
            outcome?;
            let Some((number, terminal)) = first else { break };
            report(number, &state);
            let mut sample = problem.sample(&state);
            if self.events.jump(number, &mut sample) {
                let (q, z) = consistent(problem, &sample)?;
                *after = Some(problem.state(state.t, q, &z));
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

    /// Looks for the next one of an event behind the one that was reported.
    fn go_on(&mut self, looking: &Looking<'_, S, P, C>, number: usize) -> Result<(), IntegrationErrorKind> {
        let mut outcome = Ok(());
        let mut n = 0;
        self.events.each(&mut |function, mark| {
            if n == number
                && let Some(from) = mark.next
            {
                let found = looking.leaving(function, from).and_then(|from| {
                    (mark.before, mark.value) = (mark.value, from.1);
                    looking.first(function, mark.crossing, from)
                });
                match found {
                    Ok(next) => mark.next = next,
                    Err(kind) => outcome = Err(kind),
                }
            }
            n += 1;
        });
        outcome
    }

    /// Remembers that the state jumped at an event, and how far beyond zero it was.
    fn leave(&mut self, number: usize, state: &State<S>) -> Result<(), IntegrationErrorKind> {
        let (problem, lane) = (self.problem, self.lane);
        let mut outcome = Ok(());
        let mut n = 0;
        self.events.each(&mut |function, mark| {
            if n == number {
                match value(problem, function, lane, state) {
                    Ok(value) => (mark.jumped, mark.value) = (true, value),
                    Err(kind) => outcome = Err(kind),
                }
            }
            n += 1;
        });
        outcome
    }
}

/// The state after a jump, on the constraints where there are any: what is nearest by the kinetic energy is what an impact makes
/// of the velocities.
fn consistent<S: GaussSystem, P: Problem<System = S>>(
    problem: &P,
    sample: &Sample<S>,
) -> Result<(S::Configuration, S::Speeds), IntegrationErrorKind> {
    let Sample { t, q, z, .. } = *sample;
    if !(q.is_finite() && z.is_finite()) {
        return Err(IntegrationErrorKind::NonFinite { part: Part::Jump });
    }
    if !S::CONSTRAINED {
        return Ok((q.renormalise(), z));
    }
    problem.system().project(t, &q, &z).map_err(|error| IntegrationErrorKind::Projection { error })
}

#[cfg(all(test, feature = "alloc"))]
#[path = "event_tests.rs"]
mod tests;
