//! A simulation one step at a time.

use core::fmt;
use core::ops::Range;

use crate::configuration::Configuration;
use crate::integrate::drive::control::{Control, within_step};
use crate::integrate::drive::event::{Events, NoEvents};
use crate::integrate::drive::observer::{Observer, Unobserved};
pub use crate::integrate::drive::run::StepOutcome;
use crate::integrate::drive::run::{Run, RunItem, RunProgress, Way};
use crate::integrate::drive::summary::Summary;
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::error::{IntegrationError, IntegrationErrorKind};
use crate::integrate::problem::state::{Sample, State};
use crate::real::Real;
use crate::system::GaussSystem;

type ScalarOf<P> = <<P as Problem>::System as GaussSystem>::Scalar;
type ConfigurationOf<P> = <<P as Problem>::System as GaussSystem>::Configuration;
type SpeedsOf<P> = <<P as Problem>::System as GaussSystem>::Speeds;

/// A run that makes a step when it is asked to: [`Simulation::stepper`](crate::integrate::Simulation::stepper).
///
/// Its steps, events and samples are those of [`run`](crate::integrate::Simulation::run), to the last bit, whatever is
/// asked of it between steps. A clone is a checkpoint: it goes on from where it was made, with the lengths, derivatives
/// and events that the run remembered there. (Closures that borrow what they change have no clone, and the compiler
/// says so.)
///
#[cfg_attr(
    feature = "derive",
    doc = r##"
A ball is followed from step to step until it has bounced twice, then to a time between two steps:

```
use gauss_runtime::integrate::StepOutcome;
use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(coordinates(height), particle(mass = 1, position = [0, 0, height]))]
struct Ball {
    #[gauss(gravity)] g: f64,
}

# fn main() -> Result<(), Box<dyn std::error::Error>> {
let kernel = Ball { g: 10.0 }.kernel()?;
let mut run = Simulation::new(&kernel)
    .event(Crossing::Falling, |_t, q, _z| q[0])
    .then(|state| state.z[0] *= -0.5)
    .adaptive(1e-10, 1e-10)
    .stepper(SVector::from([5.0]), SVector::from([0.0]), 0.0..10.0)?;
let mut bounces = 0;
while bounces < 2 {
    if let StepOutcome::Jump(_) = run.step()? {
        bounces += 1;
    }
}
// It falls for 1 s, hits with 10 m/s, leaves with 5 m/s and flies for 1 s, and leaves again with 2.5 m/s.
assert!((run.time() - 2.0).abs() < 1e-9 && (run.state().z[0] - 2.5).abs() < 1e-9);
// That flight lasts 0.5 s; in the middle it is highest.
let top = run.reach(2.25)?;
assert!((top.q[0] - 0.3125).abs() < 1e-9 && top.z[0].abs() < 1e-8);
# Ok(())
# }
```
"##
)]
#[must_use = "a run does nothing before `step`"]
pub struct Stepper<P: Problem, C: Control<P::System>, O = Unobserved, E = NoEvents> {
    problem: P,
    control: C,
    observer: O,
    events: E,
    every: u64,
    limit: Option<u64>,
    run: RunProgress<P::System, C::StepMemory>,
    /// The start of the last step.
    before: Option<State<P::System>>,
    error: Option<IntegrationError>,
}

// Written by hand: deriving would ask the same of the system, which is only named here.
impl<P: Problem + Clone, C: Control<P::System> + Clone, O: Clone, E: Clone> Clone for Stepper<P, C, O, E> {
    fn clone(&self) -> Self {
        let Self { problem, control, observer, events, run, error, .. } = self;
        Self {
            problem: problem.clone(),
            control: control.clone(),
            observer: observer.clone(),
            events: events.clone(),
            run: run.clone(),
            error: error.clone(),
            ..*self
        }
    }
}

impl<P: Problem, C: Control<P::System>, O, E> fmt::Debug for Stepper<P, C, O, E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Stepper").field("state", self.run.state()).finish_non_exhaustive()
    }
}

/// Shows an observer what a run passes on.
fn show<P: Problem, O: Observer<P::System>>(problem: &P, observer: &mut O, item: RunItem<'_, P::System>) {
    match item {
        RunItem::Sample(state) => observer.see(&problem.sample(state)),
        RunItem::Event(number, state) => observer.event(number, &problem.sample(state)),
        RunItem::Held(..) => {}
    }
}

impl<P: Problem, C: Control<P::System>, O, E> Stepper<P, C, O, E> {
    /// The time where the run is.
    #[must_use]
    pub fn time(&self) -> ScalarOf<P> {
        self.run.state().t
    }

    /// The state where the run is; where it has jumped, the one after the jump.
    #[must_use]
    pub fn state(&self) -> Sample<P::System> {
        self.problem.sample(self.run.state())
    }

    /// The state at a time within the last step, which the method reaches from the start of that step, as
    /// [`Trajectory::at`](crate::integrate::Trajectory::at) does.
    ///
    /// # Errors
    /// [`IntegrationErrorKind::OutsideRun`] for other times; that of the step to this time when it cannot be made.
    pub fn at(&self, t: ScalarOf<P>) -> Result<Sample<P::System>, IntegrationError> {
        let now = self.run.state();
        match &self.before {
            _ if t == now.t => Ok(self.state()),
            Some(from) if t == from.t => Ok(self.problem.sample(from)),
            Some(from) if (t - from.t).lane(0) * (now.t - t).lane(0) >= 0.0 => {
                within_step(&self.problem, &self.control, from, t)
            }
            _ => Err(IntegrationError::at(&self.problem, now, IntegrationErrorKind::OutsideRun { time: t.lane(0) })),
        }
    }

