//! Exceptions: one class of each for all packages, in the module `gauss_python`, which the first of them makes.

use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyDict, PyTuple};

/// The module of the exceptions.
const MODULE: &str = "gauss_python";

/// The classes of exceptions.
pub const NAMES: [&str; 3] = ["ParameterError", "IntegrationError", "ContactError"];

/// The package that this library is.
static PACKAGE: PyOnceLock<String> = PyOnceLock::new();

/// Names the package, before anything is raised.
pub fn set_package(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let name = module.name()?.to_string();
    PACKAGE.get_or_init(module.py(), || name);
    Ok(())
}

/// The package that this library is.
pub fn package(py: Python<'_>) -> &str {
    PACKAGE.get(py).map_or(MODULE, String::as_str)
}

/// A class of exceptions.
pub fn class<'py>(py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
    let all = py.import("sys")?.getattr("modules")?.cast_into::<PyDict>()?;
    match all.get_item(MODULE)? {
        Some(module) => module.getattr(name),
        // It is then in `sys.modules`.
        None => {
            let text = std::ffi::CString::new(include_str!("errors.py"))?;
            PyModule::from_code(py, &text, c"gauss_python.py", c"gauss_python")?.getattr(name)
        }
    }
}

/// An exception with its message and one thing more.
pub fn new<'py>(py: Python<'py>, name: &str, message: String, more: (&str, impl IntoPyObject<'py>)) -> PyErr {
    let made = || {
        let error = class(py, name)?.call1((message,))?;
        error.setattr("package", package(py))?;
        error.setattr(more.0, more.1)?;
        Ok(PyErr::from_value(error))
    };
    made().unwrap_or_else(|other: PyErr| other)
}

/// An exception from its pickle.
#[pyfunction]
#[pyo3(name = "_raised")]
pub fn raised<'py>(
    py: Python<'py>,
    name: &str,
    arguments: &Bound<'py, PyTuple>,
    attributes: &Bound<'py, PyDict>,
) -> PyResult<Bound<'py, PyAny>> {
    let error = class(py, name)?.call1(arguments)?;
    attributes.iter().try_for_each(|(name, value)| error.setattr(name.cast::<pyo3::types::PyString>()?, value))?;
    Ok(error)
}
