//! Exceptions of the package, which are classes of its Python half, so that they pickle by their arguments.

use gauss_jit::{KernelError, Mistakes, Place, TableMistakes};
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

/// Mistakes of arrays of tables, as those of parameters: each with the name of its constant, and all in one message.
pub fn tables(py: Python<'_>, model: &str, mistakes: &TableMistakes) -> PyErr {
    let fields: Vec<(String, String)> =
        mistakes.as_slice().iter().map(|mistake| (mistake.name().to_owned(), mistake.to_string())).collect();
    error(py, model, fields)
}

/// Parameters of a row, or of all, that no body has.
pub fn parameters(py: Python<'_>, model: &str, row: Option<usize>, why: &KernelError) -> PyErr {
    let place = row.map_or_else(String::new, |row| format!(", in row {row}"));
    let fields = match why {
        KernelError::Parameters(own) => {
            own.violations().iter().map(|one| (one.field.to_owned(), format!("{one}{place}"))).collect()
        }
        other => vec![(model.to_owned(), format!("{other}{place}"))],
    };
    error(py, model, fields)
}

fn error(py: Python<'_>, model: &str, fields: Vec<(String, String)>) -> PyErr {
    let lines: String = fields.iter().map(|(_, why)| format!("\n  {why}")).collect();
    gauss_python::loaded::parameter_error(py, format!("{model}:{lines}"), fields)
}
