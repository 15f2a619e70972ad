//! The states of runs with contacts, row by row.

use std::sync::atomic::Ordering;

use gauss_contact::ContactRecord;
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::prelude::*;

use super::causes::of_contacts;
use super::outcome;
use super::request::{Control, Request};
use super::watching::{Moving, Watch};

/// Requirements that runs with contacts have of a system.
pub trait Touching: Moving + ContactSystem {}

impl<S: Moving + ContactSystem> Touching for S {}

/// A state with its energies and the columns of its contacts.
fn row<S: Touching>(system: &S, sample: &Sample<S>, forces: Option<&S::ContactRows>) -> Vec<f64> {
    let Sample { t, q, z, .. } = sample;
    let mut row = outcome::row(*t, q, z);
    row.extend(outcome::energies(system, sample));
    let (gaps, rates) = (system.gaps(*t, q), system.contact_rates(*t, q, z));
    let force = |row: usize| forces.map_or(f64::NAN, |forces| forces.component(row));
    for (i, contact) in system.contacts().iter().enumerate() {
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

/// Numbers by their names.
pub(super) fn named(numbers: &[(&str, f64)]) -> Vec<(String, f64)> {
    numbers.iter().map(|&(name, number)| (name.to_owned(), number)).collect()
}
