//! Classes of a module: one for each struct, with its documentation and keywords.

use std::sync::Arc;

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyCFunction, PyDict, PyList, PyTuple, PyType};

use crate::class::{Kernel, SceneHandle};
use crate::description::Description;
use crate::documentation::documentation;
use crate::ends::Ends;
use crate::kernels::{AnyScene, Registered};
use crate::run::Run;
use crate::scene::Scene;
use crate::stepping::Stepper;
use crate::{errors, jax, stubs, tuples};

/// Adds what all modules have: [`finish`] comes after the last class.
pub fn begin(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let py = module.py();
    errors::set_package(module)?;
    let runs = [py.get_type::<Run>(), py.get_type::<Stepper>(), py.get_type::<Ends>()];
    for class in [py.get_type::<Kernel>()].into_iter().chain(runs) {
        // Pickles look for it where it can be imported from.
        class.setattr("__module__", module.name()?)?;
        module.add(class.name()?, class)?;
    }
    for name in errors::NAMES {
        module.add(name, errors::class(py, name)?)?;
    }
    module.add_function(wrap_pyfunction!(errors::raised, module)?)?;
    tuples::add(module)
}

/// Adds the class of a struct.
pub fn add<S: Scene>(module: &Bound<'_, PyModule>) -> PyResult<Arc<dyn AnyScene>> {
    let py = module.py();
    let scene: Arc<dyn AnyScene> = Arc::new(Registered::<S>::new());
    let (name, attributes) = (scene.description().name, attributes(py, &scene)?);
    attributes.set_item("__module__", module.name()?)?;
    attributes.set_item("__slots__", PyTuple::empty(py))?;
    let bases = (py.get_type::<Kernel>(),);
    let class = py.get_type::<PyType>().call1((name, bases, attributes))?;
    module.add(name, class)?;
    Ok(scene)
}

/// The attributes of the class of a scene: the scene, its documentation, its keywords.
pub fn attributes<'py>(py: Python<'py>, scene: &Arc<dyn AnyScene>) -> PyResult<Bound<'py, PyDict>> {
    let (description, attributes) = (scene.description(), PyDict::new(py));
    attributes.set_item("_scene", Py::new(py, SceneHandle::new(Arc::clone(scene)))?)?;
    attributes.set_item("__qualname__", description.name)?;
    attributes.set_item("__doc__", documentation(&**scene))?;
    attributes.set_item("__signature__", signature(py, description)?)?;
    Ok(attributes)
}

/// Adds `stubs()`, the text of the module's `.pyi`, and `__all__`.
pub fn finish(module: &Bound<'_, PyModule>, scenes: Vec<Arc<dyn AnyScene>>) -> PyResult<()> {
    let py = module.py();
    let names = ["Kernel", "Run", "Stepper", "Ends", "jax", "stubs"].into_iter().chain(errors::NAMES);
    let names = names.map(str::to_owned).chain(tuples::names());
    let all = names.chain(scenes.iter().map(|scene| scene.description().name.to_owned()));
    module.add("__all__", PyList::new(py, all.collect::<Vec<_>>())?)?;
    let stubs = move |_: &Bound<'_, PyTuple>, _: Option<&Bound<'_, PyDict>>| stubs::text(&scenes);
    let function = PyCFunction::new_closure(py, Some(c"stubs"), Some(c"The text of the stubs of this module."), stubs)?;
    module.add("stubs", function)?;
    let name = module.name()?.to_string();
    let functions = move |given: &Bound<'_, PyTuple>, named: Option<&Bound<'_, PyDict>>| match (
        given.len(),
        named.is_none_or(PyDictMethods::is_empty),
    ) {
        (1, true) => jax::functions(&name, &given.get_item(0)?).map(Bound::unbind),
        _ => Err(PyTypeError::new_err("jax(kernel) takes a kernel, and nothing else")),
    };
    let words = c"The methods of a kernel as functions of JAX: jit, vmap, jvp, grad.";
    module.add("jax", PyCFunction::new_closure(py, Some(c"jax"), Some(words), functions)?)
}

/// Keywords only, as `inspect.signature` and editors show them.
fn signature<'py>(py: Python<'py>, description: &Description) -> PyResult<Bound<'py, PyAny>> {
    let inspect = py.import("inspect")?;
    let parameter = inspect.getattr("Parameter")?;
    let keyword = parameter.getattr("KEYWORD_ONLY")?;
    let fields = description.fields.iter().map(|field| parameter.call1((field.name, &keyword)));
    inspect.getattr("Signature")?.call1((PyList::new(py, fields.collect::<PyResult<Vec<_>>>()?)?,))
}
