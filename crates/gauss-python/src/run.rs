//! Runs in Python: what became of one, and of many.

use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyCapsule, PyList};

use crate::columns::Columns;
use crate::kernels::AnyScene;
use crate::runs::ManyEnds;
use crate::steps::Outcome;

pyo3::create_exception!(
    gauss_python,
    IntegrationError,
    pyo3::exceptions::PyRuntimeError,
    "A run that did not reach its end: `run` has the states up to the last good one."
);

/// A run: its states in columns that NumPy and Arrow see without a copy.
#[pyclass(frozen, module = "gauss_python")]
pub struct Run {
    columns: Columns,
    coordinates: usize,
    speeds: usize,
    /// How many events were looked for.
    kinds: usize,
    outcome: Outcome,
}

impl Run {
    /// The run of a scene in which so many events were looked for.
    pub fn new(scene: &dyn AnyScene, mut outcome: Outcome, kinds: usize) -> Self {
        let (sizes, numbers) = (scene.sizes(), std::mem::take(&mut outcome.columns));
        let names = names(scene, &["kinetic_energy", "potential_energy"]);
        let columns = Columns::new(names, numbers, outcome.rows);
        Self { columns, coordinates: sizes.configuration, speeds: sizes.speeds, kinds, outcome }
    }

    /// When it ended.
    pub fn reached(&self) -> f64 {
        self.outcome.reached
    }

    /// The times and states of one event.
    fn event<'py>(&self, py: Python<'py>, number: usize) -> PyResult<Bound<'py, PyAny>> {
        static CLASS: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
        let class = CLASS.get_or_try_init(py, || {
            let class = py.import("collections")?.call_method1("namedtuple", ("Events", ["t", "q", "z"]))?;
            Ok::<_, PyErr>(class.unbind())
        })?;
        let rows: Vec<&[f64]> =
            self.outcome.events.iter().filter(|event| event.number == number).map(|event| &event.row[..]).collect();
        let part = |from: usize, count: usize| {
            let numbers = rows.iter().flat_map(|row| &row[from..from + count]).copied().collect();
            PyArray1::from_vec(py, numbers).call_method1("reshape", ((rows.len(), count),))
        };
        let t = part(0, 1)?.call_method0("ravel")?;
        class.bind(py).call1((t, part(1, self.coordinates)?, part(1 + self.coordinates, self.speeds)?))
    }

    /// Why it did not reach its end.
    pub fn failure(&self) -> Option<&str> {
        self.outcome.error.as_deref()
    }
}

/// `t`, the numbers of q and z, and more.
fn names(scene: &dyn AnyScene, more: &[&str]) -> Vec<String> {
    let [coordinates, speeds] = scene.names();
    let all = ["t"].iter().chain(coordinates).chain(speeds).chain(more);
    all.map(ToString::to_string).collect()
}

