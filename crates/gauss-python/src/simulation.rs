//! `simulate` and `ensemble` of the class.

use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use gauss_runtime::prelude::Crossing;
use numpy::PyArray1;
use pyo3::exceptions::{PyKeyError, PyKeyboardInterrupt, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyTuple};

use crate::arrays::{self, shown};
use crate::class::Kernel;
use crate::kernels::AnyScene;
use crate::run::{Ends, IntegrationError, Run};
use crate::runs::{Control, Function, Input, Many, Request, Table, Until, Watched};

/// How long a run goes on before somebody looks for Ctrl-C.
const PATIENCE: Duration = Duration::from_millis(50);

/// Functions of Python in a run: the first error of any ends it.
struct Calls {
    stop: AtomicBool,
    error: Mutex<Option<PyErr>>,
    begin: Instant,
    looked: AtomicU64,
}

impl Calls {
    fn new() -> Self {
        let (stop, error) = (AtomicBool::new(false), Mutex::new(None));
        Self { stop, error, begin: Instant::now(), looked: AtomicU64::new(0) }
    }

    fn fail(&self, error: PyErr) {
        self.stop.store(true, Ordering::Relaxed);
        if let Ok(mut first) = self.error.lock() {
            first.get_or_insert(error);
        }
    }

    /// Looks for Ctrl-C now and then.
    fn look(&self) {
        let now = self.begin.elapsed().as_millis() as u64;
        if now >= self.looked.load(Ordering::Relaxed) + PATIENCE.as_millis() as u64 {
            self.looked.store(now, Ordering::Relaxed);
            if let Err(error) = Python::attach(|py| py.check_signals()) {
                self.fail(error);
            }
        }
    }

    /// The error, unless it is an interruption.
    fn error(self, py: Python<'_>) -> Option<PyErr> {
        let error = self.error.into_inner().ok().flatten();
        error.filter(|error| !error.is_instance_of::<PyKeyboardInterrupt>(py))
    }