    /// Whether the run has ended: at the end of its interval, or by an event.
    #[must_use]
    pub fn is_over(&self) -> bool {
        self.run.is_over()
    }

    /// The event that ended the run, by its number.
    #[must_use]
    pub fn stopped_by(&self) -> Option<usize> {
        self.run.reached().stopped_by
    }

    /// The steps so far.
    #[must_use]
    pub fn summary(&self) -> &Summary {
        &self.run.reached().summary
    }

    /// The problem that is integrated: the kernel, the form of its equations, the input.
    #[must_use]
    pub fn problem(&self) -> &P {
        &self.problem
    }
}

impl<P, C, O, E> Stepper<P, C, O, E>
where
    P: Problem,
    C: Control<P::System>,
    O: Observer<P::System>,
    E: Events<P::System>,
{
    /// A run before its first step.
    pub(in crate::integrate) fn new(
        (problem, control): (P, C),
        (mut observer, mut events): (O, E),
        (every, limit): (u64, Option<u64>),
        (q0, z0): (ConfigurationOf<P>, SpeedsOf<P>),
        interval: Range<ScalarOf<P>>,
    ) -> Result<Self, IntegrationError> {
        let start = problem.state(interval.start, q0.renormalise(), &z0);
        let pass = &mut |item: RunItem<'_, P::System>| show(&problem, &mut observer, item);
        let run = Run::new(&problem, &control, every, limit).start(&mut events, start, interval.end, pass)?;
        Ok(Self { problem, control, observer, events, every, limit, run, before: None, error: None })
    }

    /// Makes a step: to its end, or to an event that makes the state jump or ends the run. Events that do neither are
    /// told to the [`Observer`]. A run that is over stays where it is, with the outcome of its last step.
    ///
    /// # Errors
    /// When no step can be made; the run is then at its last state, and every further step gives the same error.
    pub fn step(&mut self) -> Result<StepOutcome, IntegrationError> {
        if let Some(error) = &self.error {
            return Err(error.clone());
        }
        if self.run.is_over() {
            return Ok(self.stopped_by().map_or(StepOutcome::End, StepOutcome::Stop));
        }
        // After a jump, or at an instant of a controller, steps begin anew.
        let begun = self.advance(Way::ToStep)?;
        if begun != StepOutcome::Step {
            return Ok(begun);
        }
        self.before = Some(*self.run.state());
        self.advance(Way::OneStep)
    }

    fn advance(&mut self, way: Way) -> Result<StepOutcome, IntegrationError> {
        let Self { problem, control, observer, events, every, limit, run, error, .. } = self;
        let pass = &mut |item: RunItem<'_, P::System>| show(problem, observer, item);
        let outcome = Run::new(problem, control, *every, *limit).advance(run, events, way, pass);
        *error = outcome.as_ref().err().cloned();
        outcome
    }

    /// Makes steps until one ends at a time or behind it, and gives the state [at](Self::at) that time.
    ///
    /// # Errors
    /// That of a step; [`IntegrationErrorKind::OutsideRun`] where the run ends before that time, or has its last step
    /// behind it already.
    pub fn reach(&mut self, t: ScalarOf<P>) -> Result<Sample<P::System>, IntegrationError> {
        // Of the direction in which the run goes on.
        let left = |stepper: &Self, to: ScalarOf<P>| (to - stepper.time()).lane(0);
        while !self.run.is_over() && left(self, t) * left(self, self.run.end()) > 0.0 {
            self.step()?;
        }
        self.at(t)
    }

    /// Goes on from another state at the same time, and begins anew: the length of the first step, the history of
    /// [`Adams`](crate::integrate::Adams), derivatives that came with the step before, what was rounded off, the sides
    /// from which events are passed. Steps and jumps are counted on, and controllers keep their instants. A run that is
    /// over stays so, in this state.
    ///
    /// # Errors
    /// When the state is not finite, or not on the constraints.
    pub fn set_state(&mut self, q: ConfigurationOf<P>, z: SpeedsOf<P>) -> Result<(), IntegrationError> {
        let Self { problem, observer, events, run, .. } = self;
        events.each(&mut |_, mark| mark.renew());
        let state = problem.state(run.state().t, q.renormalise(), &z);
        run.put(state, &mut |item| show(problem, observer, item));
        self.begin()
    }

    /// Begins anew in the same state, as [`set_state`](Self::set_state) does but for events. It is to be called where
    /// what acts has changed suddenly since the last step, as an input that reads a cell: else the next step begins
    /// with the derivatives and the length of before.
    ///
    /// # Errors
    /// When no step can begin.
    pub fn renew(&mut self) -> Result<(), IntegrationError> {
        self.run.renew();
        self.begin()
    }

    fn begin(&mut self) -> Result<(), IntegrationError> {
        (self.before, self.error) = (None, None);
        if self.run.is_over() { Ok(()) } else { self.advance(Way::ToStep).map(|_| ()) }
    }
}

#[cfg(all(test, feature = "alloc"))]
#[path = "stepper_tests.rs"]
mod tests;
