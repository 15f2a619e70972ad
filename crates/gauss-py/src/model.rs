//! A model: a scene with its equations.

use gauss_jit::targets::casadi;
use gauss_jit::{Array, Cache, Notation};
use numpy::{PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::errors;
use crate::programs::Programs;
use crate::waiting::interruptible;

/// A scene with its equations, and the programs that compute them.
#[pyclass(frozen, module = "gauss._native")]
pub struct Model {
    model: gauss_jit::Model,
}

/// The name that Python has for a program: inverse dynamics is a residual to the equations.
fn shown(program: &str) -> String {
    if program == "gauss_residual" { "inverse_dynamics" } else { program }.to_owned()
}

type Signature = (Vec<(String, Vec<String>)>, Vec<(String, usize, usize)>);

#[pymethods]
impl Model {
    /// The model of the struct in a text.
    #[staticmethod]
    fn of_text(py: Python<'_>, source: String) -> PyResult<Self> {
        let derived = interruptible(py, move || match Cache::of_user() {
            Some(cache) => cache.from_source(&source),
            None => gauss_jit::Model::from_source(&source),
        })?;
        derived.map(|model| Self { model }).map_err(|mistakes| errors::scene(py, &mistakes))
    }

    /// The model of a robot's file. `lasts`: whether the file will be there another time.
    #[staticmethod]
    #[pyo3(signature = (format, path, clauses, lasts=true))]
    fn of_file(py: Python<'_>, format: &str, path: String, clauses: Vec<String>, lasts: bool) -> PyResult<Self> {
        let is_urdf = match format {
            "urdf" => true,
            "mjcf" => false,
            _ => return Err(PyValueError::new_err(format!("`{format}` is neither urdf nor mjcf"))),
        };
        let derived = interruptible(py, move || {
            let clauses: Vec<&str> = clauses.iter().map(String::as_str).collect();
            match (is_urdf, Cache::of_user().filter(|_| lasts)) {
                (true, Some(cache)) => cache.from_urdf(&path, &clauses),
                (false, Some(cache)) => cache.from_mjcf(&path, &clauses),
                (true, None) => gauss_jit::Model::from_urdf(&path, &clauses),
                (false, None) => gauss_jit::Model::from_mjcf(&path, &clauses),
            }
        })?;
        derived.map(|model| Self { model }).map_err(|mistakes| errors::scene(py, &mistakes))
    }

    /// The same model with the numbers of its tables: arrays in C order by the names of their constants.
    fn with_tables(&self, py: Python<'_>, arrays: Vec<(String, PyReadonlyArrayDyn<'_, f64>)>) -> PyResult<Self> {
        let own = arrays.iter().map(|(name, array)| Ok((name.as_str(), array.shape(), array.as_slice()?)));
        let own: Vec<Array<'_>> = own.collect::<PyResult<_>>()?;
        let made = self.model.with_tables(&own);
        made.map(|model| Self { model }).map_err(|mistakes| errors::tables(py, self.model.name(), &mistakes))
    }

    #[getter]
    fn name(&self) -> &str {
        self.model.name()
    }

    #[getter]
    fn equations(&self) -> &str {
        self.model.equations(Notation::Text)
    }

    #[getter]
    fn latex(&self) -> &str {
        self.model.equations(Notation::Latex)
    }

    #[getter]
    fn remarks(&self) -> Vec<String> {
        self.model.remarks().to_vec()
    }

    /// The names of contacts, ranges and dry joints.
    #[getter]
    fn contacts(&self) -> Vec<&str> {
        self.model.description().contacts.iter().map(|contact| contact.name.as_str()).collect()
    }

    #[getter]
    fn files(&self) -> Vec<String> {
        self.model.files().to_vec()
    }

    /// Name, count of numbers, unit, documentation of each.
    #[getter]
    fn parameters(&self) -> Vec<(String, usize, Option<String>, String)> {
        let list = self.model.parameters().iter();
        list.map(|own| (own.name.clone(), own.count, own.unit.clone(), own.documentation.clone())).collect()
    }

    /// The axes of each parameter by its name: none of a number.
    #[getter]
    fn axes(&self) -> Vec<(String, Vec<usize>)> {
        self.model.parameters().iter().map(|own| (own.name.clone(), own.axes.clone())).collect()
    }

    #[getter]
    fn methods(&self) -> Vec<String> {
        self.model.methods().map(shown).collect()
    }

    /// Additions, multiplications, divisions, roots and transcendental functions of each method.
    #[getter]
    fn operations(&self) -> Vec<(String, [u32; 5])> {
        let counts = self.model.operations().map(|(name, of)| {
            (shown(name), [of.additions, of.multiplications, of.divisions, of.roots, of.transcendentals])
        });
        counts.collect()
    }

    #[getter]
    fn accuracy(&self) -> Vec<(String, [f64; 2])> {
        self.model.accuracy().iter().map(|(name, lost)| (shown(name), *lost)).collect()
    }

    /// Arguments of a method with the names of their numbers, time first; its results with rows and columns.
    fn signature(&self, method: &str) -> PyResult<Signature> {
        let unknown = |error: gauss_jit::CallError| PyValueError::new_err(error.to_string());
        let arguments = self.model.arguments(method).map_err(unknown)?.iter();
        let results = self.model.results(method).map_err(unknown)?.iter();
        Ok((
            arguments.map(|own| (own.name.clone(), own.components.clone())).collect(),
            results.map(|own| (own.name.clone(), own.rows, own.columns)).collect(),
        ))
    }

    /// The source in C for CasADi of these methods, or of all where none is named.
    fn casadi(&self, py: Python<'_>, methods: Vec<String>) -> PyResult<String> {
        let own = |name: String| if name == "inverse_dynamics" { "gauss_residual".to_owned() } else { name };
        let methods: Vec<String> = methods.into_iter().map(own).collect();
        let functions = self.model.functions().only(&methods).map_err(|mut error| {
            error.known = error.known.iter().map(|name| shown(name)).collect();
            PyValueError::new_err(error.to_string())
        })?;
        py.detach(|| casadi::source(&functions)).map_err(|error| PyValueError::new_err(error.to_string()))
    }

    /// The attributes of the class of its kernels.
    fn attributes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        gauss_python::loaded::attributes(py, &self.model)
    }

    /// The programs with numbers of the parameters by name, which a kernel of the class has checked.
    fn programs(&self, py: Python<'_>, parameters: Vec<(String, Vec<f64>)>) -> PyResult<Programs> {
        let list: Vec<(&str, &[f64])> = parameters.iter().map(|(name, own)| (&name[..], &own[..])).collect();
        let made = py.detach(|| self.model.kernel(&list)).map_err(|error| PyValueError::new_err(error.to_string()));
        made.map(|kernel| Programs::new(kernel, parameters))
    }
}