    /// Calls a function of Python with a time and a state.
    fn call<R>(
        &self,
        function: &Py<PyAny>,
        (t, q, z): (f64, &[f64], &[f64]),
        read: impl Fn(&Bound<'_, PyAny>) -> PyResult<R>,
    ) -> Option<R> {
        if self.stop.load(Ordering::Relaxed) {
            return None;
        }
        Python::attach(|py| {
            let state = (t, PyArray1::from_slice(py, q), PyArray1::from_slice(py, z));
            let value = function.bind(py).call1(state).and_then(|value| read(&value));
            value.map_err(|error| self.fail(error)).ok()
        })
    }
}

/// What an input may be in Python.
enum GivenInput {
    Numbers(Vec<f64>),
    Table(Table),
    Function(Py<PyAny>),
}

fn input(scene: &dyn AnyScene, given: Option<&Bound<'_, PyAny>>) -> PyResult<GivenInput> {
    let size = scene.sizes().input;
    let Some(given) = given else {
        if size == 0 {
            return Ok(GivenInput::Numbers(Vec::new()));
        }
        let words: Vec<&str> = scene.description().inputs.iter().map(|part| part.name).collect();
        return Err(PyTypeError::new_err(format!("the run needs an input: {}", words.join(", "))));
    };
    if given.is_callable() {
        return Ok(GivenInput::Function(given.clone().unbind()));
    }
    if let Ok(pair) = given.cast::<PyTuple>()
        && pair.len() == 2
        && pair.get_item(0)?.extract::<f64>().is_err()
    {
        return table(&pair.get_item(0)?, &pair.get_item(1)?, size).map(GivenInput::Table);
    }
    let (numbers, axes) = arrays::numbers("input", given)?;
    match axes[..] {
        [count] if count == size => Ok(GivenInput::Numbers(numbers)),
        _ => Err(PyValueError::new_err(format!("input has shape {}; expected ({size},)", shown(&axes)))),
    }
}

fn table(times: &Bound<'_, PyAny>, values: &Bound<'_, PyAny>, size: usize) -> PyResult<Table> {
    let ((times, of_times), (values, of_values)) =
        (arrays::numbers("times of the input", times)?, arrays::numbers("values of the input", values)?);
    let rows = times.len();
    let fits = of_times == [rows] && (of_values == [rows, size] || size == 1 && of_values == [rows]);
    if rows == 0 || !fits {
        let (of_times, of_values) = (shown(&of_times), shown(&of_values));
        return Err(PyValueError::new_err(format!(
            "an input over time is (times, values) of shapes (n,) and (n, {size}); found {of_times} and {of_values}"
        )));
    }
    // What is not a number does not increase.
    let increases = |k: usize| times[k - 1].partial_cmp(&times[k]).is_some_and(core::cmp::Ordering::is_lt);
    if let Some(k) = (1..rows).find(|&k| !increases(k)) {
        return Err(PyValueError::new_err(format!("times of the input do not increase at number {k}")));
    }
    Ok(Table { times, values })
}

/// What ends a run, as given in Python.
enum GivenEnd {
    Number(usize, f64),
    Function(Py<PyAny>),
}

fn crossing(word: &str) -> PyResult<Crossing> {
    match word {
        "any" => Ok(Crossing::Any),
        "rising" => Ok(Crossing::Rising),
        "falling" => Ok(Crossing::Falling),
        _ => Err(PyValueError::new_err(format!("{word:?} is no direction; there are any, rising, falling"))),
    }
}

/// `(name, value)`, `(name, value, direction)`, a function, `(function, direction)`.
fn end(scene: &dyn AnyScene, given: &Bound<'_, PyAny>) -> PyResult<(GivenEnd, Crossing)> {
    if given.is_callable() {
        return Ok((GivenEnd::Function(given.clone().unbind()), Crossing::Any));
    }
    if let Ok((function, word)) = given.extract::<(Bound<'_, PyAny>, String)>()
        && function.is_callable()
    {
        return Ok((GivenEnd::Function(function.unbind()), crossing(&word)?));
    }
    let named = match given.extract::<(String, f64)>() {
        Ok((name, value)) => Ok((name, value, "any".to_owned())),
        Err(_) => given.extract::<(String, f64, String)>(),
    };
    let Ok((name, value, word)) = named else {
        let what =
            "an end is (name, value), (name, value, direction), a function of (t, q, z), or (function, direction)";
        return Err(PyTypeError::new_err(what));
    };
    let names = scene.names().concat();
    match names.iter().position(|other| *other == name) {
        Some(place) => Ok((GivenEnd::Number(place, value), crossing(&word)?)),
        None => {
            Err(PyKeyError::new_err(format!("no number of a state is called {name}; there are {}", names.join(", "))))
        }
    }
}

fn ends(scene: &dyn AnyScene, given: Option<&Bound<'_, PyAny>>) -> PyResult<Vec<(GivenEnd, Crossing)>> {
    match given {
        None => Ok(Vec::new()),
        Some(given) => match given.cast::<PyList>() {
            Ok(list) => list.iter().map(|given| end(scene, &given)).collect(),
            Err(_) => Ok(vec![end(scene, given)?]),
        },
    }
}

/// Finite numbers, and what else must hold of tolerances and steps.
fn checked(interval: (f64, f64), positive: &[(&str, f64)]) -> PyResult<()> {
    if !(interval.0.is_finite() && interval.1.is_finite()) {
        return Err(PyValueError::new_err("the interval is a pair of finite times"));
    }
    match positive.iter().find(|(_, value)| value.is_nan() || *value <= 0.0) {
        Some((name, value)) => Err(PyValueError::new_err(format!("{name} must be positive, found {value}"))),
        None => Ok(()),
    }
}

/// Times of states that are wanted: within the interval.
fn times_within(given: &Bound<'_, PyAny>, (from, to): (f64, f64)) -> PyResult<Vec<f64>> {
    let (times, axes) = arrays::numbers("times", given)?;
    let (least, most) = (from.min(to), from.max(to));
    match times.iter().find(|time| !(least..=most).contains(*time)) {
        _ if axes.len() != 1 => Err(PyValueError::new_err(format!("times has shape {}; expected (n,)", shown(&axes)))),
        Some(time) => Err(PyValueError::new_err(format!("the time {time} is outside of the run"))),
        None => Ok(times),
    }
}

fn state(name: &'static str, given: &Bound<'_, PyAny>, size: usize) -> PyResult<Vec<f64>> {
    let (numbers, axes) = arrays::numbers(name, given)?;
    match axes[..] {
        [count] if count == size => Ok(numbers),
        _ => Err(PyValueError::new_err(format!("{name} has shape {}; expected ({size},)", shown(&axes)))),
    }
}

/// States of many runs: rows, or one for all; how many.
fn states(name: &'static str, given: &Bound<'_, PyAny>, size: usize) -> PyResult<(Vec<f64>, Option<usize>)> {
    let (numbers, axes) = arrays::numbers(name, given)?;
    match axes[..] {
        [count] if count == size => Ok((numbers, None)),
        [runs, count] if count == size => Ok((numbers, Some(runs))),
        _ => {
            let expected = format!("({size},) or (runs, {size})");
            Err(PyValueError::new_err(format!("{name} has shape {}; expected {expected}", shown(&axes))))
        }
    }
}

#[pymethods]
impl Kernel {
    /// Carries a state from `interval[0]` to `interval[1]`, by the method of Dormand and Prince of order 8: with steps
    /// as long as the tolerances allow, or of the length `step`.
    ///
    /// `input` is an array, a pair (times, values), straight between them, or a function of (t, q, z). `until` ends the
    /// run early: (name, value), (name, value, "falling"), a function of (t, q, z), or a list of such. `times` are
    /// those of the states that are given back, instead of the ends of steps. Ctrl-C ends the run with what there is.
    #[pyo3(signature = (q, z, interval, *, rtol=1e-9, atol=1e-9, step=None, largest_step=None, input=None, until=None,
        times=None, max_steps=None))]
    #[expect(clippy::too_many_arguments, reason = "keywords")]
    fn simulate<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        z: &Bound<'py, PyAny>,
        interval: (f64, f64),
        rtol: f64,
        atol: f64,
        step: Option<f64>,
        largest_step: Option<f64>,
        input: Option<&Bound<'py, PyAny>>,
        until: Option<&Bound<'py, PyAny>>,
        times: Option<&Bound<'py, PyAny>>,
        max_steps: Option<u64>,
    ) -> PyResult<Bound<'py, Run>> {
        let (kernel, scene) = (self.kernel(), self.kernel().scene());
        let sizes = scene.sizes();
        let (q, z) = (state("q", q, sizes.configuration)?, state("z", z, sizes.speeds)?);
        let largest = largest_step.unwrap_or(f64::INFINITY);
        checked(interval, &[("rtol", rtol), ("atol", atol), ("step", step.unwrap_or(1.0)), ("largest_step", largest)])?;
        let control = step.map_or(Control::Adaptive(rtol, atol, largest), Control::Fixed);
        let (given, ends) = (self::input(scene, input)?, self::ends(scene, until)?);
        let times = times.map(|times| times_within(times, interval)).transpose()?;
        let calls = Calls::new();
        let of_function = |function: &Py<PyAny>, at: (f64, &[f64], &[f64])| {
            let read = |value: &Bound<'_, PyAny>| state("input", value, sizes.input);
            calls.call(function, at, read).unwrap_or_else(|| vec![f64::NAN; sizes.input])
        };
        let functions = |at: (f64, &[f64], &[f64])| match &given {
            GivenInput::Function(function) => of_function(function, at),
            GivenInput::Numbers(_) | GivenInput::Table(_) => Vec::new(),
        };
        let by_function = |t: f64, q: &[f64], z: &[f64]| functions((t, q, z));
        let input = match &given {
            GivenInput::Numbers(numbers) => Input::Constant(numbers.clone()),
            GivenInput::Table(table) => Input::Table(table.clone()),
            GivenInput::Function(_) => Input::Function(&by_function),
        };
        let watched: Vec<_> = ends.iter().map(|(end, _)| watch(end, &calls)).collect();
        let until = ends.iter().zip(&watched).map(|(end, watched)| until_of(end, watched));
        let (stop, look, limit) = (&calls.stop, &|| calls.look(), max_steps);
        let until = until.collect();
        let times = times.as_deref();
        let request = Request { q: &q, z: &z, interval, control, input, until, times, limit, stop, look };
        let outcome = py.detach(|| kernel.simulate(&request));
        drop(request);
        drop(watched);
        if let Some(error) = calls.error(py) {
            return Err(error);
        }
        finished(py, Run::new(scene, outcome.map_err(PyValueError::new_err)?))
    }

    /// Carries many states, in lanes and on all threads, each with steps of its own: q and z are rows, or one for all;
    /// `parameters` has an array with a number for each run. `input` is an array or a pair (times, values); `until` is
    /// (name, value) or (name, value, direction). Runs that fail are told of in `errors`.
    #[pyo3(signature = (q, z, interval, *, rtol=1e-9, atol=1e-9, input=None, until=None, parameters=None))]
    #[expect(clippy::too_many_arguments, reason = "keywords")]
    fn ensemble<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        z: &Bound<'py, PyAny>,
        interval: (f64, f64),
        rtol: f64,
        atol: f64,
        input: Option<&Bound<'py, PyAny>>,
        until: Option<&Bound<'py, PyAny>>,
        parameters: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Ends> {
        let (kernel, scene) = (self.kernel(), self.kernel().scene());
        let sizes = scene.sizes();
        checked(interval, &[("rtol", rtol), ("atol", atol)])?;
        let (q, z) = (states("q", q, sizes.configuration)?, states("z", z, sizes.speeds)?);
        let own = own_parameters(scene, parameters)?;
        let counts = [("q", q.1), ("z", z.1)].into_iter();
        let counts = counts.chain(own.iter().map(|(name, _, values)| (name.as_str(), Some(values.len()))));
        let count = common(counts)?;
        let input = match self::input(scene, input)? {
            GivenInput::Numbers(numbers) => Input::Constant(numbers),
            GivenInput::Table(table) => Input::Table(table),
            GivenInput::Function(_) => {
                return Err(PyTypeError::new_err("the input of an ensemble is an array or a pair (times, values)"));
            }
        };
        let until = one_end(self::ends(scene, until)?)?;
        let repeated = |(numbers, rows): (Vec<f64>, Option<usize>)| match rows {
            Some(_) => numbers,
            None => numbers.repeat(count),
        };
        let (q, z) = (repeated(q), repeated(z));
        let calls = Calls::new();
        let ended = AtomicUsize::new(0);
        let many = Many {
            count,
            q: &q,
            z: &z,
            parameters: own.into_iter().map(|(_, place, values)| (place, values)).collect(),
            interval,
            tolerances: (rtol, atol),
            input,
            until,
            stop: &calls.stop,
            ended: &ended,
        };
        let ends = py.detach(|| watched_run(|| kernel.ensemble(&many), &calls));
        drop(many);
        let interrupted = calls.stop.load(Ordering::Relaxed);
        Ok(Ends::new(scene, ends.map_err(PyValueError::new_err)?, interrupted))
    }
}

