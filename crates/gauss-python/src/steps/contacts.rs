//! Runs with contacts from event to event, and what all runs with contacts give.

use std::sync::atomic::Ordering;

use gauss_contact::{ContactRecord, ContactRun, ContactTrajectory, EventKind, Mode};
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::integrate::drive::each::Each;
use gauss_runtime::integrate::{Adaptive, Summary};
use gauss_runtime::prelude::*;

use super::causes::of_contacts;
use super::outcome::{self, Happening, InContact, Outcome, Touched};
use super::request::{Control, Request};
use super::watching::{Watch, input, watched};
use super::{components, configuration, contact_steps, vector};
use crate::methods::System;

/// What runs with contacts need of a system.
pub(super) trait Touching: System<Scalar = f64> + ContactSystem {}

impl<S: System<Scalar = f64> + ContactSystem> Touching for S {}

/// A run with contacts.
///
/// # Errors
/// A first state that is none; times of a controller that are no multiples of the step.
pub fn run<S: System<Scalar = f64> + ContactSystem>(system: &S, request: &Request<'_>) -> Result<Outcome, String> {
    let start = (configuration::<S::Configuration>(request.q)?, vector::<S::Speeds>(request.z));
    match request.control {
        Control::ContactSteps(length, scheme, law) => contact_steps::run(system, request, start, (length, scheme, law)),
        _ => by_events(system, request, start),
    }
}

/// What contacts do at a state: a run of no length decides it.
///
/// # Errors
/// A state that is none, or at which velocities jump.
pub fn at<S: System<Scalar = f64> + ContactSystem>(
    system: &S,
    t: f64,
    (q, z): (&[f64], &[f64]),
    input: &[f64],
) -> Result<InContact, String> {
    let (q, z, u) = (configuration::<S::Configuration>(q)?, vector::<S::Speeds>(z), vector::<S::Input>(input));
    let run = ContactRun::new(system).adaptive(1e-9, 1e-9).input(move |_: f64, _: &S::Configuration, _: &S::Speeds| u);
    let run = run.run(q, z, t..t).map_err(|error| of_contacts(&error))?;
    if let Some(struck) = run.events().iter().find(|event| matches!(event.kind, EventKind::Impact(_))) {
        return Err(format!(
            "contact {} is closing: velocities jump there, and forces are not finite",
            struck.name::<S>()
        ));
    }
    let (forces, modes) = (run.forces(t), run.modes(t));
    let (forces, modes) = (forces.map_err(|error| of_contacts(&error))?, modes.map_err(|error| of_contacts(&error))?);
    let free = system.impulse_dynamics(t, &q, &z, &u);
    let pushed = system.impulse_velocities(&free.response.factors, &forces);
    let word = |mode: &Mode| match mode {
        Mode::Open => "open",
        Mode::Closed => "closed",
        Mode::Sticks => "sticks",
        Mode::Slides(_) => "slides",
    };
    Ok(InContact {
        acceleration: components(&free.acceleration.add_scaled(1.0, &pushed)),
        modes: modes.iter().map(word).collect(),
        forces: components(forces.rows()),
    })
}

/// A state with its energies and the columns of its contacts.
fn row<S: Touching>(system: &S, sample: &Sample<S>, forces: Option<&S::ContactRows>) -> Vec<f64> {
    let Sample { t, q, z, .. } = sample;
    let mut row = outcome::row(*t, q, z);
    row.extend(outcome::energies(system, sample));
    let (gaps, rates) = (system.gaps(*t, q), system.contact_rates(*t, q, z));
    let force = |row: usize| forces.map_or(f64::NAN, |forces| forces.component(row));
    for (i, contact) in S::CONTACTS.iter().enumerate() {
        if contact.has_gap() {
            row.extend([gaps.component(i), force(contact.normal)]);
        }
        row.extend(contact.friction_rows().flat_map(|k| [rates.component(k), force(k)]));
    }
    row
}

/// The function that ends a run that is told to stop: it has no value then. It is looked at in every step.
pub(super) fn unless_stopped<'a, Q, Z>(request: &'a Request<'_>) -> Watch<'a, Q, Z> {
    Box::new(move |t, _, _| {
        (request.look)(t);
        if request.stop.load(Ordering::Relaxed) { f64::NAN } else { 1.0 }
    })
}

