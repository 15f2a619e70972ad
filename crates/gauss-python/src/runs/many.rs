//! Many runs, in lanes and on threads.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use gauss_batch::{Batch, BatchSystem, Ensemble, Kernels, RunOutcome, SingleConfiguration, SingleSpeeds, States};
use gauss_runtime::integrate::VelocityForm;
use gauss_runtime::prelude::*;
use gauss_runtime::simd::Packed;

use crate::scene::{ScalarOf, Scene};
use crate::steps::{Input, Stoppable, Until, Watched, components, configuration, numbers_of, vector};

/// Many runs over one interval.
pub struct Many<'a> {
    /// How many.
    pub count: usize,
    /// The numbers of the first q of each.
    pub q: &'a [f64],
    /// Those of the first z.
    pub z: &'a [f64],
    /// Parameters that each has for itself: the place among the numbers of all, and a number for each run.
    pub parameters: Vec<(usize, Vec<f64>)>,
    /// From when to when.
    pub interval: (f64, f64),
    /// Relative and absolute.
    pub tolerances: (f64, f64),
    /// The input, the same for all.
    pub input: Input<'a>,
    /// Where a run ends before its time.
    pub until: Option<Until<'a>>,
    /// Set from outside, all runs end with what there is.
    pub stop: &'a AtomicBool,
    /// How many have ended.
    pub ended: &'a AtomicUsize,
}

/// Where the runs ended, column by column: time, the numbers of q and z, steps.
#[derive(Clone, Debug)]
pub struct ManyEnds {
    /// The columns, one after the other.
    pub columns: Vec<f64>,
    /// Whether the end was that of `until`.
    pub stopped: Vec<bool>,
    /// Runs that did not reach their end, and why.
    pub errors: Vec<(usize, String)>,
}

type Packs<S> = <S as Scene>::Packed;
type StateOf<S> = (SingleConfiguration<S>, SingleSpeeds<S>);

/// Runs them.
///
/// # Errors
/// A first state that is none; parameters that no body can have.
pub fn ensemble<S: Scene>(shared: &Packs<S>, numbers: &[f64], many: &Many<'_>) -> Result<ManyEnds, String> {
    let sizes = many.q.len().checked_div(many.count).unwrap_or(0);
    let speeds = many.z.len().checked_div(many.count).unwrap_or(0);
    let mut first = Vec::with_capacity(many.count);
    for i in 0..many.count {
        let q = configuration(&many.q[i * sizes..(i + 1) * sizes]).map_err(|error| format!("run {i}: {error}"))?;
        first.push((q, vector(&many.z[i * speeds..(i + 1) * speeds])));
    }
    if many.parameters.is_empty() {
        return Ok(run(&Stoppable { system: shared, stop: many.stop }, many, &first));
    }
    let kernels = kernels::<S>(numbers, many)?;
    let stoppable: Vec<_> = kernels.iter().map(|system| Stoppable { system, stop: many.stop }).collect();
    Ok(run(&stoppable[..], many, &first))
}

/// A kernel for each block of runs.
fn kernels<S: Scene>(numbers: &[f64], many: &Many<'_>) -> Result<Vec<Packs<S>>, String> {
    let lanes = <ScalarOf<Packs<S>> as Packed>::WIDTH;
    let of_block = |block: usize| {
        let mut packed: Vec<_> = numbers.iter().map(ScalarOf::<Packs<S>>::repeat).collect();
        for (place, values) in &many.parameters {
            for lane in 0..lanes {
                packed[*place].replace(lane, &values[(block * lanes + lane).min(many.count - 1)]);
            }
        }
        S::packed(&packed).map_err(|error| {
            format!("runs {} to {}: {error}", block * lanes, ((block + 1) * lanes).min(many.count) - 1)
        })
    };
    (0..many.count.div_ceil(lanes)).map(of_block).collect()
}

fn run<'k, S, K>(kernels: &'k K, many: &'k Many<'_>, first: &[StateOf<S>]) -> ManyEnds
where
    S: BatchSystem<
            Scalar: Packed<Single = f64>,
            Input: VectorSpace<<S as GaussSystem>::Scalar>,
            Configuration: Packed<Single: Configuration<Scalar = f64> + Send> + Send,
            Speeds: Packed<Single: VectorSpace<f64> + Send> + Send,
        >,
    K: Kernels<S> + Sync + ?Sized,
    &'k K: AsBatch<'k, K>,
{
    let source = |t: S::Scalar, _: &S::Configuration, _: &S::Speeds| many.input.at(t, lanes::<S::Scalar>);
    let size = <<S::Configuration as Configuration>::Components as VectorSpace<S::Scalar>>::DIM;
    let (crossing, place, value) = match many.until {
        Some(Until { watched: Watched::Number(place, value), crossing, .. }) => (crossing, Some(place), value),
        _ => (Crossing::Any, None, 0.0),
    };
    let watched = move |_: S::Scalar, q: &S::Configuration, z: &S::Speeds| match place {
        Some(place) if place < size => q.components().component(place) - S::Scalar::from_f64(value),
        Some(place) => z.component(place - size) - S::Scalar::from_f64(value),
        None => S::Scalar::one(),
    };
    let count = |_: usize| {
        many.ended.fetch_add(1, Ordering::Relaxed);
    };
    let (relative, absolute) = many.tolerances;
    let ensemble: Ensemble<'_, K, VelocityForm, _, _> = kernels.batch().input(source).adaptive(relative, absolute);
    let ensemble = ensemble.until(crossing, watched).progress(&count);
    let mut states = States::from_fn(many.count, |i| first[i]);
    let ends = ensemble.run_on_all_threads(many.interval.0..many.interval.1, &mut states);
    gathered(&ends, &states)
}

/// A batch of one kernel for all, or of one for each block.
trait AsBatch<'k, K: ?Sized> {
    fn batch(self) -> Batch<'k, K>;
}

impl<'k, S: GaussSystem> AsBatch<'k, S> for &'k S {
    fn batch(self) -> Batch<'k, S> {
        Batch::new(self)
    }
}

impl<'k, S: GaussSystem> AsBatch<'k, [S]> for &'k [S] {
    fn batch(self) -> Batch<'k, [S]> {
        Batch::each(self)
    }
}

/// A number in every lane.
fn lanes<T: Real + Packed<Single = f64>>(number: &dyn Fn(usize) -> f64) -> T {
    let mut value = T::repeat(&number(0));
    (1..T::WIDTH).for_each(|lane| value.replace(lane, &number(lane)));
    value
}

fn gathered<S>(ends: &[RunOutcome<S>], states: &States<S>) -> ManyEnds
where
    S: BatchSystem,
    SingleConfiguration<S>: Configuration<Scalar = f64>,
    SingleSpeeds<S>: VectorSpace<f64>,
{
    let rows = ends.len();
    let mut result = ManyEnds { columns: Vec::new(), stopped: Vec::new(), errors: Vec::new() };
    for (i, (end, (q, z))) in ends.iter().zip(states.iter()).enumerate() {
        let (time, steps) = match end {
            Ok(end) => {
                result.stopped.push(end.stopped_by.is_some());
                (end.time, end.summary.steps as f64)
            }
            Err(error) => {
                result.stopped.push(false);
                result.errors.push((i, format!("t = {}: {}", error.time, error.kind)));
                (error.time, f64::NAN)
            }
        };
        let row = [vec![time], numbers_of(&q), components(&z), vec![steps]].concat();
        result.columns.resize(row.len() * rows, 0.0);
        row.into_iter().enumerate().for_each(|(column, number)| result.columns[column * rows + i] = number);
    }
    result
}