/// The run; an error of Python that has it, where it did not reach its end.
fn finished(py: Python<'_>, run: Run) -> PyResult<Bound<'_, Run>> {
    let run = Bound::new(py, run)?;
    match run.get().failure() {
        None => Ok(run),
        Some(failure) => {
            let error = IntegrationError::new_err(failure.to_owned());
            error.value(py).setattr("run", run.clone())?;
            Err(error)
        }
    }
}

/// An end of a run, with the function that is watched where it is one.
fn until_of<'a>((end, crossing): &(GivenEnd, Crossing), watched: Function<'a, f64>) -> Until<'a> {
    let watched = match end {
        GivenEnd::Number(place, value) => Watched::Number(*place, *value),
        GivenEnd::Function(_) => Watched::Function(watched),
    };
    Until { watched, crossing: *crossing }
}

/// The end of an ensemble: none, or one number.
fn one_end<'a>(mut ends: Vec<(GivenEnd, Crossing)>) -> PyResult<Option<Until<'a>>> {
    match (ends.pop(), ends.is_empty()) {
        (None, _) => Ok(None),
        (Some((GivenEnd::Number(place, value), crossing)), true) => {
            Ok(Some(Until { watched: Watched::Number(place, value), crossing }))
        }
        _ => Err(PyTypeError::new_err("the end of an ensemble is one (name, value), with a direction or not")),
    }
}

