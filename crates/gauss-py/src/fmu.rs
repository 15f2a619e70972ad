//! Kernels as FMUs for other tools.

use gauss_fmu::{Fmu, FmuError, Version};
use pyo3::exceptions::{PyOSError, PyValueError};
use pyo3::prelude::*;

use crate::errors;

/// Writes the FMU of the struct in a text; the platform that it has a binary for, `None` where there is no C compiler.
#[pyfunction]
pub fn write_fmu(
    py: Python<'_>,
    source: &str,
    parameters: Vec<(String, Vec<f64>)>,
    start: Vec<(String, f64)>,
    version: u8,
    path: &str,
) -> PyResult<Option<&'static str>> {
    let version = match version {
        2 => Version::Two,
        3 => Version::Three,
        other => return Err(PyValueError::new_err(format!("fmi is {other}; there are the versions 2 and 3"))),
    };
    let parameters: Vec<(&str, &[f64])> = parameters.iter().map(|(name, own)| (&name[..], &own[..])).collect();
    let start: Vec<(&str, f64)> = start.iter().map(|(name, value)| (&name[..], *value)).collect();
    let written =
        py.detach(|| Fmu::new(source, &parameters)?.start(&start).map(|fmu| fmu.version(version))?.write(path));
    written.map(|written| written.platform).map_err(|error| match error {
        FmuError::Scene(mistakes) => errors::scene(py, &mistakes),
        FmuError::Io(error) => PyOSError::new_err(format!("{path}: {error}")),
        other => PyValueError::new_err(other.to_string()),
    })
}
