//! Many runs, in lanes and on threads.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use gauss_batch::{Batch, BatchSystem, Ensemble, Kernels, RunOutcome, SingleConfiguration, SingleSpeeds, States};
use gauss_runtime::integrate::{Adaptive, Method, StepSetting, VelocityForm};
use gauss_runtime::prelude::*;
use gauss_runtime::simd::Packed;

use crate::description::Description;
use crate::scene::{ScalarOf, Scene};
use crate::steps::{self, Control, Input, Stoppable, Until, Watched, components, looking, numbers_of, vector};
use crate::threads;

/// Many runs over one interval.
pub struct Many<'a> {
    /// Number of runs.
    pub count: usize,
    /// The numbers of the first q of each.
    pub q: &'a [f64],
    /// The numbers of the first z of each.
    pub z: &'a [f64],
    /// Parameters that each has for itself: the place among the numbers of all, and a number for each run.
    pub parameters: Vec<(usize, Vec<f64>)>,
    /// From when to when.
    pub interval: (f64, f64),
    /// The steps: without contacts as long as tolerances allow.
    pub control: Control,
    /// The most steps of each.
    pub limit: Option<u64>,
    /// The input, the same for all.
    pub input: Input<'a>,
    /// Event at which a run ends before its time.
    pub until: Option<Until<'a>>,
    /// Set from outside, all runs end with what there is.
    pub stop: &'a AtomicBool,
    /// Number of runs that have ended.
    pub ended: &'a AtomicUsize,
}

impl Many<'_> {
    /// The parameters of a run.
    pub fn own(&self, numbers: &[f64], i: usize) -> Vec<f64> {
        let mut own = numbers.to_vec();
        self.parameters.iter().for_each(|(place, values)| own[*place] = values[i]);
        own
    }

    /// The numbers of the first q and z of a run.
    pub fn first(&self, i: usize) -> [&[f64]; 2] {
        [self.q, self.z].map(|all| {
            let size = all.len().checked_div(self.count).unwrap_or(0);
            &all[i * size..(i + 1) * size]
        })
    }
}

/// Ends of runs, column by column: time, the numbers of q and z, steps, and of runs with contacts what
/// [`TOUCHED`](super::TOUCHED) has. Of a run that could not begin there is no number.
#[derive(Clone, Debug)]
pub struct ManyEnds {
    /// The columns, one after the other.
    pub columns: Vec<f64>,
    /// Number of columns.
    pub width: usize,
    /// Whether the end was that of `until`.
    pub stopped: Vec<bool>,
    /// Runs that did not reach their end, or could not begin, and why, in the order of the runs.
    pub errors: BTreeMap<usize, String>,
}

type Packs<S> = <S as Scene>::Packed;
type StateOf<S> = (SingleConfiguration<S>, SingleSpeeds<S>);
/// Runs that cannot begin: all that is wrong with each.
type Refused = BTreeMap<usize, Vec<String>>;

/// Runs them. Those whose first state is none, or whose parameters no body can have, are told of as errors of their
/// own, and the others run.
///
/// # Errors
/// The system has no threads to give.
pub fn ensemble<S: Scene>(
    description: &Description,
    shared: &Packs<S>,
    numbers: &[f64],
    many: &Many<'_>,
) -> Result<ManyEnds, String> {
    let pool = threads::pool().map_err(|error| format!("an ensemble runs on threads of its own: {error}"))?;
    let mut refused = Refused::new();
    let first = first_states::<S>(description, many, &mut refused);
    let mut runs: Vec<usize> = (0..many.count).collect();
    let kernels = loop {
        let mut wrong = Refused::new();
        let kernels = own_kernels::<S>(numbers, many, &runs, &mut wrong);
        wrong.into_iter().for_each(|(i, mistakes)| refused.entry(i).or_default().extend(mistakes));
        let before = runs.len();
        runs.retain(|i| !refused.contains_key(i));
        if runs.len() == before {
            break kernels;
        }
    };
    many.ended.fetch_add(refused.len(), Ordering::Relaxed);
    let first: Vec<_> = runs.iter().filter_map(|&i| first[i]).collect();
    let stoppable: Vec<_> = kernels.iter().map(|system| Stoppable::new(system, many.stop)).collect();
    let (shared, own) = (&Stoppable::new(shared, many.stop), &stoppable[..]);
    let ran = pool.install(move || match many.parameters[..] {
        [] => run(shared, many, &first),
        _ => run(own, many, &first),
    });
    Ok(ran?.scattered(&runs, many.count, refused))
}

/// The first states; of those that are none all that is wrong is noted.
fn first_states<S: Scene>(
    description: &Description,
    many: &Many<'_>,
    refused: &mut Refused,
) -> Vec<Option<StateOf<Packs<S>>>> {
    let state = |i: usize| {
        let [q, z] = many.first(i);
        match steps::state(description, names::<S>(), q, z) {
            Ok(q) => Some((q, vector(z))),
            Err(mistakes) => {
                refused.entry(i).or_default().extend(mistakes);
                None
            }
        }
    };
    (0..many.count).map(state).collect()
}

