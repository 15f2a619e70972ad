//! Runs with contacts in steps.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::sync::atomic::Ordering;

use gauss_contact::{ContactSteps, Mode, Residual, StepLaw, StepReport, StepScheme, SteppedRun};
use gauss_runtime::integrate::Summary;
use gauss_runtime::integrate::drive::each::Each;
use gauss_runtime::prelude::*;

use super::causes::of_contacts;
use super::contact_rows::{Touching, named, rows_of, unless_stopped};
use super::outcome::{self, Happening, Outcome, Touched};
use super::request::{Held, Request};
use super::watching::{input, of_numbers, watched};

/// A run in steps of a length.
///
/// # Errors
/// Times of a controller that are no multiples of the step.
pub(super) fn run<S: Touching>(
    system: &S,
    request: &Request<'_>,
    (q, z): (S::Configuration, S::Speeds),
    (length, scheme, law): (f64, StepScheme, StepLaw),
) -> Result<Outcome, String> {
    let (start, end) = request.interval;
    let h = (end - start) / ((end - start) / length - 1e-9).ceil();
    let sampled = request.controller.as_ref().map(|held| Sampled::new(held, start, h)).transpose()?;
    let sampled = RefCell::new(sampled);
    // Steps ask for their input once, at their start.
    let held = |t: f64, q: &S::Configuration, z: &S::Speeds| {
        let given = input::<S>(request, t, q, z);
        match &mut *sampled.borrow_mut() {
            Some(sampled) => given.add_scaled(1.0, &sampled.at(t, q, z)),
            None => given,
        }
    };
    let stop = (unless_stopped(request), Crossing::Any, [true, false]);
    let steps = ContactSteps::new(system, length).scheme(scheme).law(law).input(held);
    let steps = steps.events_by(Each::of(watched::<S>(request).chain([stop])));
    let steps = match request.limit {
        Some(limit) => steps.max_steps(limit),
        None => steps,
    };
    let (run, error) = steps.attempt(q, z, start..end);
    let interrupted = request.stop.load(Ordering::Relaxed);
    let rows = rows_of(system, request, &run)?;
    let mut summary = Summary::default();
    summary.steps = run.samples.len() as u64;
    let last = run.samples.last().map_or(&run.start, |step| &step.state);
    Ok(Outcome {
        rows: rows.len(),
        columns: outcome::columns(rows.into_iter()),
        last: outcome::row(last.t, &last.q, &last.z),
        events: outcome::happened(request, run.passages.iter().map(|passage| (passage.number, &passage.sample))),
        stopped_by: run.stopped_by.map(|number| outcome::number_of_end(request, number)),
        summary,
        touched: Some(touched(&run)),
        error: error.filter(|_| !interrupted).map(|error| of_contacts(&error)),
        interrupted,
    })
}

/// Account of the contacts, step by step, and of how well the laws were kept.
fn touched<S: Touching>(run: &SteppedRun<'_, S>) -> Touched {
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
        ]),
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

/// A controller that samples, whose instants are those of steps.
struct Sampled<'a, U> {
    held: &'a Held<'a>,
    /// The time of the first instant, and the part of a step by which times may differ.
    start: f64,
    late: f64,
    /// The number of the next instant.
    next: u32,
    /// Input that acts, and from when on others will.
    acts: U,
    to_come: VecDeque<(f64, U)>,
}

impl<'a, U: VectorSpace<f64>> Sampled<'a, U> {
    fn new(held: &'a Held<'a>, start: f64, h: f64) -> Result<Self, String> {
        let late = 1e-3 * h;
        for (name, time) in [("period", held.period), ("delay", held.delay)] {
            if (time - (time / h).round() * h).abs() > late {
                return Err(format!("{name} is {time}, which is no multiple of the step, {h}"));
            }
        }
        Ok(Self { held, start, late, next: 0, acts: U::zero(), to_come: VecDeque::new() })
    }

    /// The input that is held from the time of a step on.
    fn at<Q: Configuration<Scalar = f64>, Z: VectorSpace<f64>>(&mut self, t: f64, q: &Q, z: &Z) -> U {
        let instant = self.start + f64::from(self.next) * self.held.period;
        if instant <= t + self.late {
            self.to_come.push_back((instant + self.held.delay, of_numbers(self.held.law, t, q, z)));
            self.next += 1;
        }
        while let Some((from, acts)) = self.to_come.front()
            && *from <= t + self.late
        {
            self.acts = *acts;
            self.to_come.pop_front();
        }
        self.acts
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
