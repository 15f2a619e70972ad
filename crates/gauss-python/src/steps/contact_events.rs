//! Runs with contacts from event to event.

use std::sync::atomic::Ordering;

use gauss_contact::{ContactTrajectory, EventKind, WithContacts};
use gauss_runtime::integrate::drive::each::Each;
use gauss_runtime::integrate::{Adaptive, Summary};
use gauss_runtime::prelude::*;

use super::causes::of_contacts;
use super::contact_rows::{Touching, named, rows_of, unless_stopped};
use super::outcome::{self, Happening, Outcome, Touched};
use super::request::{Control, Request, looking};
use super::watching::{input, jump, of_numbers, watched};

/// A run from event to event.
///
/// # Errors
/// Where the request is another one.
pub(super) fn run<S: Touching>(
    system: &S,
    request: &Request<'_>,
    (q, z): (S::Configuration, S::Speeds),
) -> Result<Outcome, String> {
    let Control::ContactEvents(relative, absolute, largest, law) = request.control else {
        return Err("runs with contacts go from event to event, or in steps".to_owned());
    };
    let control = looking(Adaptive::new(relative, absolute), request.input);
    let control = if largest.is_finite() { control.largest_step(largest) } else { control };
    let stop = (unless_stopped(request), Crossing::Any, [true, false, false]);
    let interval = request.interval.0..request.interval.1;
    let simulation = Simulation::new(system)
        .input(|t: f64, q: &S::Configuration, z: &S::Speeds| input::<S>(request, t, q, z))
        .events_by(
            Each::of(watched::<S>(request).chain([stop]))
                .then(|place, state: &mut Sample<S>| jump(request, place, state)),
        )
        .control(control);
    let simulation = match request.limit {
        Some(limit) => simulation.max_steps(limit),
        None => simulation,
    };
    let (run, error) = match &request.controller {
        None => simulation.contact_events().tolerance(relative, absolute).law(law).attempt(q, z, interval),
        Some(held) => {
            let sampled = |t: f64, q: &S::Configuration, z: &S::Speeds| of_numbers(held.law, t, q, z);
            let simulation = simulation.sampled(held.period, sampled).delayed(held.delay);
            simulation.contact_events().tolerance(relative, absolute).law(law).attempt(q, z, interval)
        }
    };
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
        touched: Some(touched(system, &run)),
        error: error.filter(|_| !interrupted).map(|error| of_contacts(&error)),
        interrupted,
    })
}

fn summary<S: Touching>(run: &ContactTrajectory<'_, S>) -> Summary {
    let mut all = Summary::default();
    all.jumps = run.state_jumps().len() as u64;
    for segment in run.segments() {
        let summary = segment.trajectory().summary();
        all.steps += summary.steps;
        all.rejected += summary.rejected;
        all.rounded += summary.rounded;
        all.excess = all.excess.max(summary.excess);
    }
    all
}

fn touched<S: Touching>(system: &S, run: &ContactTrajectory<'_, S>) -> Touched {
    let happened = run.events().iter().map(|event| {
        let rows = system.contacts()[event.contact].rows().len();
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
