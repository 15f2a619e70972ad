//! A run in Python.

use gauss_runtime::integrate::Summary;
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyCapsule, PyDict, PyList, PyTuple, PyType};

use crate::columns::Columns;
use crate::kernels::AnyScene;
use crate::steps::{Event, Happening, KINDS, Outcome, Touched, column_names};
use crate::tuples;

/// A run: its states in columns that NumPy and Arrow see without a copy.
#[pyclass(frozen, module = "gauss_python")]
pub struct Run {
    columns: Columns,
    coordinates: usize,
    speeds: usize,
    /// Numbers of jumps and of events that were looked for, one after the other.
    kinds: (usize, usize),
    /// The names of contacts, and how many rows each has; none where they have no part in the run.
    contacts: Vec<(String, usize)>,
    outcome: Outcome,
}

impl Run {
    /// The run of a scene in which so many jumps and events were looked for.
    pub fn new(scene: &dyn AnyScene, mut outcome: Outcome, kinds: (usize, usize)) -> Self {
        let (sizes, numbers) = (scene.sizes(), std::mem::take(&mut outcome.columns));
        let all = if outcome.touched.is_some() { scene.contacts() } else { &[] };
        let contacts = all.iter().map(|contact| (contact.name.to_owned(), contact.rows().len())).collect();
        let mut names = names(scene, &["kinetic_energy", "potential_energy"]);
        names.extend(column_names(all));
        let columns = Columns::new(names, numbers, outcome.rows);
        Self { columns, coordinates: sizes.configuration, speeds: sizes.speeds, kinds, contacts, outcome }
    }

    fn touched(&self) -> Touched {
        self.outcome.touched.clone().unwrap_or_default()
    }

    /// Events with these numbers.
    fn events_of<'py>(&self, py: Python<'py>, numbers: std::ops::Range<usize>) -> PyResult<Bound<'py, PyList>> {
        let events: PyResult<Vec<_>> = numbers.map(|number| self.event(py, number)).collect();
        PyList::new(py, events?)
    }

    /// The columns in panels: configuration, speeds, energies, gaps and slips of contacts, their forces.
    pub fn panels(&self) -> Vec<(&'static str, Vec<String>)> {
        let (state, rest) = self.columns.names()[1..].split_at(self.coordinates + self.speeds);
        let (q, z) = state.split_at(self.coordinates);
        let (energies, contacts) = rest.split_at(2);
        let is_force = |name: &&String| {
            let what = name.split_once(' ').map_or("", |(_, what)| what);
            ["force", "friction", "drilling"].iter().any(|word| what.starts_with(word))
        };
        let (forces, rates): (Vec<&String>, Vec<&String>) = contacts.iter().partition(is_force);
        let all = [
            ("configuration", q.iter().collect()),
            ("speeds", z.iter().collect()),
            ("energy", energies.iter().collect()),
            ("contacts", rates),
            ("forces", forces),
        ];
        let all = all.into_iter().map(|(title, own): (_, Vec<&String>)| (title, own.into_iter().cloned().collect()));
        all.filter(|(_, panel): &(_, Vec<String>)| !panel.is_empty()).collect()
    }

    /// The names of its columns: the time, the numbers of q and z, and more.
    pub fn column_names(&self) -> &[String] {
        self.columns.names()
    }

    /// When it ended.
    pub fn reached(&self) -> f64 {
        self.outcome.last[0]
    }

    /// The times and states of one event.
    fn event<'py>(&self, py: Python<'py>, number: usize) -> PyResult<Bound<'py, PyAny>> {
        let rows: Vec<&[f64]> =
            self.outcome.events.iter().filter(|event| event.number == number).map(|event| &event.row[..]).collect();
        let part = |from: usize, count: usize| {
            let numbers = rows.iter().flat_map(|row| &row[from..from + count]).copied().collect();
            PyArray1::from_vec(py, numbers).call_method1("reshape", ((rows.len(), count),))
        };
        let t = part(0, 1)?.call_method0("ravel")?;
        let fields = (t, part(1, self.coordinates)?, part(1 + self.coordinates, self.speeds)?);
        tuples::new(py, tuples::EVENTS, fields.into_pyobject(py)?)
    }

    /// Why it did not reach its end.
    pub fn failure(&self) -> Option<&str> {
        self.outcome.error.as_deref()
    }
}