pub(super) fn names<S: Scene>() -> [&'static [&'static str]; 2] {
    [<S::Single as DescribedSystem>::COORDINATE_NAMES, <S::Single as DescribedSystem>::SPEED_NAMES]
}

/// A kernel for each block of runs that have parameters of their own. What is wrong with parameters is noted.
fn own_kernels<S: Scene>(numbers: &[f64], many: &Many<'_>, runs: &[usize], refused: &mut Refused) -> Vec<Packs<S>> {
    if many.parameters.is_empty() {
        return Vec::new();
    }
    let lanes = <ScalarOf<Packs<S>> as Packed>::WIDTH;
    let mut kernels = Vec::new();
    for block in runs.chunks(lanes) {
        let mut packed: Vec<_> = numbers.iter().map(ScalarOf::<Packs<S>>::repeat).collect();
        for (place, values) in &many.parameters {
            for lane in 0..lanes {
                packed[*place].replace(lane, &values[block[lane.min(block.len() - 1)]]);
            }
        }
        let Err(error) = S::packed(&packed).map(|kernel| kernels.push(kernel)) else { continue };
        let before = refused.len();
        for &i in block {
            if let Err(error) = S::single(&many.own(numbers, i)) {
                refused.entry(i).or_default().extend(error.violations().iter().map(ToString::to_string));
            }
        }
        if refused.len() == before {
            // Whom of them the lanes refuse is not known.
            let all = block.iter().map(|&i| (i, error.violations().iter().map(ToString::to_string).collect()));
            refused.extend(all);
        }
    }
    kernels
}

fn run<'k, S, K>(kernels: &'k K, many: &'k Many<'_>, first: &[StateOf<S>]) -> Result<ManyEnds, String>
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
    let (relative, absolute) = match many.control {
        Control::Smooth(Method::DormandPrince8, StepSetting::Tolerant { relative, absolute, .. }) => {
            (relative, absolute)
        }
        other => return Err(format!("an ensemble has steps as long as tolerances allow, and not {other:?}")),
    };
    let control = looking(Adaptive::new(relative, absolute), &many.input);
    let ensemble: Ensemble<'_, K, VelocityForm, _, _> = kernels.batch().input(source).control(control);
    let ensemble = ensemble.until(crossing, watched).progress(&count);
    let ensemble = match many.limit {
        Some(limit) => ensemble.max_steps(limit),
        None => ensemble,
    };
    let mut states = States::from_fn(first.len(), |i| first[i]);
    let ends = ensemble.run_on_all_threads(many.interval.0..many.interval.1, &mut states);
    Ok(gathered(&ends, &states))
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

/// The ends of all runs that began, in their order.
fn gathered<S>(ends: &[RunOutcome<S>], states: &States<S>) -> ManyEnds
where
    S: BatchSystem,
    SingleConfiguration<S>: Configuration<Scalar = f64>,
    SingleSpeeds<S>: VectorSpace<f64>,
{
    let rows = ends.len();
    let width = 2 + <<SingleConfiguration<S> as Configuration>::Components as VectorSpace<f64>>::DIM + S::DOF;
    let columns = vec![0.0; width * rows];
    let mut result = ManyEnds { columns, width, stopped: Vec::new(), errors: BTreeMap::new() };
    for (i, (end, (q, z))) in ends.iter().zip(states.iter()).enumerate() {
        let (time, steps) = match end {
            Ok(end) => {
                result.stopped.push(end.stopped_by.is_some());
                (end.time, end.summary.steps as f64)
            }
            Err(error) => {
                result.stopped.push(false);
                result.errors.insert(i, format!("t = {}: {}", error.time, steps::words(&error.kind)));
                (error.time, f64::NAN)
            }
        };
        let row = [vec![time], numbers_of(&q), components(&z), vec![steps]].concat();
        row.into_iter().enumerate().for_each(|(column, number)| result.columns[column * rows + i] = number);
    }
    result
}

impl ManyEnds {
    /// These runs among all, of which others were refused.
    fn scattered(self, runs: &[usize], count: usize, refused: Refused) -> Self {
        if refused.is_empty() {
            return self;
        }
        let width = self.width;
        let (columns, stopped) = (vec![f64::NAN; width * count], vec![false; count]);
        let mut all = Self { columns, width, stopped, errors: BTreeMap::new() };
        for (k, &i) in runs.iter().enumerate() {
            all.stopped[i] = self.stopped[k];
            (0..width).for_each(|column| all.columns[column * count + i] = self.columns[column * runs.len() + k]);
        }
        all.errors.extend(self.errors.into_iter().map(|(k, why)| (runs[k], why)));
        all.errors.extend(refused.into_iter().map(|(i, mistakes)| (i, mistakes.join("; "))));
        all
    }
}
