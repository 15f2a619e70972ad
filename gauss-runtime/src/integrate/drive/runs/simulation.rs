//! The front of the integrators: choose the problem, the form of its equations and the accuracy, then run.

#[cfg(feature = "alloc")]
use alloc::vec::Vec;
use core::ops::Range;

use crate::integrate::drive::adaptive::Adaptive;
#[cfg(feature = "alloc")]
use crate::integrate::drive::bounded::{NoBound, RateBound};
#[cfg(feature = "alloc")]
use crate::integrate::drive::boxed::BoxedSimulation;
use crate::integrate::drive::control::Control;
#[cfg(feature = "alloc")]
use crate::integrate::drive::each::Each;
use crate::integrate::drive::event::{Events, JumpFunction, NoEvents, Watched};
use crate::integrate::drive::fixed::Fixed;
use crate::integrate::drive::observer::{Callback, Observer, Unobserved};
use crate::integrate::drive::run::Run;
use crate::integrate::drive::search::Crossing;
use crate::integrate::drive::stepper::Stepper;
use crate::integrate::drive::summary::End;
#[cfg(feature = "alloc")]
use crate::integrate::drive::trajectory::Trajectory;
use crate::integrate::problem::equations::{Problem, SystemProblem};
use crate::integrate::problem::error::IntegrationError;
use crate::integrate::problem::form::{Form, MomentumForm, WithoutContacts};
use crate::integrate::problem::input::{Feedback, InputSource};
use crate::integrate::problem::state::Sample;
use crate::real::Real;
use crate::system::GaussSystem;

/// No choice of steps: [`Simulation::fixed_step`] or [`Simulation::adaptive`] comes next.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoControl;

/// A run in preparation.
///
#[cfg_attr(
    feature = "derive",
    doc = r##"
```
use gauss_runtime::prelude::*;

/// A heavy top that turns about O.
#[derive(GaussDynamics)]
#[gauss(motion = fixed_point)]
struct Top {
    #[gauss(mass)]           mass: f64,
    #[gauss(center_of_mass)] center: Vector3<f64>,
    #[gauss(inertia)]        inertia: Vector3<f64>,
    #[gauss(gravity)]        g: f64,
}

# fn main() -> Result<(), Box<dyn std::error::Error>> {
let top = Top { mass: 1.0, center: Vector3::new(0.0, 0.0, 0.4), inertia: Vector3::new(0.2, 0.2, 0.05), g: 9.81 };
let kernel = top.kernel()?;
let tilted = UnitQuaternion::from_euler_angles(0.3, 0.0, 0.0);
let spinning = Vector3::new(0.0, 0.0, 40.0);
let trajectory = Simulation::new(&kernel).adaptive(1e-10, 1e-12).run(tilted, spinning, 0.0..2.0)?;
let end = trajectory.last();
let before = kernel.energy(0.0, &tilted, &spinning);
assert!((kernel.energy(end.t, &end.q, &end.z) - before).abs() < 1e-7 * before);
# Ok(())
# }
```
"##
)]
///
/// Initial values are always quasi-velocities z, and samples hold both z and p.
///
/// Constraints that coordinates and speeds do not solve by themselves hold up to rounding in every sample, because each
/// step ends with a projection ([`GaussSystem::project`]). Initial values must satisfy them as well, up to the rounding
/// of the numbers that were given.
#[derive(Clone, Copy, Debug)]
#[must_use = "a simulation does nothing before `run`"]
pub struct Simulation<P, C = NoControl, O = Unobserved, E = NoEvents> {
    problem: P,
    control: C,
    observer: O,
    events: E,
    every: u64,
    limit: Option<u64>,
}

impl<'k, S: GaussSystem> Simulation<SystemProblem<'k, S>> {
    /// A run of a kernel, in velocity form and without inputs; [`form`](Self::form) and
    /// [`input`](Self::input) change that.
    pub fn new(system: &'k S) -> Self {
        Self::of(SystemProblem::new(system))
    }
}

