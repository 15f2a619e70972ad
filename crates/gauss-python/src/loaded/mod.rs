//! Models that come at run time as classes of Python: the same class, the same methods, other kernels.
//!
//! A scene of [`gauss_jit`] stands behind the same two traits as one that was compiled, `AnyScene` and `AnyKernel`, so
//! that all else of this crate knows nothing of it. `rows` has its methods, `runs` its runs.

mod kernel;
mod rows;
mod runs;
mod scene;

use std::sync::Arc;

use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::kernels::AnyScene;
use scene::LoadedScene;

/// Adds what a module of such models has: the class of kernels, runs, ends, exceptions, tuples, `jax`.
///
/// # Errors
/// Errors of Python.
pub fn begin(module: &Bound<'_, PyModule>) -> PyResult<()> {
    crate::begin(module)?;
    crate::finish(module, Vec::new())
}

/// The attributes of a class of kernels: its scene, its documentation, its keywords.
///
/// # Errors
/// Errors of Python.
pub fn attributes<'py>(py: Python<'py>, model: &gauss_jit::Model) -> PyResult<Bound<'py, PyDict>> {
    crate::make::attributes(py, &(Arc::new(LoadedScene::new(model.clone())) as Arc<dyn AnyScene>))
}

/// An exception for parameters or arrays of tables that cannot be: of each the name, and what is wrong with it.
#[must_use]
pub fn parameter_error(py: Python<'_>, message: String, fields: Vec<(String, String)>) -> PyErr {
    crate::errors::new(py, "ParameterError", message, ("fields", fields))
}

/// The text of the stubs of a module whose classes come at run time.
#[must_use]
pub fn stubs() -> String {
    crate::stubs::text_of_loaded()
}
