//! One call of a method: arrays in, lanes and threads, arrays out.

use std::ops::Range;
use std::sync::Mutex;

use numpy::{PyArrayDyn, PyArrayMethods};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use rayon::prelude::*;

use crate::arrays::{self, Batch, Rows, shown};
use crate::kernels::{AnyKernel, AnyScene, OffGroup, Violation};
use crate::memory::Source;
use crate::methods::{Id, SPECS, Spec, Work};
use crate::own::{self, OwnParameter};
use crate::steps::off_group_words;
use crate::{parameters, threads, tuples};

/// From so many rows on other threads of Python may run meanwhile: letting them costs as much as some rows.
const DETACHED: usize = 64;
/// Rows that a thread takes at a time: whole lanes, and work for some microseconds.
const CHUNK: usize = 512;
/// The same of rows for each of which a kernel is made.
const CHUNK_OF_KERNELS: usize = 16;

/// Values of a call that were given in Python: arrays by their slots, the time, arrays for results.
pub struct Given<'a, 'py> {
    /// Arguments, by [`Slot`].
    pub arguments: [Option<&'a Bound<'py, PyAny>>; 4],
    /// One number, or one for each state; 0 where it is left out.
    pub t: Option<&'a Bound<'py, PyAny>>,
    /// The frame, by its number.
    pub frame: usize,
    /// The array for the result; a tuple of them where there are several.
    pub out: Option<&'a Bound<'py, PyAny>>,
    /// Parameters in place of those of the kernel: one for all, or one for each state.
    pub parameters: Option<&'a Bound<'py, PyDict>>,
}

/// A row that cannot be computed.
pub enum Fault {
    /// A rotation of it is none.
    OffGroup(OffGroup),
    /// Its parameters, or those of all rows, are of no body.
    Parameters(Option<usize>, Vec<Violation>),
}

impl Fault {
    fn row(&self) -> usize {
        match self {
            Self::OffGroup(off) => off.row,
            Self::Parameters(row, _) => row.unwrap_or(0),
        }
    }
}

/// An array by the name of its argument, where it was given.
type Named<'py> = Option<(&'static str, Rows<'py>)>;

/// Arrays that are read, with what is known of them.
struct Reading<'py> {
    rows: [Named<'py>; 5],
    work: Work,
    zero: f64,
}

/// Place of the time among what is read.
const TIME: usize = 4;

/// Calls a method.
pub fn call<'py>(
    py: Python<'py>,
    kernel: &dyn AnyKernel,
    id: Id,
    given: &Given<'_, 'py>,
) -> PyResult<Bound<'py, PyAny>> {
    let (scene, spec) = (kernel.scene(), &SPECS[id as usize]);
    if !scene.has(id) {
        let (name, method, clause) = (scene.description().name, spec.name, spec.clause);
        return Err(PyTypeError::new_err(format!(
            "{name} has no {method}: its struct does not say `#[gauss({clause})]`; models of `gauss.load` take \
             `clauses=[\"{clause}\"]`"
        )));
    }
    let own = own::parameters(scene, spec.name, given.parameters)?;
    let mut reading = Reading::new(given.frame);
    let arguments = spec.arguments.iter().map(|argument| {
        let size = scene.sizes().get(argument.size);
        (argument.name, argument.slot as usize, size, given.arguments[argument.slot as usize])
    });
    for (name, place, size, value) in arguments {
        match value {
            Some(value) => reading.rows[place] = Some((name, Rows::of(name, value)?)),
            None if size == 0 => {}
            None => return Err(missing(scene, spec, name)),
        }
    }
    reading.read_time(given.t)?;
    let times = std::mem::take(&mut reading.rows[TIME]);
    let rows = reading.rows;
    let batch = batch_of(scene, spec, &rows, times.as_ref(), &own)?;
    let count: usize = batch.axes.iter().product();
    let mut work = reading.work;
    for argument in spec.arguments {
        let (place, size) = (argument.slot as usize, scene.sizes().get(argument.size));
        if let Some((name, rows)) = &rows[place] {
            let own = !rows.leading(name, size)?.is_empty();
            work.arguments[place] = rows.source(if own { size } else { 0 });
        }
    }
    if let Some((_, times)) = &times {
        work.t = times.source(usize::from(!times.axes().is_empty()));
    }
    let rounded = given.out.map(|out| singles(scene, spec, batch, out)).transpose()?.flatten();
    let out = given.out.filter(|_| rounded.is_none());
    let results = results(py, scene, spec, batch, out, (&rows, &times))?;
    for (k, (result, array)) in spec.results.iter().zip(&results).enumerate() {
        let stride = result.axes.iter().map(|axis| scene.sizes().get(*axis)).product();
        work.results[k] = arrays::target(array, stride);
    }
    if times.is_none() {
        // SAFETY: one row for all, of one number, which outlives the call.
        #[allow(unsafe_code)]
        let source = unsafe { Source::new(&raw const reading.zero, 0) };
        work.t = source;
    }
    compute(py, kernel, id, &work, count, &own).map_err(|fault| refused(py, (scene, spec), fault, batch))?;
    for (result, single) in results.iter().zip(rounded.into_iter().flatten()) {
        arrays::round(result, &single)?;
    }
    match (given.out, &results[..]) {
        (Some(out), _) => Ok(out.clone()),
        (None, [one]) => Ok(one.clone().into_any()),
        (None, _) => tuples::new(py, &spec.class_name(), PyTuple::new(py, &results)?),
    }
}

