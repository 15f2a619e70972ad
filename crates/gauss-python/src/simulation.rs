//! `simulate` and `ensemble` of the class.

use std::sync::atomic::{AtomicUsize, Ordering};

use gauss_runtime::integrate::{Method, StepSetting};
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::vector;
use crate::calls::{Calls, Progress, watched_run};
use crate::class::Kernel;
use crate::ends::Ends;
use crate::errors;
use crate::given::{self, GivenController, GivenEvent, GivenInput, Words, states};
use crate::run::Run;
use crate::runs::Many;
use crate::steps::{Control, Held, Input, Outcome, Request};

/// One run as it was given.
struct Given {
    q: Vec<f64>,
    z: Vec<f64>,
    interval: (f64, f64),
    control: Control,
    input: GivenInput,
    controller: Option<GivenController>,
    /// Jumps, which errors number from 0 on, then events, then ends.
    watched: Vec<GivenEvent>,
    times: Option<Vec<f64>>,
    limit: Option<u64>,
}

impl Given {
    /// Runs it.
    fn run(&self, py: Python<'_>, kernel: &Kernel, calls: &Calls) -> PyResult<Outcome> {
        let kernel = kernel.kernel();
        let size = kernel.scene().sizes().input;
        let of_function = |function: &Py<PyAny>, at: (f64, &[f64], &[f64])| {
            let read = |value: &Bound<'_, PyAny>| vector("input", value, size);
            calls.call(function, at, read).unwrap_or_else(|| vec![f64::NAN; size])
        };
        let by_function = |t: f64, q: &[f64], z: &[f64]| match &self.input {
            GivenInput::Function(function) => of_function(function, (t, q, z)),
            GivenInput::Numbers(_) | GivenInput::Table(_) => Vec::new(),
        };
        let law = |t: f64, q: &[f64], z: &[f64]| match &self.controller {
            Some(controller) => of_function(&controller.law, (t, q, z)),
            None => Vec::new(),
        };
        let input = match &self.input {
            GivenInput::Numbers(numbers) => Input::Constant(numbers.clone()),
            GivenInput::Table(table) => Input::Table(table.clone()),
            GivenInput::Function(_) => Input::Function(&by_function),
        };
        let functions =
            self.watched.iter().map(|event| (given::watch(event, calls), given::jump(event, calls, kernel)));
        let functions: Vec<_> = functions.collect();
        let until = self.watched.iter().zip(&functions);
        let until: Vec<_> = until.map(|(event, (watch, jump))| given::until_of(event, (watch, jump))).collect();
        let request = Request {
            q: &self.q,
            z: &self.z,
            interval: self.interval,
            control: self.control,
            input: &input,
            controller: self.controller.as_ref().map(|held| Held { period: held.period, delay: held.delay, law: &law }),
            until: &until,
            times: self.times.as_deref(),
            limit: self.limit,
            stop: &calls.stop,
            look: &|t| calls.look(t),
        };
        py.detach(|| kernel.simulate(&request)).map_err(PyValueError::new_err)
    }
}