#[pymethods]
impl Kernel {
    /// Seconds of one thread for accelerations of this batch in Rust alone, for measurements.
    fn _batch_seconds(
        &self,
        py: Python<'_>,
        q: &Bound<'_, PyAny>,
        z: &Bound<'_, PyAny>,
        input: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<f64> {
        let sizes = self.kernel().scene().sizes();
        let ((q, rows), (z, _)) = (states("q", q, sizes.configuration)?, states("z", z, sizes.speeds)?);
        let input = match self::input(self.kernel().scene(), input)? {
            GivenInput::Numbers(numbers) => Input::Constant(numbers),
            _ => return Err(PyTypeError::new_err("the input is an array")),
        };
        let (calls, ended) = (Calls::new(), AtomicUsize::new(0));
        let many = Many {
            count: rows.unwrap_or(1),
            q: &q,
            z: &z,
            parameters: Vec::new(),
            interval: (0.0, 0.0),
            tolerances: (1.0, 1.0),
            input,
            until: None,
            stop: &calls.stop,
            ended: &ended,
        };
        let time = py.detach(|| self.kernel().batch_time(&many)).map_err(PyValueError::new_err)?;
        Ok(time.as_secs_f64())
    }
}

/// Runs on another thread while this one looks for Ctrl-C, which only the first thread of Python is told of.
fn watched_run<R: Send>(run: impl FnOnce() -> R + Send, calls: &Calls) -> R {
    std::thread::scope(|scope| {
        let (done, wait) = std::sync::mpsc::channel::<()>();
        let running = scope.spawn(move || {
            let result = run();
            drop(done);
            result
        });
        while let Err(std::sync::mpsc::RecvTimeoutError::Timeout) = wait.recv_timeout(PATIENCE) {
            calls.look();
        }
        running.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
    })
}

/// A function of Python that is watched.
fn watch<'a>(end: &'a GivenEnd, calls: &'a Calls) -> impl Fn(f64, &[f64], &[f64]) -> f64 + Sync + 'a {
    move |t, q, z| match end {
        GivenEnd::Function(function) => {
            calls.call(function, (t, q, z), |value| value.extract::<f64>()).unwrap_or(f64::NAN)
        }
        GivenEnd::Number(..) => f64::NAN,
    }
}

/// Parameters of single runs: name, place among all numbers, and the numbers.
fn own_parameters(scene: &dyn AnyScene, given: Option<&Bound<'_, PyDict>>) -> PyResult<Vec<(String, usize, Vec<f64>)>> {
    let mut own = Vec::new();
    for (name, values) in given.into_iter().flat_map(|given| given.iter()) {
        let name: String = name.extract()?;
        let fields = scene.description().fields;
        let Some(number) = fields.iter().position(|field| field.name == name && field.shape.size() == 1) else {
            let names: Vec<&str> =
                fields.iter().filter(|field| field.shape.size() == 1).map(|field| field.name).collect();
            let message = format!("{name} is no parameter that is one number; there are {}", names.join(", "));
            return Err(PyKeyError::new_err(message));
        };
        let place = fields[..number].iter().map(|field| field.shape.size()).sum();
        let (numbers, axes) = arrays::numbers(&name, &values)?;
        if axes.len() != 1 {
            return Err(PyValueError::new_err(format!("{name} has shape {}; expected (runs,)", shown(&axes))));
        }
        own.push((name, place, numbers));
    }
    Ok(own)
}

/// The number of runs that all arrays have.
fn common<'a>(counts: impl Iterator<Item = (&'a str, Option<usize>)>) -> PyResult<usize> {
    let mut known: Option<(&str, usize)> = None;
    for (name, count) in counts {
        let Some(count) = count else { continue };
        match known {
            Some((other, runs)) if runs != count => {
                return Err(PyValueError::new_err(format!("{other} has {runs} runs, {name} has {count}")));
            }
            _ => known = Some((name, count)),
        }
    }
    Ok(known.map_or(1, |(_, count)| count))
}