impl<P> Simulation<P> {
    /// A run of any [`Problem`].
    pub fn of(problem: P) -> Self {
        Self { problem, control: NoControl, observer: Unobserved, events: NoEvents, every: 1, limit: None }
    }
}

impl<'k, S: GaussSystem, F, I, C, O, E> Simulation<SystemProblem<'k, S, F, I>, C, O, E> {
    /// Which variables are integrated: [`VelocityForm`](crate::integrate::VelocityForm) or [`MomentumForm`].
    pub fn form<G: Form<S>>(self, form: G) -> Simulation<SystemProblem<'k, S, G, I>, C, O, E> {
        self.with_problem(|problem| problem.form(form))
    }

    /// Integrates momenta instead of quasi-velocities.
    pub fn momentum_form(self) -> Simulation<SystemProblem<'k, S, MomentumForm, I>, C, O, E> {
        self.form(MomentumForm)
    }

    /// Runs a scene with contacts as if it had none: its gaps become negative, and nothing touches. Without this such
    /// a run ends at once with [`IntegrationErrorKind::Contacts`](crate::integrate::IntegrationErrorKind::Contacts).
    /// Contact forces are chosen by `contact_events()`, from event to event, or `contact_steps(h)`, in steps: the trait
    /// `WithContacts` of the crate `gauss-contact`. A later [`form`](Self::form) undoes it.
    pub fn without_contacts(self) -> Simulation<SystemProblem<'k, S, WithoutContacts<F>, I>, C, O, E> {
        self.with_problem(SystemProblem::without_contacts)
    }

    /// The input as a function of time and state. It is called at every stage of every step, also of steps that are
    /// rejected: it should depend on its arguments only, and smoothly.
    ///
    /// A closure that changes something, as one that adds up an integral, draws noise or keeps what it saw last, is
    /// refused by the compiler: "cannot assign to `integral`, as it is a captured variable in a `Fn` closure". Its sum
    /// would have a term for every stage and every step that was tried, and depend on the method. What samples belongs
    /// into [`sampled`](Self::sampled), whose closure may change what it likes; an integral without sampling is a state
    /// of the scene, `states(integral = x - goal)`.
    #[doc(alias = "FnMut")]
    #[doc(alias = "control law")]
    pub fn input<G>(self, input: G) -> Simulation<SystemProblem<'k, S, F, Feedback<G>>, C, O, E>
    where
        G: Fn(S::Scalar, &S::Configuration, &S::Speeds) -> S::Input, // one that changes something: `.sampled(…)`
    {
        self.input_from(Feedback(input))
    }

    /// The input from a type that implements [`InputSource`]: a controller with parameters of its own, or a table.
    pub fn input_from<J: InputSource<S>>(self, input: J) -> Simulation<SystemProblem<'k, S, F, J>, C, O, E> {
        self.with_problem(|problem| problem.input_from(input))
    }

    /// Calls a function with every sample as it comes.
    pub fn observe<G: FnMut(&Sample<S>)>(
        self,
        observer: G,
    ) -> Simulation<SystemProblem<'k, S, F, I>, C, Callback<G>, E> {
        self.observe_by(Callback(observer))
    }

    /// Finds the states in which a function of time and state, of its first lane where numbers are packs, passes
    /// through zero. They are numbered in the order of these calls and of [`until`](Self::until), from 0, and are found
    /// in [`Trajectory::events`], and by an [`Observer`]; [`then`](Simulation::then) changes the state there. How
    /// events are found, and which are missed: [`event`](crate::integrate::drive::event).
    ///
    #[cfg_attr(
        feature = "derive",
        doc = r##"
The turning points of a pendulum, whose period 4 K(sin ½α) √(ℓ/g) is 2π/agm(1, cos ½α) √(ℓ/g) (Gauss):

