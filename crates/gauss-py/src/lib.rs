//! The native half of the Python package `gauss`: models that are derived and compiled at run time. Their kernels are
//! those of `gauss-python`, the same class as that of compiled structs; programs beyond its methods are called by name.
//! The other half (`python/gauss`) has files, scenes in words and pickles.

mod documents;
mod errors;
mod fmu;
mod lie;
mod model;
mod programs;
mod waiting;

use pyo3::prelude::*;

/// The stubs of this module, which `_native.pyi` has.
#[pyfunction]
fn stubs() -> String {
    gauss_python::loaded::stubs()
}

#[pymodule(name = "_native")]
fn native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    gauss_python::loaded::begin(module)?;
    module.add_function(wrap_pyfunction!(stubs, module)?)?;
    module.add_function(wrap_pyfunction!(fmu::write_fmu, module)?)?;
    module.add_function(wrap_pyfunction!(documents::mjcf, module)?)?;
    module.add_function(wrap_pyfunction!(documents::urdf, module)?)?;
    module.add_function(wrap_pyfunction!(lie::exp6, module)?)?;
    module.add_function(wrap_pyfunction!(lie::log6, module)?)?;
    module.add_class::<model::Model>()?;
    module.add_class::<programs::Programs>()
}