#[pymethods]
impl Kernel {
    /// Carries a state from `interval[0]` to `interval[1]`, by the method of Dormand and Prince of order 8: with steps
    /// as long as the tolerances allow, or of the length `step`. `method` is another one: "rosenbrock" or
    /// "radau" for stiff scenes, "taylor", or "collocation", implicit, with `step`.
    ///
    /// `input` is an array, a pair (times, values), straight between them, or a function of (t, q, z). `controller` is
    /// a function of (t, q, z) that is called every `period`; what it gives is held, from `delay` after that on, and
    /// added to the input. `until` ends the run early: (name, value), (name, value, "falling"), a function of (t, q,
    /// z), or a list of such; states at `events`, as these, are found in the run. `jumps` are pairs of such an event
    /// and a function of (t, q, z) that gives another (q, z). `times` are those of the states that are given back,
    /// instead of the ends of steps.
    ///
    /// Scenes with contacts, ranges or dry friction run from event to event, with `impact`, the law of impacts
    /// ("newton", "moreau", "poisson", "sequential"); or with `contacts="steps"` in steps of the length `step`, at most
    /// where `rtol` or `atol` are given, with `friction` ("coulomb", "relaxed") and `scheme` ("midpoint",
    /// "moreau_jean").
    ///
    /// `progress` is a function of the time, or True for a bar of tqdm. Ctrl-C, and an exception in a function, end the
    /// run and are raised with what there is of it, as `run`.
    #[pyo3(signature = (q, z, interval, *, rtol=None, atol=None, step=None, largest_step=None, method=None, input=None,
        controller=None, period=None, delay=0.0, until=None, events=None, jumps=None, times=None, max_steps=None,
        contacts=None, impact=None, friction=None, scheme=None, progress=None))]
    #[expect(clippy::too_many_arguments, reason = "keywords")]
    fn simulate<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        z: &Bound<'py, PyAny>,
        interval: &Bound<'py, PyAny>,
        rtol: Option<f64>,
        atol: Option<f64>,
        step: Option<f64>,
        largest_step: Option<f64>,
        method: Option<&str>,
        input: Option<&Bound<'py, PyAny>>,
        controller: Option<&Bound<'py, PyAny>>,
        period: Option<f64>,
        delay: f64,
        until: Option<&Bound<'py, PyAny>>,
        events: Option<&Bound<'py, PyAny>>,
        jumps: Option<&Bound<'py, PyAny>>,
        times: Option<&Bound<'py, PyAny>>,
        max_steps: Option<u64>,
        contacts: Option<&str>,
        impact: Option<&str>,
        friction: Option<&str>,
        scheme: Option<&str>,
        progress: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, Run>> {
        let interval = given::interval(interval)?;
        let (scene, sizes) = (self.scene(), self.scene().sizes());
        given::checked(interval, (rtol, atol), (step, largest_step))?;
        let tolerances = (rtol, atol, largest_step);
        let words = Words { method, step, tolerances, contacts, impact, friction, scheme };
        let [events, jumps, ends] =
            [given::events(scene, events, false)?, given::jumps(scene, jumps)?, given::events(scene, until, true)?];
        let kinds = (jumps.len(), events.len());
        let given = Given {
            q: vector("q", q, sizes.configuration)?,
            z: vector("z", z, sizes.speeds)?,
            interval,
            control: given::control("run", self.touches(), words)?,
            input: given::input(scene, input, controller.is_some())?,
            controller: given::controller(scene, controller, period, delay)?,
            watched: jumps.into_iter().chain(events).chain(ends).collect(),
            times: times.map(|times| given::times_within(times, interval)).transpose()?,
            limit: max_steps,
        };
        // Last of all, so that no bar is shown for a run that is refused.
        let calls = Calls::new(Progress::of(progress, interval, "s")?);
        let run = given.run(py, self, &calls).map(|outcome| Run::new(scene, outcome, kinds));
        calls.end(py, run.as_ref().map_or(interval.0, Run::reached));
        match calls.error() {
            None => finished(py, run?),
            Some(error) => Err(ended_by(py, error, "run", run.and_then(|run| run.into_bound_py_any(py)))),
        }
    }

    /// Carries many states, in lanes and on all threads, each with steps of its own: q and z are rows, or one for all;
    /// `parameters` has an array with a number for each run. `input` is an array or a pair (times, values); `until` is
    /// (name, value) or (name, value, direction). With contacts each run is as `simulate` makes it, and `contacts`,
    /// `step`, `largest_step`, `impact`, `friction`, `scheme` are those of it. Runs that fail, or cannot begin, are
    /// told of in `errors`, each with all that is wrong. `progress` is a function of the number of runs that have
    /// ended, or True for a bar of tqdm. Ctrl-C ends all runs and is raised with what there is, as `ends`.
    #[pyo3(signature = (q, z, interval, *, rtol=None, atol=None, step=None, largest_step=None, input=None, until=None,
        parameters=None, max_steps=None, contacts=None, impact=None, friction=None, scheme=None, progress=None))]
    #[expect(clippy::too_many_arguments, reason = "keywords")]
    fn ensemble<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        z: &Bound<'py, PyAny>,
        interval: &Bound<'py, PyAny>,
        rtol: Option<f64>,
        atol: Option<f64>,
        step: Option<f64>,
        largest_step: Option<f64>,
        input: Option<&Bound<'py, PyAny>>,
        until: Option<&Bound<'py, PyAny>>,
        parameters: Option<&Bound<'py, PyDict>>,
        max_steps: Option<u64>,
        contacts: Option<&str>,
        impact: Option<&str>,
        friction: Option<&str>,
        scheme: Option<&str>,
        progress: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Ends> {
        let interval = given::interval(interval)?;
        let (kernel, scene) = (self.kernel(), self.kernel().scene());
        let sizes = scene.sizes();
        given::checked(interval, (rtol, atol), (step, largest_step))?;
        let own = [("step", step), ("largest_step", largest_step)].into_iter().find(|(_, given)| given.is_some());
        if let (false, Some((word, _))) = (self.touches(), own) {
            return Err(PyTypeError::new_err(format!("{word} is of contacts, and none act in this ensemble")));
        }
        let tolerances = (rtol, atol, largest_step);
        let words = Words { method: None, step, tolerances, contacts, impact, friction, scheme };
        let control = given::control("ensemble", self.touches(), words)?;
        let (q, z) = (states("q", q, sizes.configuration)?, states("z", z, sizes.speeds)?);
        let own = given::own_parameters(scene, parameters)?;
        let counts = [("q", q.1), ("z", z.1)].into_iter();
        let counts = counts.chain(own.iter().map(|(name, _, values)| (name.as_str(), Some(values.len()))));
        let count = given::common(counts)?;
        let input = match given::input(scene, input, false)? {
            GivenInput::Numbers(numbers) => Input::Constant(numbers),
            GivenInput::Table(table) => Input::Table(table),
            GivenInput::Function(_) => {
                return Err(PyTypeError::new_err("the input of an ensemble is an array or a pair (times, values)"));
            }
        };
        let until = given::one_end(given::ends(scene, until)?)?;
        let repeated = |(numbers, rows): (Vec<f64>, Option<usize>)| match rows {
            Some(_) => numbers,
            None => numbers.repeat(count),
        };
        let (q, z) = (repeated(q), repeated(z));
        let calls = Calls::new(Progress::of(progress, (0.0, count as f64), "run")?);
        let ended = AtomicUsize::new(0);
        let many = Many {
            count,
            q: &q,
            z: &z,
            parameters: own.into_iter().map(|(_, place, values)| (place, values)).collect(),
            interval,
            control,
            limit: max_steps,
            input,
            until,
            stop: &calls.stop,
            ended: &ended,
        };
        let so_many = || ended.load(Ordering::Relaxed) as f64;
        let ends = py.detach(|| watched_run(|| kernel.ensemble(&many), &calls, &so_many));
        drop(many);
        let interrupted = calls.stop.load(Ordering::Relaxed);
        calls.end(py, so_many());
        let ends =
            ends?.map_err(PyValueError::new_err).map(|ends| Ends::new(scene, ends, (self.touches(), interrupted)));
        match calls.error() {
            None => ends,
            Some(error) => Err(ended_by(py, error, "ends", ends.and_then(|ends| ends.into_bound_py_any(py)))),
        }
    }
}