```
use gauss_runtime::prelude::*;

/// A pendulum: a point on a rod, `angle` from the vertical.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(angle),
    particle(mass = mass, position = [length * sin(angle), 0, -length * cos(angle)]),
)]
struct Pendulum {
    mass: f64,
    length: f64,
    #[gauss(gravity)] g: f64,
}

# fn main() -> Result<(), Box<dyn std::error::Error>> {
let kernel = Pendulum { mass: 0.3, length: 0.5, g: 9.81 }.kernel()?;
let (amplitude, at_rest) = (2.0_f64, SVector::from([0.0]));
let run = Simulation::new(&kernel)
    .event(Crossing::Any, |_t, _q, z| z[0]) // where it turns back
    .adaptive(1e-12, 1e-12)
    .run(SVector::from([amplitude]), at_rest, 0.0..10.0)?;

let (mut a, mut b) = (1.0, (0.5 * amplitude).cos());
for _ in 0..5 {
    (a, b) = (0.5 * (a + b), (a * b).sqrt());
}
let period = std::f64::consts::TAU / a * (0.5_f64 / 9.81).sqrt();
for (n, event) in run.events().iter().enumerate() {
    let turn = &event.sample;
    assert!((turn.t - 0.5 * period * (n + 1) as f64).abs() < 1e-9);
    assert!((turn.q[0].abs() - amplitude).abs() < 1e-9 && turn.z[0].abs() < 1e-12);
}
assert_eq!(run.events().len(), (10.0 / (0.5 * period)) as usize);
# Ok(())
# }
```
"##
    )]
    pub fn event<G>(
        self,
        crossing: Crossing,
        function: G,
    ) -> Simulation<SystemProblem<'k, S, F, I>, C, O, Watched<E, G>>
    where
        G: Fn(S::Scalar, &S::Configuration, &S::Speeds) -> S::Scalar,
    {
        self.watch(crossing, false, function)
    }

    /// Ends the run at the first such state, which is then the last sample; it is an [`event`](Self::event) as well.
    /// [`Trajectory::stopped_by`] and [`End::stopped_by`] tell whether it came to that.
    ///
    /// The state is at zero or beyond it, by rounding. To go on from there by another kernel, start that one there.
    pub fn until<G>(
        self,
        crossing: Crossing,
        function: G,
    ) -> Simulation<SystemProblem<'k, S, F, I>, C, O, Watched<E, G>>
    where
        G: Fn(S::Scalar, &S::Configuration, &S::Speeds) -> S::Scalar,
    {
        self.watch(crossing, true, function)
    }
}

impl<'k, S: GaussSystem, F, I, C, O, E, G> Simulation<SystemProblem<'k, S, F, I>, C, O, Watched<E, G>> {
    /// Changes the state at the event that was added last, before the run goes on from there, or ends there
    /// ([`until`](Self::until)). What may be set is `q`, and `z` or `p`; the other follows. Under constraints the state
    /// is brought onto them, with velocities as an impact makes them.
    ///
    /// A jump at a zero of the configuration has to turn the function back: else the run ends with
    /// [`NotTurnedBack`](crate::integrate::IntegrationErrorKind::NotTurnedBack), and where it ends at rest, or bounces
    /// ever lower, with [`Zeno`](crate::integrate::IntegrationErrorKind::Zeno). See
    /// [`event`](crate::integrate::drive::event).
    ///
    /// The trajectory has a sample before the jump and one after it, both at its time.
    ///
    #[cfg_attr(
        feature = "derive",
        doc = r##"
A ball that bounces, and keeps four fifths of its speed each time:

```
use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(coordinates(height), particle(mass = 1, position = [0, 0, height]))]
struct Ball {
    #[gauss(gravity)] g: f64,
}

# fn main() -> Result<(), Box<dyn std::error::Error>> {
let kernel = Ball { g: 9.81 }.kernel()?;
let run = Simulation::new(&kernel)
    .event(Crossing::Falling, |_t, q, _z| q[0])
    .then(|state| state.z[0] *= -0.8)
    .adaptive(1e-10, 1e-10)
    .run(SVector::from([1.0]), SVector::from([0.0]), 0.0..2.0)?;
// It falls for √(2h/g); then it flies for twice that, times 0.8, and so on.
let fall = (2.0_f64 / 9.81).sqrt();
let times: Vec<f64> = run.events().iter().map(|event| event.sample.t).collect();
assert_eq!(times.len(), 3);
assert!((times[2] - fall * (1.0 + 2.0 * 0.8 + 2.0 * 0.64)).abs() < 1e-9);
assert!(run.iter().all(|state| state.q[0] > -1e-14)); // some roundings of the time, at 4.4 m/s
# Ok(())
# }
```
"##
    )]
    #[expect(clippy::type_complexity, reason = "a builder, whose type nobody writes")]
    pub fn then<J: FnMut(&mut Sample<S>)>(
        self,
        jump: J,
    ) -> Simulation<SystemProblem<'k, S, F, I>, C, O, Watched<E, G, JumpFunction<J>>> {
        self.with_jump(jump, false)
    }

    /// Changes the state as [`then`](Self::then) does, where the function may go on through zero: a gate that kicks or
    /// brakes what passes.
    #[expect(clippy::type_complexity, reason = "a builder, whose type nobody writes")]
    pub fn then_through<J: FnMut(&mut Sample<S>)>(
        self,
        jump: J,
    ) -> Simulation<SystemProblem<'k, S, F, I>, C, O, Watched<E, G, JumpFunction<J>>> {
        self.with_jump(jump, true)
    }

    #[expect(clippy::type_complexity, reason = "a builder, whose type nobody writes")]
    fn with_jump<J>(
        self,
        jump: J,
        through: bool,
    ) -> Simulation<SystemProblem<'k, S, F, I>, C, O, Watched<E, G, JumpFunction<J>>> {
        let Self { problem, control, observer, events, every, limit } = self;
        Simulation { problem, control, observer, events: events.then(jump, through), every, limit }
    }
}

