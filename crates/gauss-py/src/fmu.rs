//! Kernels as FMUs for other tools.

use gauss_fmu::{Fmu, FmuError, Version};
use pyo3::exceptions::{PyOSError, PyValueError};
use pyo3::prelude::*;

use crate::errors;
use crate::waiting::interruptible;

/// Writes the FMU of the struct in a text; the platform that it has a binary for, `None` where there is no C compiler.
/// After Ctrl-C the file may still come: it is written by the thread that derives.
#[pyfunction]
pub fn write_fmu(
    py: Python<'_>,
    source: String,
    parameters: Vec<(String, Vec<f64>)>,
    start: Vec<(String, f64)>,
    version: u8,
    path: String,
) -> PyResult<Option<&'static str>> {
    let version = match version {
        2 => Version::Two,
        3 => Version::Three,
        other => return Err(PyValueError::new_err(format!("fmi is {other}; there are the versions 2 and 3"))),
    };
    let file = path.clone();
    let written = interruptible(py, move || {
        let parameters: Vec<(&str, &[f64])> = parameters.iter().map(|(name, own)| (&name[..], &own[..])).collect();
        let start: Vec<(&str, f64)> = start.iter().map(|(name, value)| (&name[..], *value)).collect();
        Fmu::new(&source, &parameters)?.start(&start).map(|fmu| fmu.version(version))?.write(file)
    })?;
    written.map(|written| written.platform).map_err(|error| match error {
        FmuError::Scene(mistakes) => errors::scene(py, &mistakes),
        FmuError::Io(error) => PyOSError::new_err(format!("{path}: {error}")),
        other => PyValueError::new_err(other.to_string()),
    })
}
