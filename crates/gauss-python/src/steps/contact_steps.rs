//! Runs with contacts in steps.

use std::ops::Range;
use std::sync::atomic::Ordering;

use gauss_contact::{
    ContactError, ContactSteps, Mode, Residual, StepLaw, StepReport, StepScheme, SteppedRun, WithContacts,
};
use gauss_runtime::integrate::drive::each::Each;
use gauss_runtime::integrate::drive::event::Events;
use gauss_runtime::integrate::{InputSource, Summary};
use gauss_runtime::prelude::*;

use super::causes::of_contacts;
use super::contact_rows::{Touching, named, rows_of, unless_stopped};
use super::outcome::{self, Happening, Outcome, Touched};
use super::request::Request;
use super::watching::{input, jump, of_numbers, watched};

/// A run in steps of a length, or at most as long where there are tolerances.
///
/// # Errors
/// States at times between steps that cannot be found.
pub(super) fn run<S: Touching>(
    system: &S,
    request: &Request<'_>,
    (q, z): (S::Configuration, S::Speeds),
    (length, tolerances, scheme, law): (f64, Option<(f64, f64)>, StepScheme, StepLaw),
) -> Result<Outcome, String> {
    let interval = request.interval.0..request.interval.1;
    let stop = (unless_stopped(request), Crossing::Any, [true, false, false]);
    let simulation = Simulation::new(system)
        .input(|t: f64, q: &S::Configuration, z: &S::Speeds| input::<S>(request, t, q, z))
        .events_by(
            Each::of(watched::<S>(request).chain([stop]))
                .then(|place, state: &mut Sample<S>| jump(request, place, state)),
        );
    let simulation = match request.limit {
        Some(limit) => simulation.max_steps(limit),
        None => simulation,
    };
    let (start, how) = ((q, z), (tolerances, scheme, law));
    let (run, error) = match &request.controller {
        None => made(simulation.contact_steps(length), how, start, interval),
        Some(held) => {
            let sampled = |t: f64, q: &S::Configuration, z: &S::Speeds| of_numbers(held.law, t, q, z);
            let simulation = simulation.sampled(held.period, sampled).delayed(held.delay);
            made(simulation.contact_steps(length), how, start, interval)
        }
    };
    let interrupted = request.stop.load(Ordering::Relaxed);
    let rows = rows_of(system, request, &run)?;
    let mut summary = Summary::default();
    (summary.jumps, summary.rejected) = (run.state_jumps.len() as u64, run.statistics.rejected);
    summary.steps = run.samples.len() as u64 - summary.jumps;
    let last = run.samples.last().map_or(&run.start, |step| &step.state);
    Ok(Outcome {
        rows: rows.len(),
        columns: outcome::columns(rows.into_iter()),
        last: outcome::row(last.t, &last.q, &last.z),
        events: outcome::happened(request, run.passages.iter().map(|passage| (passage.number, &passage.sample))),
        stopped_by: run.stopped_by.map(|number| outcome::number_of_end(request, number)),
        summary,
        touched: Some(touched(&run, tolerances.is_some())),
        error: error.filter(|_| !interrupted).map(|error| of_contacts(&error)),
        interrupted,
    })
}

/// The steps as far as they go, with the reason where that is not the end.
fn made<'k, S, I, E>(
    steps: ContactSteps<'k, S, I, E>,
    (tolerances, scheme, law): (Option<(f64, f64)>, StepScheme, StepLaw),
    (q, z): (S::Configuration, S::Speeds),
    interval: Range<f64>,
) -> (SteppedRun<'k, S>, Option<ContactError>)
where
    S: Touching,
    I: InputSource<S>,
    E: Events<S>,
{
    let steps = steps.scheme(scheme).law(law);
    match tolerances {
        None => steps.attempt(q, z, interval),
        Some((relative, absolute)) => steps.adaptive(relative, absolute).attempt(q, z, interval),
    }
}

/// Account of the contacts, step by step, and of how well the laws and, where there are some, tolerances were kept.
fn touched<S: Touching>(run: &SteppedRun<'_, S>, tolerates: bool) -> Touched {
    let (mut worst, mut work, mut impacts) = (StepReport::default(), 0.0, 0);
    let (mut happened, mut modes) = (Vec::new(), run.modes(run.start.t).map_or_else(|_| Vec::new(), <[Mode]>::to_vec));
    for step in &run.samples {
        let report = &step.report;
        (work, impacts) = (work + report.work, impacts + report.impacts);
        worst.residual = worse(worst.residual, report.residual);
        worst.from_coulomb = worse(worst.from_coulomb, report.from_coulomb);
        worst.penetration = worst.penetration.max(report.penetration);
        worst.closure = worst.closure.max(report.closure);
        worst.parts = worst.parts.max(report.parts);
        let both = modes.iter().zip(&step.modes).enumerate();
        happened.extend(both.filter_map(|(contact, (before, after))| {
            let kind = change(before, after)?;
            Some(Happening { time: step.state.t, contact, kind, impact: Vec::new() })
        }));
        modes.clone_from(&step.modes);
    }
    let beyond = [("beyond", run.statistics.beyond as f64), ("largest_beyond", run.statistics.largest_beyond)];
    let beyond = named(if tolerates { &beyond } else { &[] });
    Touched {
        happened,
        report: named(&[
            ("impacts", impacts as f64),
            ("velocity_residual", worst.residual.worst()),
            ("velocity_rounding", worst.residual.rounding),
            ("from_coulomb", worst.from_coulomb.worst()),
            ("penetration", worst.penetration),
            ("closure", worst.closure),
            ("parts", f64::from(worst.parts)),
            ("work", work),
        ])
        .into_iter()
        .chain(beyond)
        .collect(),
        sampled: Vec::new(),
    }
}

/// Kind of a change of modes, by its place in [`KINDS`](outcome::KINDS).
fn change(before: &Mode, after: &Mode) -> Option<usize> {
    match (before, after) {
        (Mode::Open, Mode::Closed) => Some(1),
        (Mode::Open | Mode::Slides(_) | Mode::Closed, Mode::Sticks) => Some(4),
        (Mode::Open | Mode::Sticks | Mode::Closed, Mode::Slides(_)) => Some(5),
        (Mode::Open, Mode::Open) => None,
        (_, Mode::Open) => Some(3),
        _ => None,
    }
}

/// The larger of each.
fn worse(a: Residual, b: Residual) -> Residual {
    let mut worst = a;
    worst.signorini = worst.signorini.max(b.signorini);
    worst.coulomb = worst.coulomb.max(b.coulomb);
    worst.dissipation = worst.dissipation.max(b.dissipation);
    worst.rounding = worst.rounding.max(b.rounding);
    worst
}
