//! Many runs, each of its own, on all threads: with contacts, and of models that come at run time.

use std::collections::BTreeMap;
use std::sync::atomic::Ordering;

use rayon::prelude::*;

use super::many::{Many, ManyEnds, names};
use crate::description::Description;
use crate::scene::{ConfigurationOf, Scene};
use crate::steps::{self, Methods, Outcome, Request};
use crate::threads;

/// The columns behind those of runs without contacts: gaps that have closed by impacts, and how far velocities after
/// them were from the laws of contact.
pub const TOUCHED: [&str; 2] = ["impacts", "velocity_residual"];

/// Runs them, as [`ensemble`](super::ensemble) does those without contacts, and each as `simulate` does it alone.
///
/// # Errors
/// The system has no threads to give.
pub fn touching<S: Scene>(
    (description, methods): (&Description, &Methods<S::Single>),
    shared: &S::Single,
    numbers: &[f64],
    many: &Many<'_>,
) -> Result<ManyEnds, String> {
    one_by_one(many, &TOUCHED, |i| one::<S>((description, methods), shared, numbers, (many, i)))
}

/// Runs each by a function of its number, on all threads. `report`: names of the columns of what contacts did.
///
/// # Errors
/// The system has no threads to give.
pub fn one_by_one(
    many: &Many<'_>,
    report: &[&str],
    run: impl Fn(usize) -> Result<Outcome, String> + Sync,
) -> Result<ManyEnds, String> {
    let pool = threads::pool().map_err(|error| format!("an ensemble runs on threads of its own: {error}"))?;
    let one = |i: usize| {
        let outcome = run(i);
        many.ended.fetch_add(1, Ordering::Relaxed);
        outcome
    };
    let all: Vec<_> = pool.install(|| (0..many.count).into_par_iter().map(one).collect());
    let width = 2 + many.first(0).map(<[f64]>::len).iter().sum::<usize>() + report.len();
    let columns = vec![f64::NAN; width * many.count];
    let mut ends = ManyEnds { columns, width, stopped: vec![false; many.count], errors: BTreeMap::new() };
    for (i, run) in all.into_iter().enumerate() {
        let put = |(column, number): (usize, f64)| ends.columns[column * many.count + i] = number;
        match run {
            Ok(outcome) => {
                row(&outcome, report).into_iter().enumerate().for_each(put);
                ends.stopped[i] = outcome.stopped_by.is_some();
                let stopped = outcome.interrupted.then(|| "the run was interrupted".to_owned());
                ends.errors.extend(outcome.error.or(stopped).map(|why| (i, why)));
            }
            Err(why) => drop(ends.errors.insert(i, why)),
        }
    }
    Ok(ends)
}

fn one<S: Scene>(
    (description, methods): (&Description, &Methods<S::Single>),
    shared: &S::Single,
    numbers: &[f64],
    (many, i): (&Many<'_>, usize),
) -> Result<Outcome, String> {
    let [q, z] = many.first(i);
    let of_state = steps::state::<ConfigurationOf<S::Single>>(description, names::<S>(), q, z).err();
    let own = (!many.parameters.is_empty()).then(|| S::single(&many.own(numbers, i))).transpose();
    let of_parameters = own.as_ref().err().map(|error| error.violations().iter().map(ToString::to_string).collect());
    let mistakes: Vec<String> = of_state.into_iter().chain(of_parameters).flatten().collect();
    let Some(own) = own.ok().filter(|_| mistakes.is_empty()) else { return Err(mistakes.join("; ")) };
    methods.simulate(own.as_ref().unwrap_or(shared), &request(many, i))
}

/// Request of one run among many: no state but the last.
pub fn request<'a>(many: &'a Many<'_>, i: usize) -> Request<'a> {
    let [q, z] = many.first(i);
    Request {
        q,
        z,
        interval: many.interval,
        control: many.control,
        input: &many.input,
        controller: None,
        until: many.until.as_slice(),
        times: Some(&[]),
        limit: many.limit,
        stop: many.stop,
        look: &|_| {},
    }
}

/// The end of a run; of one with an error no numbers but its last state.
fn row(outcome: &Outcome, names: &[&str]) -> Vec<f64> {
    let steps = if outcome.error.is_none() { outcome.summary.steps as f64 } else { f64::NAN };
    let report = outcome.touched.iter().flat_map(|touched| &touched.report);
    let of = |name: &str| report.clone().find(|(other, _)| other == name).map_or(f64::NAN, |(_, number)| *number);
    let touched: Vec<f64> = names.iter().map(|name| of(name)).collect();
    [&outcome.last[..], &[steps], &touched].concat()
}