impl<'py> Reading<'py> {
    fn new(frame: usize) -> Self {
        let work = Work { frame, ..Work::NONE };
        Self { rows: [const { None }; 5], work, zero: 0.0 }
    }

    /// One time for all is most often a plain float.
    fn read_time(&mut self, t: Option<&Bound<'py, PyAny>>) -> PyResult<()> {
        match t {
            None => {}
            Some(t) => match t.extract::<f64>() {
                Ok(t) => self.zero = t,
                Err(_) => self.rows[TIME] = Some(("t", Rows::numbers("t", t)?)),
            },
        }
        Ok(())
    }
}

fn missing(scene: &dyn AnyScene, spec: &Spec, name: &str) -> PyErr {
    let mut message = format!("{} needs {name}", spec.name);
    if name == "input" {
        let words = scene.description().inputs.iter().map(|part| format!("{} ({})", part.name, part.label));
        message.push_str(&format!(": {}", words.collect::<Vec<_>>().join(", ")));
    }
    PyTypeError::new_err(message)
}

/// The leading axes that all arguments share, but those that are one for all.
fn batch_of<'a>(
    scene: &dyn AnyScene,
    spec: &Spec,
    rows: &'a [Named<'_>; 5],
    times: Option<&'a (&'static str, Rows<'_>)>,
    own: &'a [OwnParameter],
) -> PyResult<Batch<'a>> {
    let mut batch = Batch { axes: &[], of: "" };
    let of_arguments = spec.arguments.iter().filter_map(|argument| {
        let (name, rows) = rows[argument.slot as usize].as_ref()?;
        Some((*name, rows.leading(name, scene.sizes().get(argument.size))))
    });
    let of_time = times.map(|(name, rows)| (*name, Ok(rows.axes())));
    let of_parameters = own.iter().map(|own| (own.name, Ok(own.leading())));
    for (name, axes) in of_arguments.chain(of_time).chain(of_parameters) {
        let axes = axes?;
        if axes.is_empty() || axes == batch.axes {
            continue;
        }
        if !batch.axes.is_empty() {
            return Err(PyValueError::new_err(format!(
                "leading axes differ: {} of {}, {} of {name}",
                shown(batch.axes),
                batch.of,
                shown(axes)
            )));
        }
        batch = Batch { axes, of: name };
    }
    Ok(batch)
}

type Arrays<'py> = Vec<Bound<'py, PyArrayDyn<f64>>>;