impl<P, C, O, E> Simulation<P, C, O, E> {
    /// Steps of one length, by [`RungeKutta`](crate::integrate::RungeKutta) of order 8 (Dormand and Prince); the last
    /// step is shortened to end in time.
    pub fn fixed_step<T: Real>(self, step: T) -> Simulation<P, Fixed<T>, O, E> {
        self.control(Fixed::new(step))
    }

    /// Steps as long as the tolerances allow, by [`RungeKutta`](crate::integrate::RungeKutta) of order 8 (Dormand and
    /// Prince): see [`Adaptive::new`].
    pub fn adaptive(self, relative: f64, absolute: f64) -> Simulation<P, Adaptive, O, E> {
        self.control(Adaptive::new(relative, absolute))
    }

    /// Any method with its choice of steps: a [`Control`].
    pub fn control<D>(self, control: D) -> Simulation<P, D, O, E> {
        let Self { problem, observer, events, every, limit, .. } = self;
        Simulation { problem, control, observer, events, every, limit }
    }

    /// Shows every sample, and every event, to a type that implements [`Observer`].
    pub fn observe_by<Q>(self, observer: Q) -> Simulation<P, C, Q, E> {
        let Self { problem, control, events, every, limit, .. } = self;
        Simulation { problem, control, observer, events, every, limit }
    }

    /// Hands out the first, the last, and every n-th state only (0 counts as 1).
    pub fn every(mut self, n: u64) -> Self {
        self.every = n.max(1);
        self
    }

    /// The most steps (rejected ones included) before the run is given up, instead of
    /// [`DEFAULT_LIMIT`](crate::integrate::DEFAULT_LIMIT), or of a tenth of it where every one is kept.
    ///
    /// Runs that cannot reach their end within the limit end as soon as that is seen: steps of one length at once,
    /// others when the way that a hundred thousand of them made shows it.
    pub fn max_steps(mut self, limit: u64) -> Self {
        self.limit = Some(limit);
        self
    }

    /// Ends the run at the first state in which one of a list of functions passes through zero: as that many calls of
    /// `until`, where their number is known when the program runs only. Functions are numbered in the order of the
    /// list, after the events that were added before.
    #[cfg(feature = "alloc")]
    pub fn until_each<S, G>(self, crossing: Crossing, functions: Vec<G>) -> Simulation<P, C, O, Each<E, G>>
    where
        S: GaussSystem,
        P: Problem<System = S>,
        G: Fn(S::Scalar, &S::Configuration, &S::Speeds) -> S::Scalar,
    {
        self.each(crossing, true, functions)
    }

