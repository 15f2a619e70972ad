//! Exceptions of the package, which are classes of its Python half, so that they pickle by their arguments.

use gauss_jit::{KernelError, Misgiven, Mistakes, Place};
use pyo3::exceptions::{PyTypeError, PyValueError};
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

/// Parameters that no body has are of their own class; those that are not the model's are as arguments of a call are.
pub fn kernel(py: Python<'_>, error: &KernelError) -> PyErr {
    match error {
        KernelError::Parameters(wrong) => {
            let list = wrong.violations().iter().map(|violation| {
                let rule = format!("{:?}", violation.rule);
                let rule = rule.split([' ', '{', '(']).next().unwrap_or_default().to_owned();
                (violation.field, violation.value, rule, violation.to_string())
            });
            raised(py, "ParameterError", (list.collect::<Vec<_>>(), wrong.to_string()))
        }
        KernelError::Given(list) if list.iter().any(|wrong| !matches!(wrong, Misgiven::Count { .. })) => {
            PyTypeError::new_err(error.to_string())
        }
        _ => PyValueError::new_err(error.to_string()),
    }
}