#[pymethods]
impl Run {
    /// Times, in order.
    #[getter]
    fn t<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.get().columns.column(slf.clone().into_any(), "t")
    }

    /// Configurations, a row for each time.
    #[getter]
    fn q<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray2<f64>> {
        let run = slf.get();
        run.columns.view(slf.clone().into_any(), 1, run.coordinates)
    }

    /// Speeds, a row for each time.
    #[getter]
    fn z<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray2<f64>> {
        let run = slf.get();
        run.columns.view(slf.clone().into_any(), 1 + run.coordinates, run.speeds)
    }

    /// Kinetic energies.
    #[getter]
    fn kinetic_energy<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.get().columns.column(slf.clone().into_any(), "kinetic_energy")
    }

    /// Potential energies.
    #[getter]
    fn potential_energy<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.get().columns.column(slf.clone().into_any(), "potential_energy")
    }

    /// The names of the columns.
    #[getter]
    fn columns(&self) -> Vec<String> {
        self.columns.names().to_vec()
    }

    /// Times and states of `events`, one after the other as they were asked for: tuples t, q, z of arrays.
    #[getter]
    fn events<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let events: PyResult<Vec<_>> = (0..self.kinds).map(|number| self.event(py, number)).collect();
        PyList::new(py, events?)
    }

    /// The number of the end in `until` that it came to; none where it went on to its time.
    #[getter]
    fn stopped_by(&self) -> Option<usize> {
        self.outcome.stopped_by
    }

    /// Whether it was interrupted, by Ctrl-C.
    #[getter]
    fn interrupted(&self) -> bool {
        self.outcome.interrupted
    }

    /// Why it did not reach its end; none where it did.
    #[getter]
    fn error(&self) -> Option<&str> {
        self.failure()
    }

    /// Steps that were made.
    #[getter]
    fn steps(&self) -> u64 {
        self.outcome.summary.steps
    }

    /// Steps that were tried and rejected.
    #[getter]
    fn rejected(&self) -> u64 {
        self.outcome.summary.rejected
    }

    fn __getitem__<'py>(slf: &Bound<'py, Self>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        slf.get().columns.column(slf.clone().into_any(), name)
    }

    fn __len__(&self) -> usize {
        self.columns.len()
    }

    /// All columns for programs that read Arrow.
    #[pyo3(signature = (requested_schema=None))]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyCapsule>> {
        // A wish that need not be fulfilled, by the protocol.
        let _ = requested_schema;
        self.columns.stream(py)
    }

    fn __repr__(&self) -> String {
        let Self { columns, outcome, .. } = self;
        let end = match (&outcome.error, outcome.interrupted, outcome.stopped_by) {
            (Some(error), ..) => format!(", {error}"),
            (_, true, _) => ", interrupted".to_owned(),
            (.., Some(number)) => format!(", stopped by {number}"),
            _ => String::new(),
        };
        format!("Run({} states, {}{end})", columns.len(), outcome.summary)
    }
}

/// The ends of many runs, a row for each.
#[pyclass(frozen, module = "gauss_python")]
pub struct Ends {
    columns: Columns,
    coordinates: usize,
    speeds: usize,
    stopped: Vec<bool>,
    errors: Vec<(usize, String)>,
    interrupted: bool,
}

impl Ends {
    /// Those of a scene.
    pub fn new(scene: &dyn AnyScene, ends: ManyEnds, interrupted: bool) -> Self {
        let sizes = scene.sizes();
        let ManyEnds { columns, stopped, errors } = ends;
        let mut names = names(scene, &["steps"]);
        if columns.is_empty() {
            names.clear();
        }
        let columns = Columns::new(names, columns, stopped.len());
        Self { columns, coordinates: sizes.configuration, speeds: sizes.speeds, stopped, errors, interrupted }
    }
}

#[pymethods]
impl Ends {
    /// When each run ended.
    #[getter]
    fn t<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.get().columns.column(slf.clone().into_any(), "t")
    }

    /// The last configuration of each.
    #[getter]
    fn q<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray2<f64>> {
        let ends = slf.get();
        ends.columns.view(slf.clone().into_any(), 1, ends.coordinates)
    }

    /// The last speeds of each.
    #[getter]
    fn z<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray2<f64>> {
        let ends = slf.get();
        ends.columns.view(slf.clone().into_any(), 1 + ends.coordinates, ends.speeds)
    }

    /// Whether each came to the end in `until`.
    #[getter]
    fn stopped<'py>(&self, py: Python<'py>) -> Bound<'py, numpy::PyArray1<bool>> {
        numpy::PyArray1::from_slice(py, &self.stopped)
    }

    /// Runs that did not reach their end: pairs of a number and a reason.
    #[getter]
    fn errors(&self) -> Vec<(usize, String)> {
        self.errors.clone()
    }

    /// Whether they were interrupted, by Ctrl-C.
    #[getter]
    fn interrupted(&self) -> bool {
        self.interrupted
    }

    /// The names of the columns.
    #[getter]
    fn columns(&self) -> Vec<String> {
        self.columns.names().to_vec()
    }

    fn __getitem__<'py>(slf: &Bound<'py, Self>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        slf.get().columns.column(slf.clone().into_any(), name)
    }

    fn __len__(&self) -> usize {
        self.stopped.len()
    }

    /// All columns for programs that read Arrow.
    #[pyo3(signature = (requested_schema=None))]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyCapsule>> {
        let _ = requested_schema;
        self.columns.stream(py)
    }

    fn __repr__(&self) -> String {
        format!("Ends({} runs, {} failed)", self.stopped.len(), self.errors.len())
    }
}
