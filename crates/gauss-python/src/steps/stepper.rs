//! One run step by step, the type of its system forgotten.

use std::cell::Cell;

use gauss_runtime::integrate::drive::each::Each;
use gauss_runtime::integrate::drive::event::NoEvents;
use gauss_runtime::integrate::drive::observer::Unobserved;
use gauss_runtime::integrate::{
    Control as Steps, EstimatingStep, InputSource, IntegrationError, JacobianMethod, MethodControl, MethodPlace,
    Problem, Rates, State, StepOutcome, Stepper, SystemProblem, VelocityForm,
};
use gauss_runtime::prelude::*;

use super::control::method;
use super::outcome::row;
use super::request::{Input, Request, Watched};
use super::stoppable::Stoppable;
use super::watching::{Moving, number};
use super::{vector, words};

/// A run that makes a step when it is asked to, and owns all that it needs.
pub trait AnyStepper: Send {
    /// Makes a step.
    ///
    /// # Errors
    /// No step can be made.
    fn step(&mut self) -> Result<StepOutcome, String>;
    /// Sets the input from here on: where it is another one, steps begin anew.
    ///
    /// # Errors
    /// No step can begin.
    fn act(&mut self, input: &[f64]) -> Result<(), String>;
    /// Time, and the numbers of q and z, where the run is.
    fn state(&self) -> Vec<f64>;
    /// The same at a time within the last step.
    ///
    /// # Errors
    /// Another time.
    fn at(&self, t: f64) -> Result<Vec<f64>, String>;
    /// The steps that were made, and those that were tried in vain.
    fn counts(&self) -> [u64; 2];
}

/// An input that is the same at all times.
struct Constant<U>(U);

impl<S: GaussSystem<Input = U>, U: Copy> InputSource<S> for Constant<U> {
    fn input(&self, _: S::Scalar, _: &S::Configuration, _: &S::Speeds) -> U {
        self.0
    }
}

/// A system of its own, with the input that acts until the next one is given.
pub struct Motion<S: Moving + 'static> {
    system: Stoppable<'static, S>,
    input: Cell<S::Input>,
}

impl<S: Moving> Motion<S> {
    /// The problem that `simulate` has.
    fn held(&self) -> SystemProblem<'_, Stoppable<'static, S>, VelocityForm, Constant<S::Input>> {
        SystemProblem { system: &self.system, form: VelocityForm, input: Constant(self.input.get()) }
    }
}

impl<S: Moving> Problem for Motion<S> {
    type System = Stoppable<'static, S>;

    fn system(&self) -> &Self::System {
        &self.system
    }

    fn input(&self, t: f64, q: &S::Configuration, z: &S::Speeds) -> S::Input {
        self.held().input(t, q, z)
    }

    fn variables(&self, t: f64, q: &S::Configuration, z: &S::Speeds) -> S::Speeds {
        self.held().variables(t, q, z)
    }

    fn of_momentum(&self, t: f64, q: &S::Configuration, p: &S::Speeds) -> S::Speeds {
        self.held().of_momentum(t, q, p)
    }

    fn speeds(&self, t: f64, q: &S::Configuration, y: &S::Speeds) -> S::Speeds {
        self.held().speeds(t, q, y)
    }

    fn momentum(&self, t: f64, q: &S::Configuration, y: &S::Speeds) -> S::Speeds {
        self.held().momentum(t, q, y)
    }

    fn rates(&self, state: &State<Self::System>) -> Rates<Self::System> {
        self.held().rates(state)
    }

    fn both_rates(&self, state: &State<Self::System>, known: &S::Speeds) -> (S::Speeds, S::Speeds) {
        self.held().both_rates(state, known)
    }

    fn change_of_speeds(&self, state: &State<Self::System>, change: &Rates<Self::System>) -> Rates<Self::System> {
        self.held().change_of_speeds(state, change)
    }
}

/// A number whose zero ends the run.
type End<S> = Box<dyn Fn(f64, &<S as GaussSystem>::Configuration, &<S as GaussSystem>::Speeds) -> f64 + Send>;
/// A run of a system of its own by one of the methods.
pub type OwnStepper<S, R, P> = Stepper<Motion<S>, MethodControl<f64, R, P>, Unobserved, Each<NoEvents, End<S>>>;

fn told(error: &IntegrationError) -> String {
    format!("t = {}: {}", error.time, words(&error.kind))
}

impl<S, R, P> AnyStepper for OwnStepper<S, R, P>
where
    S: Moving + 'static,
    R: MethodPlace<JacobianMethod> + EstimatingStep<Stoppable<'static, S>>,
    P: MethodPlace<Taylor> + Steps<Stoppable<'static, S>>,
    Self: Send,
{
    fn step(&mut self) -> Result<StepOutcome, String> {
        Stepper::step(self).map_err(|error| told(&error))
    }

    fn act(&mut self, input: &[f64]) -> Result<(), String> {
        let (known, input): (_, S::Input) = (&self.problem().input, vector(input));
        if (0..S::Input::DIM).all(|i| input.component(i) == known.get().component(i)) {
            return Ok(());
        }
        known.set(input);
        self.renew().map_err(|error| told(&error))
    }

    fn state(&self) -> Vec<f64> {
        let state = Stepper::state(self);
        row(state.t, &state.q, &state.z)
    }

    fn at(&self, t: f64) -> Result<Vec<f64>, String> {
        match Stepper::at(self, t) {
            Ok(state) => Ok(row(state.t, &state.q, &state.z)),
            Err(error) if matches!(error.kind, IntegrationErrorKind::OutsideRun { .. }) => {
                Err(format!("the time {t} is outside of the last step"))
            }
            Err(error) => Err(told(&error)),
        }
    }

    fn counts(&self) -> [u64; 2] {
        let summary = self.summary();
        [summary.steps, summary.rejected]
    }
}

/// A run step by step, under a constant input and with ends at numbers, by a method that was chosen by name.
///
/// # Errors
/// A method that needs a clause; a first state from which no run can begin; functions.
pub fn stepper<S: Moving + 'static, R, P>(
    system: S,
    q: S::Configuration,
    request: &Request<'_>,
) -> Result<Box<dyn AnyStepper>, String>
where
    R: MethodPlace<JacobianMethod> + EstimatingStep<Stoppable<'static, S>> + 'static,
    P: MethodPlace<Taylor> + Steps<Stoppable<'static, S>> + 'static,
    OwnStepper<S, R, P>: Send,
{
    let Input::Constant(input) = request.input else { return Err("the input of steps is an array".to_owned()) };
    let ends = request.until.iter().map(|until| match until.watched {
        Watched::Number(place, value) => {
            Ok((Box::new(number::<S>(place, value)) as End<S>, until.crossing, [until.ends(), false, false]))
        }
        Watched::Function(_) => Err("an end of steps is a number by its name".to_owned()),
    });
    let ends = ends.collect::<Result<Vec<_>, String>>()?;
    let motion = Motion { system: Stoppable::own(system), input: Cell::new(vector(input)) };
    let simulation = Simulation::of(motion).events_by(Each::of(ends)).control(method::<R, P>(request)?);
    let simulation = match request.limit {
        Some(limit) => simulation.max_steps(limit),
        None => simulation,
    };
    let begun: Result<OwnStepper<S, R, P>, _> =
        simulation.stepper(q, vector(request.z), request.interval.0..request.interval.1);
    begun.map(|stepper| Box::new(stepper) as Box<dyn AnyStepper>).map_err(|error| told(&error))
}
