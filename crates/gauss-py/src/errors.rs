//! Exceptions of the package, which are classes of its Python half, so that they pickle by their arguments.

use gauss_jit::{Mistakes, Place};
use pyo3::prelude::*;

/// An exception of `gauss._errors` with its arguments.
fn raised<'py>(py: Python<'py>, class: &str, arguments: impl pyo3::call::PyCallArgs<'py>) -> PyErr {
    let made = py.import("gauss._errors").and_then(|module| module.getattr(class)?.call1(arguments));
    made.map_or_else(|other| other, PyErr::from_value)
}

/// Mistakes of a scene, each with line, column and message, and the text that they are in.
pub fn scene(py: Python<'_>, mistakes: &Mistakes) -> PyErr {
    let list = mistakes.as_slice().iter().map(|mistake| match &mistake.place {
        Place::Text { line, column } => (*line, *column, mistake.message.clone()),
        // Of the whole.
        _ => (1, 1, mistake.to_string()),
    });
    raised(py, "SceneError", (list.collect::<Vec<_>>(), mistakes.source()))
}
