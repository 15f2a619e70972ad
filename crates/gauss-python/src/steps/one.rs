//! One run.

use std::sync::atomic::Ordering;

use gauss_runtime::integrate::{Adaptive, Collocation, Control as Steps, Fixed, IntegrationError, Summary};
use gauss_runtime::prelude::*;

use super::request::{Control, Function, Input, Request, Until, Watched};
use super::stoppable::Stoppable;
use super::{components, configuration, numbers_of, vector, words};
use crate::methods::System;

/// A run with its states, column by column: time, the numbers of q and z, kinetic and potential energy.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The columns, one after the other.
    pub columns: Vec<f64>,
    /// How many states there are.
    pub rows: usize,
    /// When it ended.
    pub reached: f64,
    /// Events in the order in which they happened, the end of the run not among them.
    pub events: Vec<Event>,
    /// The end that it came to before its time, by its number among the ends.
    pub stopped_by: Option<usize>,
    /// Its steps.
    pub summary: Summary,
    /// Why it did not reach its end.
    pub error: Option<String>,
    /// It was told to stop.
    pub interrupted: bool,
}

/// A state in which something happened.
#[derive(Clone, Debug, PartialEq)]
pub struct Event {
    /// Which, of those that do not end the run.
    pub number: usize,
    /// Time, and the numbers of q and z.
    pub row: Vec<f64>,
}

/// The relative and the absolute tolerance, and the longest step.
type Tolerances = (f64, f64, f64);
type Stepper<S> = fn(&S, &Request<'_>, Tolerances) -> Result<Outcome, String>;

/// The methods of integration that only some systems have.
#[derive(Clone, Copy, Debug)]
pub struct Methods<S> {
    taylor: Option<Stepper<S>>,
    rosenbrock: Option<Stepper<S>>,
}

impl<S: System<Scalar = f64>> Methods<S> {
    /// None of them: each word in `steps` of [`scene!`](crate::scene) adds one.
    #[must_use]
    pub fn new() -> Self {
        Self { taylor: None, rosenbrock: None }
    }

    /// Power series.
    pub fn taylor(&mut self)
    where
        S: TaylorSystem,
    {
        self.taylor = Some(|system, request, (relative, absolute, largest)| {
            let control = Taylor::new(relative, absolute);
            run(&stoppable(system, request), request, bounded(control, largest, Taylor::largest_step))
        });
    }

    /// Rosenbrock's method, which needs derivatives by the state.
    pub fn rosenbrock(&mut self)
    where
        S: LinearizedSystem,
    {
        self.rosenbrock = Some(|system, request, (relative, absolute, largest)| {
            let control = Adaptive::by(Rosenbrock, relative, absolute);
            run(&stoppable(system, request), request, bounded(control, largest, Adaptive::largest_step))
        });
    }

    /// Runs a kernel.
    ///
    /// # Errors
    /// A first state that is none, a method that the system has not.
    pub fn simulate(&self, system: &S, request: &Request<'_>) -> Result<Outcome, String> {
        let wrapped = stoppable(system, request);
        let lacks = |method: &str, clause: &str| {
            Err(format!("the method {method} needs `#[gauss({clause})]` at the struct, which does not say it"))
        };
        match request.control {
            Control::Adaptive(relative, absolute, largest) => {
                let control = Adaptive::new(relative, absolute);
                run(&wrapped, request, bounded(control, largest, Adaptive::largest_step))
            }
            Control::Fixed(step) => run(&wrapped, request, Fixed::new(step)),
            Control::Implicit(step) => run(&wrapped, request, Fixed::by(Collocation::order_6(), step)),
            Control::Stiff(relative, absolute, largest) => match self.rosenbrock {
                Some(stepper) => stepper(system, request, (relative, absolute, largest)),
                None => lacks("rosenbrock", "linearize"),
            },
            Control::Taylor(relative, absolute, largest) => match self.taylor {
                Some(stepper) => stepper(system, request, (relative, absolute, largest)),
                None => lacks("taylor", "taylor"),
            },
        }
    }
}

impl<S: System<Scalar = f64>> Default for Methods<S> {
    fn default() -> Self {
        Self::new()
    }
}

fn stoppable<'a, S>(system: &'a S, request: &Request<'a>) -> Stoppable<'a, S> {
    Stoppable { system, stop: request.stop }
}

fn bounded<C>(control: C, largest: f64, bound: impl Fn(C, f64) -> C) -> C {
    if largest.is_finite() { bound(control, largest) } else { control }
}

/// What a run needs of a system.
trait Moving: GaussSystem<Scalar = f64, Input: VectorSpace<f64>> {}

impl<S: GaussSystem<Scalar = f64, Input: VectorSpace<f64>>> Moving for S {}

type Watch<'a, S> = Box<
    dyn Fn(<S as GaussSystem>::Scalar, &<S as GaussSystem>::Configuration, &<S as GaussSystem>::Speeds) -> f64 + 'a,
>;

/// The functions of some direction that end a run or do not, and the number of each among those.
fn watched<'a, S: Moving>(request: &'a Request<'_>, ends: bool, crossing: Crossing) -> (Vec<Watch<'a, S>>, Vec<usize>) {
    let all = request.until.iter().filter(|until| until.ends == ends).enumerate();
    all.filter(|(_, until)| until.crossing == crossing).map(|(number, until)| (watch::<S>(until), number)).unzip()
}

