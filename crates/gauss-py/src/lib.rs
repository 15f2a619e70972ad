//! The native half of the Python package `gauss`: models that are derived and compiled at run time, and loops over rows
//! of numbers. The other half (`python/gauss`) has arrays of any shape, exceptions and pickles.

mod errors;
mod kernel;
mod model;

use pyo3::prelude::*;

#[pymodule(name = "_native")]
fn native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<model::Model>()?;
    module.add_class::<kernel::Kernel>()
}
