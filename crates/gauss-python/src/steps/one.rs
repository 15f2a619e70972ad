//! One run.

use gauss_runtime::contact::{Contact, ContactSystem};
use gauss_runtime::integrate::drive::each::Each;
use gauss_runtime::integrate::{Adaptive, Collocation, Control as Steps, Fixed, IntegrationError};
use gauss_runtime::prelude::*;

use super::outcome::{InContact, Outcome, columns, energies, happened, number_of_end, row};
use super::request::{Control, Request, looking};
use super::stoppable::Stoppable;
use super::watching::{Moving, input, jump, of_numbers, watched};
use super::{configuration, contacts, vector, words};
use crate::methods::System;

/// The relative and the absolute tolerance, and the longest step.
type Tolerances = (f64, f64, f64);
/// Time, q and z, input.
type At<S> = fn(&S, f64, (&[f64], &[f64]), &[f64]) -> Result<InContact, String>;
type Stepper<S> = fn(&S, &Request<'_>, Tolerances) -> Result<Outcome, String>;

/// The contacts of a system, and what is done with them.
#[derive(Clone, Copy, Debug)]
struct Contacts<S> {
    all: &'static [Contact],
    run: fn(&S, &Request<'_>) -> Result<Outcome, String>,
    at: At<S>,
}

/// The methods of integration that only some systems have.
#[derive(Clone, Copy, Debug)]
pub struct Methods<S> {
    taylor: Option<Stepper<S>>,
    rosenbrock: Option<Stepper<S>>,
    contacts: Option<Contacts<S>>,
}

impl<S: System<Scalar = f64>> Methods<S> {
    /// None of them: each word in `steps` of [`scene!`](crate::scene) adds one.
    #[must_use]
    pub fn new() -> Self {
        Self { taylor: None, rosenbrock: None, contacts: None }
    }

    /// Power series.
    pub fn taylor(&mut self)
    where
        S: TaylorSystem,
    {
        self.taylor = Some(|system, request, (relative, absolute, largest)| {
            let control = Taylor::new(relative, absolute);
            let q = configuration::<S::Configuration>(request.q)?;
            run(&stoppable(system, request), q, request, bounded(control, largest, Taylor::largest_step))
        });
    }

    /// Rosenbrock's method, which needs derivatives by the state.
    pub fn rosenbrock(&mut self)
    where
        S: LinearizedSystem,
    {
        self.rosenbrock = Some(|system, request, tolerances| {
            stiff(system, configuration::<S::Configuration>(request.q)?, request, tolerances)
        });
    }

    /// Runs with these contacts, which are those of all kernels of the type.
    pub fn contacts(&mut self, all: &'static [Contact])
    where
        S: ContactSystem,
    {
        self.contacts = Some(Contacts {
            all,
            run: |system, request| contacts::run(system, configuration(request.q)?, request),
            at: |system, t, (q, z), input| contacts::at(system, t, (configuration(q)?, z), input),
        });
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

    /// Runs a kernel, without its contacts where the control has nothing to do with them.
    ///
    /// # Errors
    /// A first state that is none, a method that the system has not.
    pub fn simulate(&self, system: &S, request: &Request<'_>) -> Result<Outcome, String> {
        let q = configuration::<S::Configuration>(request.q)?;
        match request.control {
            Control::Adaptive(..) | Control::Fixed(_) | Control::Implicit(_) => smooth(system, q, request),
            Control::Stiff(relative, absolute, largest) => match self.rosenbrock {
                Some(stepper) => stepper(system, request, (relative, absolute, largest)),
                None => Err(lacks("rosenbrock", "linearize")),
            },
            Control::Taylor(relative, absolute, largest) => match self.taylor {
                Some(stepper) => stepper(system, request, (relative, absolute, largest)),
                None => Err(lacks("taylor", "taylor")),
            },
            Control::ContactEvents(..) | Control::ContactSteps(..) => match &self.contacts {
                Some(contacts) => (contacts.run)(system, request),
                None => Err(no_contacts()),
            },
        }
    }
}

impl<S: System<Scalar = f64>> Default for Methods<S> {
    fn default() -> Self {
        Self::new()
    }
}

/// A run by a method that every system has.
///
/// # Errors
/// Another method; times of a controller that are no multiples of the step.
pub fn smooth<S: Moving>(system: &S, q: S::Configuration, request: &Request<'_>) -> Result<Outcome, String> {
    let system = &stoppable(system, request);
    match request.control {
        Control::Adaptive(relative, absolute, largest) => {
            let control = looking(Adaptive::new(relative, absolute), request.input);
            run(system, q, request, bounded(control, largest, Adaptive::largest_step))
        }
        Control::Fixed(step) => run(system, q, request, Fixed::new(step)),
        Control::Implicit(step) => run(system, q, request, Fixed::by(Collocation::order_6(), step)),
        Control::Stiff(..) => Err(lacks("rosenbrock", "linearize")),
        Control::Taylor(..) => Err("the method taylor is one of compiled kernels".to_owned()),
        Control::ContactEvents(..) | Control::ContactSteps(..) => Err(no_contacts()),
    }
}

/// A run by Rosenbrock's method.
///
/// # Errors
/// Times of a controller that are no multiples of the step.
pub fn stiff<S: Moving + LinearizedSystem>(
    system: &S,
    q: S::Configuration,
    request: &Request<'_>,
    (relative, absolute, largest): Tolerances,
) -> Result<Outcome, String> {
    let control = looking(Adaptive::by(Rosenbrock, relative, absolute), request.input);
    run(&stoppable(system, request), q, request, bounded(control, largest, Adaptive::largest_step))
}

/// Message that a run with contacts needs some.
pub fn no_contacts() -> String {
    lacks("of contacts", "contact(…)")
}

/// Message that a method needs a clause, which its struct does not say.
pub fn lacks(method: &str, clause: &str) -> String {
    format!(
        "the method {method} needs `#[gauss({clause})]` at the struct, which does not say it; models of `gauss.load` \
         take `clauses=[\"{clause}\"]`"
    )
}

fn stoppable<'a, S>(system: &'a S, request: &Request<'a>) -> Stoppable<'a, S> {
    Stoppable::new(system, request.stop)
}

fn bounded<C>(control: C, largest: f64, bound: impl Fn(C, f64) -> C) -> C {
    if largest.is_finite() { bound(control, largest) } else { control }
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