fn by_events<S: Touching>(
    system: &S,
    request: &Request<'_>,
    (q, z): (S::Configuration, S::Speeds),
) -> Result<Outcome, String> {
    let Control::ContactEvents(relative, absolute, largest, law) = request.control else {
        return Err("runs with contacts go from event to event, or in steps".to_owned());
    };
    let control = Adaptive::new(relative, absolute);
    let control = if largest.is_finite() { control.largest_step(largest) } else { control };
    let stop = (unless_stopped(request), Crossing::Any, [true, false]);
    let run = ContactRun::new(system)
        .control(control)
        .tolerance(relative, absolute)
        .law(law)
        .input(|t: f64, q: &S::Configuration, z: &S::Speeds| input::<S>(request, t, q, z))
        .events_by(Each::of(watched::<S>(request).chain([stop])));
    let run = match request.limit {
        Some(limit) => run.max_steps(limit),
        None => run,
    };
    let (run, error) = run.attempt(q, z, request.interval.0..request.interval.1);
    let interrupted = request.stop.load(Ordering::Relaxed);
    let rows = rows_of(system, request, &run)?;
    let last =
        run.last().map_or_else(|| outcome::row(request.interval.0, &q, &z), |end| outcome::row(end.t, &end.q, &end.z));
    Ok(Outcome {
        rows: rows.len(),
        columns: outcome::columns(rows.into_iter()),
        last,
        events: outcome::happened(request, run.passages().iter().map(|passage| (passage.number, &passage.sample))),
        stopped_by: run.stopped_by().map(|number| outcome::number_of_end(request, number)),
        summary: summary(&run),
        touched: Some(touched(&run)),
        error: error.filter(|_| !interrupted).map(|error| of_contacts(&error)),
        interrupted,
    })
}

/// The states at the times that were asked for, or all: two at an event, where forces before it are those of the
/// nearest time before. At the start of a run in steps there are none.
pub(super) fn rows_of<'k, S: Touching + 'k>(
    system: &S,
    request: &Request<'_>,
    run: &impl ContactRecord<'k, S>,
) -> Result<Vec<Vec<f64>>, String> {
    let in_steps = matches!(request.control, Control::ContactSteps(..));
    let Some(times) = request.times else {
        let samples = run.states();
        let forces = |n: usize| {
            let t = samples[n].t;
            let before = samples.get(n + 1).is_some_and(|next| next.t == t) && n > 0;
            let at = if before { t.next_down().max(samples[0].t) } else { t };
            run.forces(at).ok().filter(|_| !in_steps || n > 0)
        };
        return Ok(samples.iter().enumerate().map(|(n, sample)| row(system, sample, forces(n).as_deref())).collect());
    };
    let Some((_, last)) = run.span() else { return Ok(Vec::new()) };
    let reached = times.iter().filter(|time| **time <= last);
    let found = reached.map(|time| {
        let at = run.state_at(*time).map_err(|error| of_contacts(&error))?;
        Ok(row(system, &at, run.forces(*time).ok().as_deref()))
    });
    found.collect()
}

fn summary<S: Touching>(run: &ContactTrajectory<'_, S>) -> Summary {
    let mut all = Summary::default();
    for segment in run.segments() {
        let summary = segment.trajectory().summary();
        all.steps += summary.steps;
        all.rejected += summary.rejected;
        all.rounded += summary.rounded;
        all.excess = all.excess.max(summary.excess);
    }
    all
}

fn touched<S: Touching>(run: &ContactTrajectory<'_, S>) -> Touched {
    let happened = run.events().iter().map(|event| {
        let rows = S::CONTACTS[event.contact].rows().len();
        let (kind, impact) = match event.kind {
            EventKind::Impact(impact) => {
                let each = [impact.before, impact.after, impact.impulse];
                let numbers = each.iter().flat_map(|numbers| numbers[..rows].iter().copied());
                (0, numbers.chain([impact.energy_lost]).collect())
            }
            EventKind::Closes => (1, Vec::new()),
            EventKind::Rests { .. } => (2, Vec::new()),
            EventKind::Leaves => (3, Vec::new()),
            EventKind::Sticks => (4, Vec::new()),
            EventKind::Slides(_) => (5, Vec::new()),
            _ => (6, Vec::new()),
        };
        Happening { time: event.time, contact: event.contact, kind, impact }
    });
    let worst = |impact: bool| {
        let solves = run.solves().iter().filter(|solve| solve.impact == impact);
        let all = solves.flat_map(|solve| &solve.residuals).map(|(_, residual)| [residual.worst(), residual.rounding]);
        all.fold([0.0; 2], |a, b| [a[0].max(b[0]), a[1].max(b[1])])
    };
    let ([velocity, of_velocity], [acceleration, of_acceleration]) = (worst(true), worst(false));
    Touched {
        happened: happened.collect(),
        report: named(&[
            ("impacts", run.events().iter().filter(|event| matches!(event.kind, EventKind::Impact(_))).count() as f64),
            ("velocity_residual", velocity),
            ("velocity_rounding", of_velocity),
            ("acceleration_residual", acceleration),
            ("acceleration_rounding", of_acceleration),
        ]),
        sampled: run.sampled_gaps().iter().map(|gap| (gap.contact, gap.start, gap.end)).collect(),
    }
}

pub(super) fn named(numbers: &[(&str, f64)]) -> Vec<(String, f64)> {
    numbers.iter().map(|&(name, number)| (name.to_owned(), number)).collect()
}