/// Arrays for the results: those of `out`, or new ones.
fn results<'py>(
    py: Python<'py>,
    scene: &dyn AnyScene,
    spec: &Spec,
    batch: Batch<'_>,
    out: Option<&Bound<'py, PyAny>>,
    (rows, times): (&[Named<'py>; 5], &Named<'py>),
) -> PyResult<Arrays<'py>> {
    let axes = |k: usize| {
        let own = spec.results[k].axes.iter().map(|axis| scene.sizes().get(*axis));
        batch.axes.iter().copied().chain(own)
    };
    let Some(out) = out else {
        return Ok((0..spec.results.len()).map(|k| arrays::new(py, &axes(k).collect::<Vec<_>>())).collect());
    };
    let inputs: Vec<_> = rows.iter().chain([times]).flatten().map(|(name, rows)| (*name, rows.extent())).collect();
    if spec.results.len() == 1 {
        return Ok(vec![arrays::given("out", out, axes(0), &inputs)?]);
    }
    let arrays = out.cast::<PyTuple>().ok().filter(|arrays| arrays.len() == spec.results.len());
    let Some(arrays) = arrays else {
        let names: Vec<&str> = spec.results.iter().map(|result| result.name).collect();
        return Err(PyTypeError::new_err(format!("out must be a tuple of arrays: {}", names.join(", "))));
    };
    let mut taken = inputs;
    let mut all = Vec::new();
    for (k, result) in spec.results.iter().enumerate() {
        let array = arrays::given(result.name, &arrays.get_item(k)?, axes(k), &taken)?;
        let first = array.data() as usize;
        taken.push((result.name, (first, first + numpy::PyUntypedArrayMethods::len(&array) * size_of::<f64>())));
        all.push(array);
    }
    Ok(all)
}

type Singles<'py> = Vec<Bound<'py, PyArrayDyn<f32>>>;

/// The arrays of `out` where all of them are of 32-bit floats: results are computed in 64 bits, and rounded into them
/// when all are known, so that they may share memory with arguments.
fn singles<'py>(
    scene: &dyn AnyScene,
    spec: &Spec,
    batch: Batch<'_>,
    out: &Bound<'py, PyAny>,
) -> PyResult<Option<Singles<'py>>> {
    let all: Option<Singles<'py>> = match (spec.results.len(), out.cast::<PyTuple>()) {
        (1, _) => arrays::single(out).map(|array| vec![array]),
        (count, Ok(tuple)) if tuple.len() == count => tuple.iter().map(|out| arrays::single(&out)).collect(),
        _ => None,
    };
    let arrays = all.as_deref().unwrap_or_default();
    for (k, array) in arrays.iter().enumerate() {
        let own = spec.results[k].axes.iter().map(|axis| scene.sizes().get(*axis));
        let name = if spec.results.len() == 1 { "out" } else { spec.results[k].name };
        arrays::takes(name, array, &batch.axes.iter().copied().chain(own).collect::<Vec<_>>())?;
        for (other, result) in arrays[..k].iter().zip(spec.results) {
            if arrays::overlap(array, other)? {
                return Err(PyValueError::new_err(format!("{name} shares memory with {}", result.name)));
            }
        }
    }
    Ok(all)
}

/// All rows, while other threads of Python run where there are many. All arrays of the method have these rows: `call`
/// has compared their shapes.
fn compute(
    py: Python<'_>,
    kernel: &dyn AnyKernel,
    id: Id,
    work: &Work,
    count: usize,
    own: &[OwnParameter],
) -> Result<(), Fault> {
    // SAFETY: as above.
    #[allow(unsafe_code)]
    let all = || unsafe { rows_with(kernel, id, work, count, own) };
    if own.is_empty() && count < DETACHED { all() } else { py.detach(all) }
}