/// `t`, the numbers of q and z, and more.
pub fn names(scene: &dyn AnyScene, more: &[&str]) -> Vec<String> {
    let [coordinates, speeds] = scene.names();
    let mut names: Vec<String> = vec!["t".to_owned()];
    // A name of the state stays, and one that is there already has a number behind it.
    for name in coordinates.iter().chain(speeds).chain(more) {
        let numbered = (2..).map(|n| format!("{name}_{n}"));
        let free = std::iter::once((*name).to_owned()).chain(numbered).find(|name| !names.contains(name));
        names.extend(free);
    }
    names
}

#[pymethods]
impl Run {
    /// Times, in order.
    #[getter]
    fn t<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.get().columns.column_at(slf.clone().into_any(), 0)
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
        let place = 1 + slf.get().coordinates + slf.get().speeds;
        slf.get().columns.column_at(slf.clone().into_any(), place)
    }

    /// Potential energies.
    #[getter]
    fn potential_energy<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        let place = 2 + slf.get().coordinates + slf.get().speeds;
        slf.get().columns.column_at(slf.clone().into_any(), place)
    }

    /// The names of the columns.
    #[getter]
    fn columns(&self) -> Vec<String> {
        self.columns.names().to_vec()
    }

    /// Times and states of `events`, one after the other as they were asked for: tuples t, q, z of arrays.
    #[getter]
    fn events<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        self.events_of(py, self.kinds.0..self.kinds.0 + self.kinds.1)
    }

    /// Events of `jumps`: the states before them.
    #[getter]
    fn jumps<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        self.events_of(py, 0..self.kinds.0)
    }

    /// Events at contacts, in order of time: tuples t, contact, kind ("impact", "closes", "rests", "leaves", "sticks",
    /// "slides", "reverses"), and of an impact the rates before and after it, the impulse (along the normal, then the
    /// tangents and the spin) and the energy that it took away.
    #[getter]
    fn contact_events<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let one = |Happening { time, contact, kind, impact }: &Happening| {
            let (name, rows) = &self.contacts[*contact];
            let part = |k: usize| impact.get(k * rows..(k + 1) * rows).map(|part| PyArray1::from_slice(py, part));
            let fields = (*time, name, KINDS[*kind], part(0), part(1), part(2), impact.last().copied());
            tuples::new(py, tuples::CONTACT_EVENT, fields.into_pyobject(py)?)
        };
        let events: PyResult<Vec<_>> = self.touched().happened.iter().map(one).collect();
        PyList::new(py, events?)
    }

    /// Measures of how well the laws of contact were kept, by name; empty of runs without contacts.
    #[getter]
    fn contact_report<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let report = PyDict::new(py);
        self.touched().report.iter().try_for_each(|(name, number)| report.set_item(name, number))?;
        Ok(report)
    }

    /// Spans in which open gaps were looked at by samples alone, so that a touch may have been missed: contact, from
    /// when on, until when.
    #[getter]
    fn sampled_gaps(&self) -> Vec<(String, f64, f64)> {
        self.touched().sampled.iter().map(|&(contact, from, to)| (self.contacts[contact].0.clone(), from, to)).collect()
    }

    /// The number of the end in `until` that it came to; none where it went on to its time.
    #[getter]
    fn stopped_by(&self) -> Option<usize> {
        self.outcome.stopped_by
    }

    /// Whether it was interrupted, by Ctrl-C or an exception, which has it as `run`.
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

    /// A column by its name, a state by its number.
    fn __getitem__<'py>(slf: &Bound<'py, Self>, key: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        slf.get().columns.item(slf.clone().into_any(), key)
    }

    /// States, each with its numbers by name.
    fn __iter__<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.get().columns.iterator(slf.as_any())
    }

    /// Whether it has a column of this name.
    fn __contains__(&self, name: &str) -> bool {
        self.columns.names().iter().any(|other| other == name)
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

    /// A picture by matplotlib: a panel for each argument, a column or several, in order of time; without arguments
    /// the configuration, the speeds, the energies, and of contacts the gaps and the forces. Events at contacts are
    /// grey lines. Returns the axes.
    #[pyo3(signature = (*names))]
    fn plot<'py>(slf: &Bound<'py, Self>, names: &Bound<'py, PyTuple>) -> PyResult<Bound<'py, PyAny>> {
        let py = slf.py();
        let panels: Vec<Vec<String>> = slf.get().panels().into_iter().map(|(_, panel)| panel).collect();
        let text = std::ffi::CString::new(include_str!("plot.py"))?;
        let module = PyModule::from_code(py, &text, c"gauss_python_plot.py", c"gauss_python_plot")?;
        module.getattr("plot")?.call1((slf, names, panels))
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
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let (py, Self { columns, coordinates, speeds, kinds, contacts, outcome }) = (slf.py(), slf.get());
        let Outcome { last, events, stopped_by, summary, touched, error, interrupted, .. } = outcome;
        let events: Vec<(usize, Vec<f64>)> = events.iter().map(|event| (event.number, event.row.clone())).collect();
        let touched = touched.clone().map(|Touched { happened, report, sampled }| {
            let happened =
                happened.into_iter().map(|Happening { time, contact, kind, impact }| (time, contact, kind, impact));
            (happened.collect::<Vec<_>>(), report, sampled)
        });
        let state = (
            (columns.names().to_vec(), PyArray1::from_slice(py, columns.numbers()), columns.len()),
            (*coordinates, *speeds, *kinds, contacts.clone()),
            (last.clone(), *stopped_by, error.clone(), *interrupted),
            (events, touched),
            (summary.steps, summary.rejected, summary.rounded, summary.excess, summary.jumps),
        );
        // A method of the class: pickles find it in all protocols.
        Ok((slf.get_type().getattr("_restored")?, state.into_pyobject(py)?))
    }

    /// A run from its pickle.
    #[classmethod]
    fn _restored(
        _class: &Bound<'_, PyType>,
        columns: (Vec<String>, Bound<'_, PyArray1<f64>>, usize),
        sizes: PickledSizes,
        end: (Vec<f64>, Option<usize>, Option<String>, bool),
        happened: (Vec<(usize, Vec<f64>)>, Option<PickledTouches>),
        steps: (u64, u64, u64, f64, u64),
    ) -> PyResult<Self> {
        let ((names, numbers, rows), (coordinates, speeds, kinds, contacts)) = (columns, sizes);
        let ((last, stopped_by, error, interrupted), (events, touched)) = (end, happened);
        let mut summary = Summary::default();
        (summary.steps, summary.rejected, summary.rounded, summary.excess, summary.jumps) = steps;
        let columns = Columns::new(names, numbers.readonly().to_vec()?, rows);
        let events = events.into_iter().map(|(number, row)| Event { number, row }).collect();
        let touched = touched.map(|(happened, report, sampled)| {
            let one = |(time, contact, kind, impact)| Happening { time, contact, kind, impact };
            Touched { happened: happened.into_iter().map(one).collect(), report, sampled }
        });
        let columns_of = Vec::new();
        let outcome =
            Outcome { columns: columns_of, rows, last, events, stopped_by, summary, touched, error, interrupted };
        Ok(Self { columns, coordinates, speeds, kinds, contacts, outcome })
    }
}

/// Coordinates, speeds, jumps and events, contacts, as pickles have them.
type PickledSizes = (usize, usize, (usize, usize), Vec<(String, usize)>);
/// Account of the contacts, as pickles have it.
type PickledTouches = (Vec<(f64, usize, usize, Vec<f64>)>, Vec<(String, f64)>, Vec<(usize, f64, f64)>);
