//! Results by their names: classes of tuples, which the package has, so that pickles find them.

use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyDict, PyTuple};

use crate::methods::SPECS;

/// The class of the times and states of an event.
pub const EVENTS: &str = "Events";

/// The class of a change of a contact.
pub const CONTACT_EVENT: &str = "ContactEvent";

/// The class of what contacts do at a state.
pub const IN_CONTACT: &str = "InContact";

static CLASSES: PyOnceLock<Py<PyDict>> = PyOnceLock::new();

/// The names of all classes.
pub fn names() -> impl Iterator<Item = String> {
    all().map(|(name, _)| name)
}

/// All classes with their fields: of each method that gives several results, and of what happens in runs.
fn all() -> impl Iterator<Item = (String, Vec<&'static str>)> {
    let several = SPECS.iter().filter(|spec| spec.results.len() > 1);
    let of_methods = several.map(|spec| (spec.class_name(), spec.results.iter().map(|result| result.name).collect()));
    let others = [
        (EVENTS, vec!["t", "q", "z"]),
        (CONTACT_EVENT, vec!["t", "contact", "kind", "before", "after", "impulse", "energy_lost"]),
        (IN_CONTACT, vec!["acceleration", "modes", "forces"]),
    ];
    of_methods.chain(others.map(|(name, fields)| (name.to_owned(), fields)))
}

/// Adds them to the package.
pub fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let py = module.py();
    let make = py.import("collections")?.getattr("namedtuple")?;
    let named = PyDict::new(py);
    named.set_item("module", module.name()?)?;
    let classes = PyDict::new(py);
    for (name, fields) in all() {
        let class = make.call((&name, fields), Some(&named))?;
        classes.set_item(&name, &class)?;
        module.add(name.as_str(), class)?;
    }
    CLASSES.get_or_init(py, || classes.unbind());
    Ok(())
}

/// The class of that name.
pub fn class<'py>(py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
    let class = CLASSES.get(py).map(|classes| classes.bind(py).get_item(name)).transpose()?.flatten();
    class.ok_or_else(|| pyo3::exceptions::PyRuntimeError::new_err(format!("the package has no {name}")))
}

/// A tuple of a class.
pub fn new<'py>(py: Python<'py>, name: &str, fields: Bound<'py, PyTuple>) -> PyResult<Bound<'py, PyAny>> {
    class(py, name)?.call1(fields)
}