/// All rows, with parameters of their own, where there are any.
///
/// # Safety
/// As of [`rows`].
#[allow(unsafe_code)]
pub unsafe fn rows_with(
    kernel: &dyn AnyKernel,
    id: Id,
    work: &Work,
    count: usize,
    own: &[OwnParameter],
) -> Result<(), Fault> {
    let with = |row: Option<usize>| {
        let made = kernel.with(own::numbers(own, kernel.numbers(), row.unwrap_or(0)));
        made.map_err(|all| Fault::Parameters(row, all))
    };
    // SAFETY: of this function.
    let shared = |kernel: &dyn AnyKernel| unsafe { rows(kernel, id, work, count) }.map_err(Fault::OffGroup);
    let each = |range: Range<usize>| {
        range.into_iter().try_for_each(|row| {
            let one = with(Some(row))?;
            // SAFETY: of this function.
            let computed = unsafe { one.run(id, &work.beginning(row), 0..1) };
            computed.map_err(|off| Fault::OffGroup(OffGroup { row, ..off }))
        })
    };
    match own {
        [] => shared(kernel),
        own if own.iter().all(|own| own.leading().is_empty()) => shared(&*with(None)?),
        _ => in_chunks(count, CHUNK_OF_KERNELS, each, Fault::row),
    }
}

/// All rows, on all threads where there are many.
///
/// # Safety
/// All arrays that the method names have these rows, each of the sizes of the scene.
#[allow(unsafe_code)]
unsafe fn rows(kernel: &dyn AnyKernel, id: Id, work: &Work, count: usize) -> Result<(), OffGroup> {
    // SAFETY: of this function.
    let run = |rows| unsafe { kernel.run(id, work, rows) };
    in_chunks(count, CHUNK, run, |off| off.row)
}

/// All rows, on all threads where there are more than a thread takes at a time; the first row that is refused.
fn in_chunks<E: Send>(
    count: usize,
    chunk: usize,
    run: impl Fn(Range<usize>) -> Result<(), E> + Sync,
    row: impl Fn(&E) -> usize + Sync,
) -> Result<(), E> {
    // One thread alone need not be woken, and where the system gives none this one computes.
    let pool = if count > chunk { threads::pool().ok().filter(|pool| pool.current_num_threads() > 1) } else { None };
    let Some(pool) = pool else { return run(0..count) };
    let first: Mutex<Option<E>> = Mutex::new(None);
    pool.install(|| {
        (0..count.div_ceil(chunk)).into_par_iter().for_each(|k| {
            if let Err(fault) = run(k * chunk..((k + 1) * chunk).min(count))
                && let Ok(mut first) = first.lock()
                && first.as_ref().is_none_or(|other| row(&fault) < row(other))
            {
                *first = Some(fault);
            }
        });
    });
    first.into_inner().ok().flatten().map_or(Ok(()), Err)
}

/// The exception for a row that is refused.
fn refused(py: Python<'_>, (scene, spec): (&dyn AnyScene, &Spec), fault: Fault, batch: Batch<'_>) -> PyErr {
    match fault {
        Fault::OffGroup(off) => off_group(spec, &off, batch),
        Fault::Parameters(row, all) => no_body(py, scene, row.map(|row| index(row, batch)), all),
    }
}

/// The message for a rotation that is none, with its place as Python indexes it.
fn off_group(spec: &Spec, off: &OffGroup, batch: Batch<'_>) -> PyErr {
    let name = spec.arguments.iter().find(|argument| argument.slot == off.slot).map_or("q", |argument| argument.name);
    let mut index = index(off.row, batch);
    index.push(format!("{}:{}", off.place, off.place + off.count));
    PyValueError::new_err(format!("{name}[{}] is no rotation: {}", index.join(", "), off_group_words(off.squares)))
}

/// The place of a row in the batch, as Python indexes it.
fn index(row: usize, batch: Batch<'_>) -> Vec<String> {
    let (mut rest, mut index) = (row, Vec::new());
    for axis in batch.axes.iter().rev() {
        index.push((rest % axis).to_string());
        rest /= axis;
    }
    index.reverse();
    index
}

/// The exception for parameters that no body can have, of a row by its place.
fn no_body(py: Python<'_>, scene: &dyn AnyScene, row: Option<Vec<String>>, all: Vec<Violation>) -> PyErr {
    let place = row.map_or_else(String::new, |row| format!(", in row [{}]", row.join(", ")));
    let mistakes = all.iter().map(|one| (one.field.clone(), format!("{}{place}", one.message))).collect();
    parameters::raised(py, scene, mistakes, all)
}