/// The exception that ended a run before its time, with what there is of the run.
fn ended_by(py: Python<'_>, error: PyErr, name: &str, there: PyResult<Bound<'_, PyAny>>) -> PyErr {
    if let Ok(there) = there {
        // An exception that takes no attributes is raised as it is.
        let _ = error.value(py).setattr(name, there);
    }
    error
}

/// The run; an error of Python that has it, where it did not reach its end.
fn finished(py: Python<'_>, run: Run) -> PyResult<Bound<'_, Run>> {
    let run = Bound::new(py, run)?;
    match run.get().failure() {
        None => Ok(run),
        Some(failure) => Err(errors::new(py, "IntegrationError", failure.to_owned(), ("run", run.clone()))),
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
        let input = match given::input(self.kernel().scene(), input, false)? {
            GivenInput::Numbers(numbers) => Input::Constant(numbers),
            _ => return Err(PyTypeError::new_err("the input is an array")),
        };
        let (calls, ended) = (Calls::new(None), AtomicUsize::new(0));
        let many = Many {
            count: rows.unwrap_or(1),
            q: &q,
            z: &z,
            parameters: Vec::new(),
            interval: (0.0, 0.0),
            control: Control::Smooth(Method::DormandPrince8, StepSetting::tolerant(1.0, 1.0)),
            limit: None,
            input,
            until: None,
            stop: &calls.stop,
            ended: &ended,
        };
        let time = py.detach(|| self.kernel().batch_time(&many)).map_err(PyValueError::new_err)?;
        Ok(time.as_secs_f64())
    }
}
