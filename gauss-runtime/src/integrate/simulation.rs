//! The front of the integrators: say what, in which form and how accurately, then run.

use core::ops::Range;

use super::control::{Adaptive, Control, Fixed};
use super::error::IntegrationError;
use super::form::{Feedback, Form, InputSource, MomentumForm, NoInput, Problem, Rates, State, VelocityForm};
use super::trajectory::Sample;
#[cfg(feature = "alloc")]
use super::trajectory::Trajectory;
use crate::configuration::Configuration;
use crate::system::GaussSystem;

/// Nothing is chosen yet; [`Simulation::fixed_step`] or [`Simulation::adaptive`] comes next.
#[derive(Clone, Copy, Debug, Default)]
pub struct Undecided;

/// Sees the samples of a run as they come.
pub trait Observer<S: GaussSystem> {
    /// One sample, in the order of integration.
    fn see(&mut self, sample: &Sample<S>);
}

/// Nobody looks.
#[derive(Clone, Copy, Debug, Default)]
pub struct Unobserved;

impl<S: GaussSystem> Observer<S> for Unobserved {
    fn see(&mut self, _: &Sample<S>) {}
}

/// A function that is called with every sample.
#[derive(Clone, Copy, Debug)]
pub struct Callback<G>(G);

impl<S: GaussSystem, G: FnMut(&Sample<S>)> Observer<S> for Callback<G> {
    fn see(&mut self, sample: &Sample<S>) {
        (self.0)(sample);
    }
}

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
/// Constraints that coordinates and speeds do not solve by themselves hold up to rounding in every sample, because each step
/// ends with a projection ([`GaussSystem::project`]). Initial values must satisfy them as well, up to the rounding
/// of what was typed.
#[derive(Clone, Copy, Debug)]
#[must_use = "a simulation does nothing before `run`"]
pub struct Simulation<'k, S, F = VelocityForm, I = NoInput, C = Undecided, O = Unobserved> {
    problem: Problem<'k, S, F, I>,
    control: C,
    observer: O,
    every: u64,
    limit: u64,
}

impl<'k, S: GaussSystem> Simulation<'k, S> {
    /// A run of a kernel, in velocity form and without inputs unless said otherwise.
    pub fn new(system: &'k S) -> Self {
        let problem = Problem { system, form: VelocityForm, input: NoInput };
        Self { problem, control: Undecided, observer: Unobserved, every: 1, limit: u64::MAX }
    }
}

impl<'k, S: GaussSystem, F, I, C, O> Simulation<'k, S, F, I, C, O> {
    /// Which variables are integrated: [`VelocityForm`] or [`MomentumForm`].
    pub fn form<G: Form<S>>(self, form: G) -> Simulation<'k, S, G, I, C, O> {
        let Self { problem: Problem { system, input, .. }, control, observer, every, limit } = self;
        Simulation { problem: Problem { system, form, input }, control, observer, every, limit }
    }

    /// Integrates momenta instead of quasi-velocities.
    pub fn momentum_form(self) -> Simulation<'k, S, MomentumForm, I, C, O> {
        self.form(MomentumForm)
    }

    /// The input as a function of time and state. It is called at every stage of every step: it should depend on its
    /// arguments only, and smoothly.
    pub fn input<G>(self, input: G) -> Simulation<'k, S, F, Feedback<G>, C, O>
    where
        G: Fn(S::Scalar, &S::Configuration, &S::Speeds) -> S::Input,
    {
        self.input_from(Feedback(input))
    }

    /// The input from a type that implements [`InputSource`]: a controller with parameters of its own, or a table.
    pub fn input_from<J: InputSource<S>>(self, input: J) -> Simulation<'k, S, F, J, C, O> {
        let Self { problem: Problem { system, form, .. }, control, observer, every, limit } = self;
        Simulation { problem: Problem { system, form, input }, control, observer, every, limit }
    }

    /// Steps of one length, by the Runge–Kutta–Munthe-Kaas method of order 4; the last step is shortened to end in time.
    pub fn fixed_step(self, step: S::Scalar) -> Simulation<'k, S, F, I, Fixed<S::Scalar>, O> {
        self.control(Fixed::new(step))
    }

    /// Steps as long as the tolerances allow, by the Dormand–Prince pair 5(4) on the group.
    pub fn adaptive(self, relative: f64, absolute: f64) -> Simulation<'k, S, F, I, Adaptive<S::Scalar>, O> {
        self.control(Adaptive::new(relative, absolute))
    }

    /// Any method with its choice of steps.
    pub fn control<D: Control<S>>(self, control: D) -> Simulation<'k, S, F, I, D, O> {
        let Self { problem, observer, every, limit, .. } = self;
        Simulation { problem, control, observer, every, limit }
    }

    /// Calls a function with every sample as it comes.
    pub fn observe<G: FnMut(&Sample<S>)>(self, observer: G) -> Simulation<'k, S, F, I, C, Callback<G>> {
        let Self { problem, control, every, limit, .. } = self;
        Simulation { problem, control, observer: Callback(observer), every, limit }
    }

    /// Hands out the first, the last, and every n-th state only (0 counts as 1).
    pub fn every(mut self, n: u64) -> Self {
        self.every = n.max(1);
        self
    }

    /// The most steps (rejected ones included) before the run is given up.
    pub fn max_steps(mut self, limit: u64) -> Self {
        self.limit = limit;
        self
    }
}

