//! Kernels as documents of MuJoCo.

use gauss_jit::{Mjcf, MjcfError};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors;
use crate::waiting::interruptible;

/// The MJCF document of the struct in a text.
#[pyfunction]
pub fn mjcf(py: Python<'_>, source: String, parameters: Vec<(String, Vec<f64>)>) -> PyResult<String> {
    let made = interruptible(py, move || {
        let parameters: Vec<(&str, &[f64])> = parameters.iter().map(|(name, own)| (&name[..], &own[..])).collect();
        Mjcf::new(&source, &parameters)
    })?;
    made.map(|made| made.xml().to_owned()).map_err(|error| match error {
        MjcfError::Scene(mistakes) => errors::scene(py, &mistakes),
        other => PyValueError::new_err(other.to_string()),
    })
}
