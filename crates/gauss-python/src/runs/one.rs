//! One run.

use std::sync::atomic::Ordering;

use gauss_runtime::integrate::Summary;
use gauss_runtime::prelude::*;

use super::request::{Control, Function, Input, Request, Until, Watched};
use super::stoppable::Stoppable;
use super::{components, configuration, numbers_of, vector};
use crate::methods::System;

/// A run with its states, column by column: time, the numbers of q and z, kinetic and potential energy.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The columns, one after the other.
    pub columns: Vec<f64>,
    /// How many states there are.
    pub rows: usize,
    /// The end that it came to before its time, by its number.
    pub stopped_by: Option<usize>,
    /// Its steps.
    pub summary: Summary,
    /// Why it did not reach its end.
    pub error: Option<String>,
    /// It was told to stop.
    pub interrupted: bool,
}

type Watch<'a, S> = Box<
    dyn Fn(<S as GaussSystem>::Scalar, &<S as GaussSystem>::Configuration, &<S as GaussSystem>::Speeds) -> f64 + 'a,
>;

/// Runs a kernel.
///
/// # Errors
/// A first state that is none.
pub fn simulate<S: System<Scalar = f64>>(system: &S, request: &Request<'_>) -> Result<Outcome, String> {
    let (q, z) = (configuration::<S::Configuration>(request.q)?, vector::<S::Speeds>(request.z));
    let system = Stoppable { system, stop: request.stop };
    // Ends are numbered by direction: where each was in the list.
    let of = |crossing: Crossing| request.until.iter().enumerate().filter(move |(_, until)| until.crossing == crossing);
    let directions = [Crossing::Any, Crossing::Rising, Crossing::Falling];
    let order: Vec<usize> = directions.into_iter().flat_map(of).map(|(number, _)| number).collect();
    let [any, rising, falling] = directions.map(|crossing| of(crossing).map(|(_, until)| watch::<S>(until)).collect());
    let source = |t: f64, q: &S::Configuration, z: &S::Speeds| match &request.input {
        Input::Function(function) => of_numbers(*function, t, q, z),
        input => input.at(t, |number| number(0)),
    };
    let simulation = Simulation::new(&system)
        .input(source)
        .observe(|_| (request.look)())
        .until_each(Crossing::Any, any)
        .until_each(Crossing::Rising, rising)
        .until_each(Crossing::Falling, falling);
    let simulation = match request.limit {
        Some(limit) => simulation.max_steps(limit),
        None => simulation,
    };
    let interval = request.interval.0..request.interval.1;
    let (run, error) = match request.control {
        Control::Adaptive(relative, absolute, largest) => {
            let simulation = simulation.adaptive(relative, absolute);
            let simulation = if largest.is_finite() { simulation.largest_step(largest) } else { simulation };
            simulation.attempt(q, z, interval)
        }
        Control::Fixed(step) => simulation.fixed_step(step).attempt(q, z, interval),
    };
    // States between steps are made by the system, which must go on for that.
    let interrupted = request.stop.swap(false, Ordering::Relaxed);
    let states = match request.times {
        Some(times) => between(&run, times)?,
        None => run.samples().to_vec(),
    };
    Ok(Outcome {
        columns: columns(&system, &states),
        rows: states.len(),
        stopped_by: run.stopped_by().map(|number| order[number]),
        summary: *run.summary(),
        error: error.filter(|_| !interrupted).map(|error| format!("t = {}: {}", error.time, error.kind)),
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

fn watch<'a, S: System<Scalar = f64>>(until: &'a Until<'a>) -> Watch<'a, S> {
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
            Err(error) => return Err(format!("t = {}: {}", error.time, error.kind)),
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
