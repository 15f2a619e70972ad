//! The ends of many runs in Python.

use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyCapsule, PyTuple, PyType};

use crate::columns::Columns;
use crate::kernels::AnyScene;
use crate::run::names;
use crate::runs::{ManyEnds, TOUCHED};

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
    /// The ends of runs of a scene.
    pub fn new(scene: &dyn AnyScene, ends: ManyEnds, (touches, interrupted): (bool, bool)) -> Self {
        let sizes = scene.sizes();
        let ManyEnds { columns, stopped, errors, .. } = ends;
        let more: &[&str] = if touches { &["steps", TOUCHED[0], TOUCHED[1]] } else { &["steps"] };
        let columns = Columns::new(names(scene, more), columns, stopped.len());
        let errors = errors.into_iter().collect();
        Self { columns, coordinates: sizes.configuration, speeds: sizes.speeds, stopped, errors, interrupted }
    }
}

#[pymethods]
impl Ends {
    /// When each run ended.
    #[getter]
    fn t<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.get().columns.column_at(slf.clone().into_any(), 0)
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

    /// Steps that each made; NaN of those in `errors`.
    #[getter]
    fn steps<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        let place = 1 + slf.get().coordinates + slf.get().speeds;
        slf.get().columns.column_at(slf.clone().into_any(), place)
    }

    /// Whether each came to the end in `until`.
    #[getter]
    fn stopped<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<bool>> {
        PyArray1::from_slice(py, &self.stopped)
    }

    /// Runs that did not reach their end, or could not begin: pairs of a number and all that is wrong.
    #[getter]
    fn errors(&self) -> Vec<(usize, String)> {
        self.errors.clone()
    }

    /// Whether they were interrupted, by Ctrl-C or an exception, which has them as `ends`.
    #[getter]
    fn interrupted(&self) -> bool {
        self.interrupted
    }

    /// The names of the columns.
    #[getter]
    fn columns(&self) -> Vec<String> {
        self.columns.names().to_vec()
    }

    /// A column by its name, a run by its number.
    fn __getitem__<'py>(slf: &Bound<'py, Self>, key: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        slf.get().columns.item(slf.clone().into_any(), key)
    }

    /// Runs, each with the numbers of its end by name.
    fn __iter__<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.get().columns.iterator(slf.as_any())
    }

    /// Whether they have a column of this name.
    fn __contains__(&self, name: &str) -> bool {
        self.columns.names().iter().any(|other| other == name)
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

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let (py, Self { columns, coordinates, speeds, stopped, errors, interrupted }) = (slf.py(), slf.get());
        let state = (
            (columns.names().to_vec(), PyArray1::from_slice(py, columns.numbers())),
            (*coordinates, *speeds),
            PyArray1::from_slice(py, stopped),
            errors.clone(),
            *interrupted,
        );
        Ok((slf.get_type().getattr("_restored")?, state.into_pyobject(py)?))
    }

    /// Ends from their pickle.
    #[classmethod]
    fn _restored(
        _class: &Bound<'_, PyType>,
        columns: (Vec<String>, Bound<'_, PyArray1<f64>>),
        sizes: (usize, usize),
        stopped: Bound<'_, PyArray1<bool>>,
        errors: Vec<(usize, String)>,
        interrupted: bool,
    ) -> PyResult<Self> {
        let ((names, numbers), (coordinates, speeds)) = (columns, sizes);
        let stopped = stopped.readonly().to_vec()?;
        let columns = Columns::new(names, numbers.readonly().to_vec()?, stopped.len());
        Ok(Self { columns, coordinates, speeds, stopped, errors, interrupted })
    }
}