    /// Ends the run as [`until_each`](Self::until_each) does, with what [bounds the rate](RateBound) of each function
    /// where something does: of such a function no zero is missed that it falls to, however long the steps.
    #[cfg(feature = "alloc")]
    pub fn until_each_bounded<S, G, B>(
        self,
        crossing: Crossing,
        functions: Vec<(G, Option<B>)>,
    ) -> Simulation<P, C, O, Each<E, G, B>>
    where
        S: GaussSystem,
        P: Problem<System = S>,
        G: Fn(S::Scalar, &S::Configuration, &S::Speeds) -> S::Scalar,
        B: RateBound<S>,
    {
        self.with_events(|events| Each::after(events, crossing, true, functions))
    }

    /// Events that another front has gathered, in the place of those so far.
    #[doc(hidden)]
    #[cfg(feature = "alloc")]
    pub fn events_by<F>(self, events: F) -> Simulation<P, C, O, F> {
        self.with_events(|_| events)
    }

    /// Finds the zeros of a list of functions: as that many calls of `event`, where their number is known when the
    /// program runs only. They are numbered as by [`until_each`](Self::until_each).
    #[cfg(feature = "alloc")]
    pub fn event_each<S, G>(self, crossing: Crossing, functions: Vec<G>) -> Simulation<P, C, O, Each<E, G>>
    where
        S: GaussSystem,
        P: Problem<System = S>,
        G: Fn(S::Scalar, &S::Configuration, &S::Speeds) -> S::Scalar,
    {
        self.each(crossing, false, functions)
    }

    #[cfg(feature = "alloc")]
    fn each<G>(self, crossing: Crossing, terminal: bool, functions: Vec<G>) -> Simulation<P, C, O, Each<E, G>> {
        let plain = functions.into_iter().map(|function| (function, None::<NoBound>));
        self.with_events(|events| Each::after(events, crossing, terminal, plain))
    }

    /// Returns the problem that is integrated: the kernel, the form of its equations, the input.
    #[must_use]
    pub fn problem(&self) -> &P {
        &self.problem
    }

    /// The most steps, where they were [given](Self::max_steps).
    #[must_use]
    pub fn limit(&self) -> Option<u64> {
        self.limit
    }

    /// Returns the parts from which another front goes on: the problem, the control, the events, every how many states
    /// are handed out, the most steps.
    #[doc(hidden)]
    pub fn into_parts(self) -> (P, C, E, u64, Option<u64>) {
        let Self { problem, control, events, every, limit, .. } = self;
        (problem, control, events, every, limit)
    }

    pub(in crate::integrate) fn with_problem<Q>(self, change: impl FnOnce(P) -> Q) -> Simulation<Q, C, O, E> {
        let Self { problem, control, observer, events, every, limit } = self;
        Simulation { problem: change(problem), control, observer, events, every, limit }
    }

    #[cfg(feature = "alloc")]
    pub(in crate::integrate) fn with_events<F>(self, change: impl FnOnce(E) -> F) -> Simulation<P, C, O, F> {
        let Self { problem, control, observer, events, every, limit } = self;
        Simulation { problem, control, observer, events: change(events), every, limit }
    }

    fn watch<G>(self, crossing: Crossing, terminal: bool, function: G) -> Simulation<P, C, O, Watched<E, G>> {
        let Self { problem, control, observer, events, every, limit } = self;
        let events = Watched::after(events, crossing, terminal, function);
        Simulation { problem, control, observer, events, every, limit }
    }
}

impl<P, O, E, M> Simulation<P, Adaptive<M>, O, E> {
    /// The length of the first step, instead of an estimate.
    pub fn first_step(mut self, length: f64) -> Self {
        self.control = self.control.first_step(length);
        self
    }

    /// The longest step.
    pub fn largest_step(mut self, length: f64) -> Self {
        self.control = self.control.largest_step(length);
        self
    }

