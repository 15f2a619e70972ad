//! Kernels as documents for MuJoCo and as URDF.

use gauss_jit::{DocumentError, Mjcf, Urdf};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors;
use crate::waiting::interruptible;

/// The text of a document.
type DocumentText = Result<String, DocumentError>;

/// A document of the struct in a text.
fn document(
    py: Python<'_>,
    (source, parameters): (String, Vec<(String, Vec<f64>)>),
    of: impl Fn(&str, &[(&str, &[f64])]) -> DocumentText + Send + 'static,
) -> PyResult<String> {
    let made = interruptible(py, move || {
        let parameters: Vec<(&str, &[f64])> = parameters.iter().map(|(name, own)| (&name[..], &own[..])).collect();
        of(&source, &parameters)
    })?;
    made.map_err(|error| match error {
        DocumentError::Scene(mistakes) => errors::scene(py, &mistakes),
        other => PyValueError::new_err(other.to_string()),
    })
}

/// The MJCF document of the struct in a text.
#[pyfunction]
pub fn mjcf(py: Python<'_>, source: String, parameters: Vec<(String, Vec<f64>)>) -> PyResult<String> {
    document(py, (source, parameters), |source, own| Mjcf::new(source, own).map(|made| made.xml().to_owned()))
}

/// The URDF document of the struct in a text.
#[pyfunction]
pub fn urdf(py: Python<'_>, source: String, parameters: Vec<(String, Vec<f64>)>) -> PyResult<String> {
    document(py, (source, parameters), |source, own| Urdf::new(source, own).map(|made| made.xml().to_owned()))
}
