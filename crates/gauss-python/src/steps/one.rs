//! One run.

use gauss_runtime::contact::{Contact, ContactSystem};
use gauss_runtime::integrate::drive::each::Each;
use gauss_runtime::integrate::{Control as Steps, EstimatingStep, IntegrationError, JacobianMethod, MethodPlace};
use gauss_runtime::prelude::*;

use super::control::{method, no_contacts};
use super::outcome::{InContact, Outcome, columns, energies, happened, number_of_end, row};
use super::request::{Control, Request};
use super::stepper::{AnyStepper, OwnStepper, stepper};
use super::stoppable::Stoppable;
use super::watching::{Moving, input, jump, of_numbers, watched};
use super::{configuration, contacts, vector, words};
use crate::methods::System;

/// Time, q and z, input.
type At<S> = fn(&S, f64, (&[f64], &[f64]), &[f64]) -> Result<InContact, String>;
type Run<S> = fn(&S, &Request<'_>) -> Result<Outcome, String>;
/// A run step by step.
type Begin<S> = fn(S, &Request<'_>) -> Result<Box<dyn AnyStepper>, String>;

/// The contacts of a system, and what is done with them.
#[derive(Clone, Copy, Debug)]
struct Contacts<S> {
    all: &'static [Contact],
    run: Run<S>,
    at: At<S>,
}

/// The runs of a system: by methods without contacts, and with contacts.
#[derive(Clone, Copy, Debug)]
pub struct Methods<S> {
    smooth: Run<S>,
    stepper: Begin<S>,
    contacts: Option<Contacts<S>>,
}

impl<S: System<Scalar = f64>> Methods<S> {
    /// Runs without contacts: `R` and `P` are [`JacobianMethod`] and [`Taylor`] where the system has what these need,
    /// as the words in `steps` of [`scene!`](crate::scene) say.
    #[must_use]
    pub fn new<R, P>() -> Self
    where
        for<'a> R: MethodPlace<JacobianMethod> + EstimatingStep<Stoppable<'a, S>> + 'static,
        for<'a> P: MethodPlace<Taylor> + Steps<Stoppable<'a, S>> + 'static,
        OwnStepper<S, R, P>: Send,
    {
        Self {
            smooth: |system, request| smooth::<S, R, P>(system, configuration(request.q)?, request),
            stepper: |system, request| stepper::<S, R, P>(system, configuration(request.q)?, request),
            contacts: None,
        }
    }

    /// Runs with these contacts, which are those of all kernels of the type.
    #[must_use]
    pub fn with_contacts(self, all: &'static [Contact]) -> Self
    where
        S: ContactSystem,
    {
        let contacts = Some(Contacts {
            all,
            run: |system, request| contacts::run(system, configuration(request.q)?, request),
            at: |system, t, (q, z), input| contacts::at(system, t, (configuration(q)?, z), input),
        });
        Self { contacts, ..self }
    }

    /// The contacts; none where the system has no such runs.
    #[must_use]
    pub fn touching(&self) -> &'static [Contact] {
        self.contacts.as_ref().map_or(&[], |contacts| contacts.all)
    }

    /// Acceleration at a state, with modes and forces of the contacts.
    ///
    /// # Errors
    /// Velocities jump there; there are no contacts.
    pub fn in_contact(&self, system: &S, t: f64, state: (&[f64], &[f64]), input: &[f64]) -> Result<InContact, String> {
        self.contacts
            .as_ref()
            .map_or(Err("the scene has no contacts".to_owned()), |own| (own.at)(system, t, state, input))
    }

    /// Begins a run of a kernel step by step, without its contacts.
    ///
    /// # Errors
    /// A first state that is none, a method that the system has not.
    pub fn stepper(&self, system: S, request: &Request<'_>) -> Result<Box<dyn AnyStepper>, String> {
        (self.stepper)(system, request)
    }

    /// Runs a kernel, without its contacts where the control has nothing to do with them.
    ///
    /// # Errors
    /// A first state that is none, a method that the system has not.
    pub fn simulate(&self, system: &S, request: &Request<'_>) -> Result<Outcome, String> {
        match (request.control, &self.contacts) {
            (Control::Smooth(..), _) => (self.smooth)(system, request),
            (_, Some(contacts)) => (contacts.run)(system, request),
            (_, None) => Err(no_contacts()),
        }
    }
}

/// A run by a method that was chosen by name.
///
/// # Errors
/// A method that needs a clause, or contacts; times of a controller that are no multiples of the step.
pub fn smooth<'a, S: Moving, R, P>(system: &'a S, q: S::Configuration, request: &Request<'a>) -> Result<Outcome, String>
where
    R: MethodPlace<JacobianMethod> + EstimatingStep<Stoppable<'a, S>>,
    P: MethodPlace<Taylor> + Steps<Stoppable<'a, S>>,
{
    run(&Stoppable::new(system, request.stop), q, request, method::<R, P>(request)?)
}

/// A run by any method.
fn run<'a, S: Moving, C: Steps<Stoppable<'a, S>>>(
    system: &Stoppable<'a, S>,
    q: S::Configuration,
    request: &Request<'_>,
    control: C,
) -> Result<Outcome, String> {
    let z = vector::<S::Speeds>(request.z);
    let simulation = Simulation::new(system)
        .input(|t: f64, q: &S::Configuration, z: &S::Speeds| input::<Stoppable<'a, S>>(request, t, q, z))
        .observe(|sample: &Sample<Stoppable<'a, S>>| (request.look)(sample.t))
        .events_by(
            Each::of(watched::<Stoppable<'a, S>>(request))
                .then(|place, state: &mut Sample<Stoppable<'a, S>>| jump(request, place, state)),
        )
        .control(control);
    let simulation = match request.limit {
        Some(limit) => simulation.max_steps(limit),
        None => simulation,
    };
    let interval = request.interval.0..request.interval.1;
    let (run, error) = match &request.controller {
        None => simulation.attempt(q, z, interval),
        Some(held) => {
            let law = |t: f64, q: &S::Configuration, z: &S::Speeds| of_numbers(held.law, t, q, z);
            simulation.sampled(held.period, law).delayed(held.delay).attempt(q, z, interval)
        }
    };
    outcome(system, request, &run, error)
}

/// The outcome of a run.
fn outcome<'a, S: Moving>(
    system: &Stoppable<'a, S>,
    request: &Request<'_>,
    run: &Trajectory<'_, Stoppable<'a, S>>,
    error: Option<IntegrationError>,
) -> Result<Outcome, String> {
    let interrupted = system.end();
    let states = match request.times {
        Some(times) => between(run, times)?,
        None => run.samples().to_vec(),
    };
    let rows = states.iter().map(|state| [row(state.t, &state.q, &state.z), energies(system, state)].concat());
    Ok(Outcome {
        columns: columns(rows),
        rows: states.len(),
        last: row(run.last().t, &run.last().q, &run.last().z),
        events: happened(request, run.events().iter().map(|event| (event.number, &event.sample))),
        stopped_by: run.stopped_by().map(|number| number_of_end(request, number)),
        summary: *run.summary(),
        touched: None,
        error: error.filter(|_| !interrupted).map(|error| format!("t = {}: {}", error.time, words(&error.kind))),
        interrupted,
    })
}

/// The states at these times, but those that the run did not come to.
fn between<S: GaussSystem<Scalar = f64>>(run: &Trajectory<'_, S>, times: &[f64]) -> Result<Vec<Sample<S>>, String> {
    let mut states = Vec::with_capacity(times.len());
    for &t in times {
        match run.at(t) {
            Ok(state) => states.push(state),
            Err(error) if matches!(error.kind, IntegrationErrorKind::OutsideRun { .. }) => {}
            Err(error) => return Err(format!("t = {}: {}", error.time, words(&error.kind))),
        }
    }
    Ok(states)
}