    /// The shortest time within which the input changes: see [`Adaptive::input_changes_within`].
    pub fn input_changes_within(mut self, time: f64) -> Self {
        self.control = self.control.input_changes_within(time);
        self
    }
}

impl<P, C, O, E> Simulation<P, C, O, E> {
    /// Integrates from (q₀, z₀) over the interval, which may run backwards, and keeps every sample. The
    /// [`Trajectory`] gives the states between them as well, [as accurate as they are](Trajectory::at), for which it
    /// borrows the kernel.
    ///
    /// # Errors
    /// When the run does not reach the end; [`attempt`](Self::attempt) then gives the part that was made.
    #[cfg(feature = "alloc")]
    pub fn run<'t, S: GaussSystem>(
        self,
        q0: S::Configuration,
        z0: S::Speeds,
        interval: Range<S::Scalar>,
    ) -> Result<Trajectory<'t, S>, IntegrationError>
    where
        P: Problem<System = S> + 't,
        C: Control<S> + 't,
        O: Observer<S>,
        E: Events<S>,
    {
        match self.attempt(q0, z0, interval) {
            (trajectory, None) => Ok(trajectory),
            (_, Some(error)) => Err(error),
        }
    }

    /// Like [`run`](Self::run), but gives the trajectory up to the last good state when the end is not reached, with
    /// the reason.
    #[cfg(feature = "alloc")]
    pub fn attempt<'t, S: GaussSystem>(
        self,
        q0: S::Configuration,
        z0: S::Speeds,
        interval: Range<S::Scalar>,
    ) -> (Trajectory<'t, S>, Option<IntegrationError>)
    where
        P: Problem<System = S> + 't,
        C: Control<S> + 't,
        O: Observer<S>,
        E: Events<S>,
    {
        let Self { problem, control, observer, events, every, limit } = self;
        let run = Run::kept(&problem, &control, every, limit);
        let (kept, error) = run.keep(events, observer, (q0, z0), interval);
        (Trajectory::new(kept, problem, control, every == 1), error)
    }

    /// Integrates without keeping anything, and gives the final state with the summary of the run; an observer sees the
    /// other states. Needs no memory.
    ///
    /// # Errors
    /// When the run does not reach the end.
    pub fn run_to_end<S: GaussSystem>(
        self,
        q0: S::Configuration,
        z0: S::Speeds,
        interval: Range<S::Scalar>,
    ) -> Result<End<S>, IntegrationError>
    where
        P: Problem<System = S>,
        C: Control<S>,
        O: Observer<S>,
        E: Events<S>,
    {
        let Self { problem, control, observer, events, every, limit } = self;
        Run::new(&problem, &control, every, limit).to_end(events, observer, (q0, z0), interval)
    }

    /// Begins a run that makes its steps one at a time, when it is asked to: for game loops, debuggers, couplings with
    /// other programs.
    ///
    /// # Errors
    /// When the run cannot begin.
    pub fn stepper<S: GaussSystem>(
        self,
        q0: S::Configuration,
        z0: S::Speeds,
        interval: Range<S::Scalar>,
    ) -> Result<Stepper<P, C, O, E>, IntegrationError>
    where
        P: Problem<System = S>,
        C: Control<S>,
        O: Observer<S>,
        E: Events<S>,
    {
        let Self { problem, control, observer, events, every, limit } = self;
        Stepper::new((problem, control), (observer, events), (every, limit), (q0, z0), interval)
    }

    /// The same simulation in a type that can be written, for a field of a struct. It can be run many times.
    #[cfg(feature = "alloc")]
    pub fn boxed<'k, S: GaussSystem>(self) -> BoxedSimulation<'k, S>
    where
        P: Problem<System = S> + 'k,
        C: Control<S> + 'k,
        O: Observer<S> + 'k,
        E: Events<S> + 'k,
    {
        let Self { problem, control, observer, events, every, limit } = self;
        BoxedSimulation::new((problem, control), (observer, events), every, limit)
    }
}