impl<S: GaussSystem, F, I, O, const N: usize> Simulation<'_, S, F, I, Adaptive<S::Scalar, N>, O> {
    /// The length of the first step, instead of an estimate.
    pub fn first_step(mut self, length: f64) -> Self {
        self.control.first_step = Some(length);
        self
    }

    /// The longest step.
    pub fn largest_step(mut self, length: f64) -> Self {
        self.control.largest_step = length;
        self
    }
}

impl<S, F, I, C, O> Simulation<'_, S, F, I, C, O>
where
    S: GaussSystem,
    F: Form<S>,
    I: InputSource<S>,
    C: Control<S>,
    O: Observer<S>,
{
    /// Integrates from (q₀, z₀) over the interval, which may run backwards, and keeps every sample.
    ///
    /// # Errors
    /// When the run does not reach the end; [`attempt`](Self::attempt) then gives what there is.
    #[cfg(feature = "alloc")]
    pub fn run(
        self,
        q0: S::Configuration,
        z0: S::Speeds,
        interval: Range<S::Scalar>,
    ) -> Result<Trajectory<S>, IntegrationError> {
        match self.attempt(q0, z0, interval) {
            (trajectory, None) => Ok(trajectory),
            (_, Some(error)) => Err(error),
        }
    }

    /// Like [`run`](Self::run), but gives the trajectory up to the last good state when the end is not reached, with the
    /// reason.
    #[cfg(feature = "alloc")]
    pub fn attempt(
        mut self,
        q0: S::Configuration,
        z0: S::Speeds,
        interval: Range<S::Scalar>,
    ) -> (Trajectory<S>, Option<IntegrationError>) {
        let start = self.start(q0, &z0, interval.start);
        let problem = &self.problem;
        let mut trajectory = Trajectory::starting_with(sample_of(problem, &start));
        let (every, observer) = (self.every, &mut self.observer);
        let mut first = true;
        let mut record = |state: &State<S>, rates: &Rates<S>| {
            let sample = sample_of(problem, state);
            trajectory.record(first, problem, &sample, state, rates);
            observer.see(&sample);
            first = false;
        };
        let outcome = drive(&self.control, problem, start, interval.end, self.limit, every, &mut record);
        (trajectory, outcome.err())
    }

    /// Integrates without keeping anything, and gives the final state; an observer sees the others. Needs no memory.
    ///
    /// # Errors
    /// When the run does not reach the end.
    pub fn run_to_end(
        mut self,
        q0: S::Configuration,
        z0: S::Speeds,
        interval: Range<S::Scalar>,
    ) -> Result<Sample<S>, IntegrationError> {
        let start = self.start(q0, &z0, interval.start);
        let (problem, observer) = (&self.problem, &mut self.observer);
        let mut see = |state: &State<S>, _: &Rates<S>| observer.see(&sample_of(problem, state));
        let end = drive(&self.control, problem, start, interval.end, self.limit, self.every, &mut see)?;
        Ok(sample_of(problem, &end))
    }

    fn start(&self, q0: S::Configuration, z0: &S::Speeds, t: S::Scalar) -> State<S> {
        let q = q0.renormalise();
        State { t, q, y: self.problem.form.variables(self.problem.system, t, &q, z0) }
    }
}

/// Both velocities and momenta of a state.
fn sample_of<S: GaussSystem, F: Form<S>, I>(problem: &Problem<'_, S, F, I>, state: &State<S>) -> Sample<S> {
    let State { t, q, y } = *state;
    let z = problem.form.speeds(problem.system, t, &q, &y);
    Sample { t, q, z, p: problem.form.momentum(problem.system, t, &q, &y) }
}

/// Runs the method and passes on the first, every n-th and the last state reached.
fn drive<S, F, I, C>(
    control: &C,
    problem: &Problem<'_, S, F, I>,
    start: State<S>,
    end: S::Scalar,
    limit: u64,
    every: u64,
    pass: &mut dyn FnMut(&State<S>, &Rates<S>),
) -> Result<State<S>, IntegrationError>
where
    S: GaussSystem,
    F: Form<S>,
    I: InputSource<S>,
    C: Control<S>,
{
    let mut count = 0_u64;
    // The last state, when it was not passed on: it is, at the end or at an error.
    let mut held = None;
    let outcome = control.drive(problem, start, end, limit, &mut |state, rates| {
        if count.is_multiple_of(every) {
            pass(state, rates);
            held = None;
        } else {
            held = Some((*state, *rates));
        }
        count += 1;
    });
    if let Some((state, rates)) = held {
        pass(&state, &rates);
    }
    outcome
}
