//! Runs with contacts: from event to event, or in steps.

use std::collections::VecDeque;
use std::sync::atomic::Ordering;

use gauss_contact::{
    ContactRun, ContactStepper, ContactTrajectory, EventKind, Mode, Residual, StepLaw, StepReport, StepScheme,
};
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::integrate::drive::each::Each;
use gauss_runtime::integrate::{Adaptive, Summary};
use gauss_runtime::prelude::*;

use super::causes::of_contacts;
use super::outcome::{self, Happening, InContact, Outcome, Touched};
use super::request::{Control, Held, Request};
use super::watching::{Watch, input, of_numbers, watch, watched};
use super::{components, configuration, vector};
use crate::methods::System;

/// What runs with contacts need of a system.
trait Touching: System<Scalar = f64> + ContactSystem {}

impl<S: System<Scalar = f64> + ContactSystem> Touching for S {}

/// A run with contacts.
///
/// # Errors
/// A first state that is none; times between steps of contacts.
pub fn run<S: System<Scalar = f64> + ContactSystem>(system: &S, request: &Request<'_>) -> Result<Outcome, String> {
    let start = (configuration::<S::Configuration>(request.q)?, vector::<S::Speeds>(request.z));
    match request.control {
        Control::ContactSteps(length, scheme, law) => in_steps(system, request, start, (length, scheme, law)),
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
fn unless_stopped<'a, Q, Z>(request: &'a Request<'_>) -> Watch<'a, Q, Z> {
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
/// nearest time before.
fn rows_of<S: Touching>(
    system: &S,
    request: &Request<'_>,
    run: &ContactTrajectory<'_, S>,
) -> Result<Vec<Vec<f64>>, String> {
    let Some(times) = request.times else {
        let samples: Vec<_> = run.iter().collect();
        let forces = |n: usize| {
            let t = samples[n].t;
            let before = samples.get(n + 1).is_some_and(|next| next.t == t) && n > 0;
            run.forces(if before { t.next_down().max(samples[0].t) } else { t }).ok()
        };
        return Ok(samples.iter().enumerate().map(|(n, sample)| row(system, sample, forces(n).as_deref())).collect());
    };
    let Some(last) = run.last() else { return Ok(Vec::new()) };
    let reached = times.iter().filter(|time| **time <= last.t);
    let found = reached.map(|time| {
        let at = run.at(*time).map_err(|error| of_contacts(&error))?;
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

fn named(numbers: &[(&str, f64)]) -> Vec<(String, f64)> {
    numbers.iter().map(|&(name, number)| (name.to_owned(), number)).collect()
}

/// All of a run in steps but its stepper.
struct Made<'a, S: Touching> {
    system: &'a S,
    request: &'a Request<'a>,
    rows: Vec<Vec<f64>>,
    watches: Vec<Watch<'a, S::Configuration, S::Speeds>>,
    /// The value of each at the last step.
    values: Vec<f64>,
    modes: Vec<Mode>,
    outcome: Outcome,
    worst: StepReport,
    /// The work of contacts, and gaps that have closed.
    sums: (f64, usize),
}

fn in_steps<S: Touching>(
    system: &S,
    request: &Request<'_>,
    (q, z): (S::Configuration, S::Speeds),
    (length, scheme, law): (f64, StepScheme, StepLaw),
) -> Result<Outcome, String> {
    let (start, end) = request.interval;
    let mut made = Made::begun(system, request, (start, &q, &z));
    let stepper = ContactStepper::new(system, start, q, z).map(|stepper| stepper.scheme(scheme).law(law));
    let count = ((end - start) / length - 1e-9).ceil().max(0.0);
    let run = match stepper {
        Err(error) => Err(of_contacts(&error)),
        Ok(_) if end < start => Err("steps of contacts go forward in time".to_owned()),
        Ok(stepper) => made.steps(stepper, count),
    };
    made.outcome.interrupted = request.stop.load(Ordering::Relaxed);
    made.outcome.error = run.err().filter(|_| !made.outcome.interrupted);
    Ok(made.ended())
}

impl<'a, S: Touching> Made<'a, S> {
    fn begun(system: &'a S, request: &'a Request<'a>, (t, q, z): (f64, &S::Configuration, &S::Speeds)) -> Self {
        let watches: Vec<_> = request.until.iter().map(|until| watch::<S>(until)).collect();
        let values = watches.iter().map(|watch| watch(t, q, z)).collect();
        let outcome = Outcome {
            columns: Vec::new(),
            rows: 0,
            last: outcome::row(t, q, z),
            events: Vec::new(),
            stopped_by: None,
            summary: Summary::default(),
            touched: Some(Touched::default()),
            error: None,
            interrupted: false,
        };
        let (rows, modes) = (Vec::new(), Vec::new());
        let mut made = Self {
            system,
            request,
            rows,
            watches,
            values,
            modes,
            outcome,
            worst: StepReport::default(),
            sums: (0.0, 0),
        };
        made.keep(&Sample { t, q: *q, z: *z, p: system.momentum(t, q, z) }, None);
        made
    }

    /// One more state. An ensemble asks for none, and those between steps are not known.
    fn keep(&mut self, sample: &Sample<S>, forces: Option<&S::ContactRows>) {
        if self.request.times.is_none() {
            self.rows.push(row(self.system, sample, forces));
        }
        self.outcome.last = outcome::row(sample.t, &sample.q, &sample.z);
    }

    /// All steps.
    fn steps(&mut self, mut stepper: ContactStepper<'_, S>, count: f64) -> Result<(), String> {
        let (start, end) = self.request.interval;
        self.modes = stepper.modes().to_vec();
        let (mut n, h) = (0.0, (end - start) / count);
        let mut sampled = self.request.controller.as_ref().map(|held| Sampled::new(held, start, h)).transpose()?;
        while n < count {
            let (t, limit) = (stepper.time(), self.request.limit.unwrap_or(u64::MAX));
            (self.request.look)(t);
            if self.request.stop.load(Ordering::Relaxed) {
                return Ok(());
            }
            if self.outcome.summary.steps >= limit {
                return Err(format!("t = {t}: {limit} steps do not reach the end; allow more by `max_steps`"));
            }
            let (q, z) = (stepper.configuration(), stepper.speeds());
            let mut input = input::<S>(self.request, t, q, z);
            if let Some(sampled) = &mut sampled {
                input = input.add_scaled(1.0, &sampled.at(t, q, z));
            }
            let report = stepper.step(h, &input).map_err(|error| of_contacts(&error))?;
            n += 1.0;
            let (t, q, z) = (start + (end - start) * (n / count), *stepper.configuration(), *stepper.speeds());
            let sample = Sample { t, q, z, p: self.system.momentum(t, &q, &z) };
            self.keep(&sample, Some(stepper.forces().rows()));
            self.count(t, &report, stepper.modes());
            if self.passes(&sample) {
                return Ok(());
            }
        }
        Ok(())
    }

    /// Takes what a step did.
    fn count(&mut self, time: f64, report: &StepReport, modes: &[Mode]) {
        self.outcome.summary.steps += 1;
        self.sums = (self.sums.0 + report.work, self.sums.1 + report.impacts);
        let worst = &mut self.worst;
        worst.residual = worse(worst.residual, report.residual);
        worst.from_coulomb = worse(worst.from_coulomb, report.from_coulomb);
        worst.penetration = worst.penetration.max(report.penetration);
        worst.closure = worst.closure.max(report.closure);
        worst.parts = worst.parts.max(report.parts);
        for (contact, (before, after)) in self.modes.iter().zip(modes).enumerate() {
            let kind = match (before, after) {
                (Mode::Open, Mode::Closed) => Some(1),
                (Mode::Open | Mode::Slides(_) | Mode::Closed, Mode::Sticks) => Some(4),
                (Mode::Open | Mode::Sticks | Mode::Closed, Mode::Slides(_)) => Some(5),
                (Mode::Open, Mode::Open) => None,
                (_, Mode::Open) => Some(3),
                _ => None,
            };
            if let (Some(kind), Some(touched)) = (kind, &mut self.outcome.touched) {
                touched.happened.push(Happening { time, contact, kind, impact: Vec::new() });
            }
        }
        self.modes.copy_from_slice(modes);
    }

    /// Events whose function has passed through zero in the step; whether the run ends there.
    fn passes(&mut self, sample: &Sample<S>) -> bool {
        let Sample { t, q, z, .. } = sample;
        for (number, until) in self.request.until.iter().enumerate() {
            let (before, after) = (self.values[number], (self.watches[number])(*t, q, z));
            self.values[number] = after;
            let (rises, falls) = (before < 0.0 && after >= 0.0, before > 0.0 && after <= 0.0);
            let passes = match until.crossing {
                Crossing::Any => rises || falls,
                Crossing::Rising => rises,
                Crossing::Falling => falls,
            };
            match passes {
                true if until.ends() => self.outcome.stopped_by = Some(outcome::number_of_end(self.request, number)),
                true => self.outcome.events.extend(outcome::happened(self.request, [(number, sample)].into_iter())),
                false => {}
            }
        }
        self.outcome.stopped_by.is_some()
    }

    fn ended(self) -> Outcome {
        let Self { mut outcome, rows, worst, sums: (work, impacts), .. } = self;
        (outcome.rows, outcome.columns) = (rows.len(), outcome::columns(rows.into_iter()));
        if let Some(touched) = &mut outcome.touched {
            touched.report = named(&[
                ("impacts", impacts as f64),
                ("velocity_residual", worst.residual.worst()),
                ("velocity_rounding", worst.residual.rounding),
                ("from_coulomb", worst.from_coulomb.worst()),
                ("penetration", worst.penetration),
                ("closure", worst.closure),
                ("parts", f64::from(worst.parts)),
                ("work", work),
            ]);
        }
        outcome
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
    /// What acts, and from when on others will.
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

    /// What is held from the time of a step on.
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