const DIRECTIONS: [Crossing; 3] = [Crossing::Any, Crossing::Rising, Crossing::Falling];

/// A run by any method.
fn run<S: Moving, C: Steps<S>>(system: &S, request: &Request<'_>, control: C) -> Result<Outcome, String> {
    let (q, z) = (configuration::<S::Configuration>(request.q)?, vector::<S::Speeds>(request.z));
    let [events, ends] = [false, true].map(|ends| DIRECTIONS.map(|crossing| watched::<S>(request, ends, crossing)));
    let numbers =
        |lists: &[(Vec<Watch<'_, S>>, Vec<usize>); 3]| lists.each_ref().map(|(_, list)| list.clone()).concat();
    let numbers = [numbers(&events), numbers(&ends)];
    let ([any, rising, falling], [end, end_rising, end_falling]) =
        (events.map(|(list, _)| list), ends.map(|(list, _)| list));
    let source = |t: f64, q: &S::Configuration, z: &S::Speeds| match &request.input {
        Input::Function(function) => of_numbers(*function, t, q, z),
        input => input.at(t, |number| number(0)),
    };
    let simulation = Simulation::new(system)
        .input(source)
        .observe(|sample: &Sample<S>| (request.look)(sample.t))
        .event_each(Crossing::Any, any)
        .event_each(Crossing::Rising, rising)
        .event_each(Crossing::Falling, falling)
        .until_each(Crossing::Any, end)
        .until_each(Crossing::Rising, end_rising)
        .until_each(Crossing::Falling, end_falling)
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
    outcome(system, request, (&run, error), &numbers)
}

/// What became of a run; `numbers` are those of events and of ends in the order in which the run has them.
fn outcome<S: Moving>(
    system: &S,
    request: &Request<'_>,
    (run, error): (&Trajectory<'_, S>, Option<IntegrationError>),
    [events, ends]: &[Vec<usize>; 2],
) -> Result<Outcome, String> {
    // States between steps are made by the system, which must go on for that.
    let interrupted = request.stop.swap(false, Ordering::Relaxed);
    let states = match request.times {
        Some(times) => between(run, times)?,
        None => run.samples().to_vec(),
    };
    let happened = run.events().iter().filter_map(|event| {
        let number = *events.get(event.number)?;
        let Sample { t, q, z, .. } = &event.sample;
        Some(Event { number, row: [vec![*t], numbers_of(q), components(z)].concat() })
    });
    Ok(Outcome {
        columns: columns(system, &states),
        rows: states.len(),
        reached: run.last().t,
        events: happened.collect(),
        stopped_by: run.stopped_by().map(|number| ends[number - events.len()]),
        summary: *run.summary(),
        error: error.filter(|_| !interrupted).map(|error| format!("t = {}: {}", error.time, words(&error.kind))),
        interrupted,
    })
}

/// The input that a function gives.
fn of_numbers<Q: Configuration<Scalar = f64>, Z: VectorSpace<f64>, U: VectorSpace<f64>>(
    function: Function<'_, Vec<f64>>,
    t: f64,
    q: &Q,
    z: &Z,
) -> U {
    vector(&function(t, &numbers_of(q), &components(z)))
}

fn watch<'a, S: Moving>(until: &'a Until<'a>) -> Watch<'a, S> {
    match until.watched {
        Watched::Number(place, value) => Box::new(move |_, q, z| {
            let size = <<S::Configuration as Configuration>::Components as VectorSpace<f64>>::DIM;
            let number = if place < size { q.components().component(place) } else { z.component(place - size) };
            number - value
        }),
        Watched::Function(function) => Box::new(move |t, q, z| function(t, &numbers_of(q), &components(z))),
    }
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

fn columns<S: GaussSystem<Scalar = f64>>(system: &S, states: &[Sample<S>]) -> Vec<f64> {
    let row = |state: &Sample<S>| {
        let (t, q, z) = (state.t, &state.q, &state.z);
        let energies = [system.kinetic_energy(t, q, z), system.potential_energy(t, q)];
        [vec![t], numbers_of(q), components(z), energies.to_vec()].concat()
    };
    let count = 1 + <<S::Configuration as Configuration>::Components as VectorSpace<f64>>::DIM + S::DOF + 2;
    let mut columns = vec![0.0; count * states.len()];
    for (n, state) in states.iter().enumerate() {
        for (column, number) in row(state).into_iter().enumerate() {
            columns[column * states.len() + n] = number;
        }
    }
    columns
}
