//! Keywords of Python as the parameters of a struct, and back.

use std::sync::Arc;

use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::{self, shown};
use crate::description::{Field, Shape};
use crate::errors;
use crate::kernels::{AnyKernel, AnyScene, Violation};
use crate::steps::{off_group, off_group_words};

/// Mistakes in fields: the name of each, and why it is one.
pub type Mistakes = Vec<(String, String)>;

/// The parts of a body, with their numbers.
const BODY: [(&str, &[usize]); 3] = [("mass", &[]), ("center_of_mass", &[3]), ("inertia", &[3, 3])];

/// The kernel with these parameters.
pub fn kernel(
    py: Python<'_>,
    scene: &Arc<dyn AnyScene>,
    given: Option<&Bound<'_, PyDict>>,
) -> PyResult<Box<dyn AnyKernel>> {
    let (mut mistakes, mut numbers, mut violations) = (Mistakes::new(), Vec::new(), Vec::new());
    let fields = &scene.description().fields;
    for field in fields {
        match given.map(|given| given.get_item(field.name)).transpose()?.flatten() {
            Some(value) => read(field, &value, &mut numbers, &mut mistakes),
            None => mistakes.push((field.name.to_owned(), format!("is missing{}", described(field)))),
        }
    }
    for name in given.into_iter().flat_map(|given| given.keys()) {
        let name: String = name.extract()?;
        if fields.iter().all(|field| field.name != name) {
            let names: Vec<&str> = fields.iter().map(|field| field.name).collect();
            mistakes.push((name, format!("is no parameter; there are {}", names.join(", "))));
        }
    }
    if mistakes.is_empty() {
        match Arc::clone(scene).kernel(numbers) {
            Ok(kernel) => return Ok(kernel),
            Err(all) => violations = all,
        }
        mistakes.extend(violations.iter().map(|violation| (violation.field.clone(), violation.message.clone())));
    }
    Err(raised(py, &**scene, mistakes, violations))
}

/// The exception for mistakes in fields, and for numbers that break rules.
pub fn raised(py: Python<'_>, scene: &dyn AnyScene, mistakes: Mistakes, violations: Vec<Violation>) -> PyErr {
    let lines = mistakes.iter().map(|(name, why)| match why.starts_with(name.as_str()) || why.starts_with('`') {
        true => format!("\n  {why}"),
        false => format!("\n  {name} {why}"),
    });
    let message = format!("{}:{}", scene.description().name, lines.collect::<Vec<_>>().concat());
    let error = errors::new(py, "ParameterError", message, ("fields", mistakes));
    let all: Vec<_> =
        violations.into_iter().map(|Violation { field, value, rule, message }| (field, value, rule, message)).collect();
    match error.value(py).setattr("violations", all) {
        Ok(()) => error,
        Err(other) => other,
    }
}

/// ` (kg): of the hull`.
pub fn described(field: &Field) -> String {
    let unit = if field.unit.is_empty() { String::new() } else { format!(" ({})", field.unit) };
    let first = field.documentation.lines().next().unwrap_or_default();
    if first.is_empty() { unit } else { format!("{unit}: {first}") }
}

/// Reads one field; what is wrong is noted, zeros then stand for it.
fn read(field: &Field, value: &Bound<'_, PyAny>, numbers: &mut Vec<f64>, mistakes: &mut Mistakes) {
    let next = numbers.len() + field.shape.size();
    let read = match field.shape {
        Shape::Array(axes) => array(field.name, value, axes).map(|array| numbers.extend(array)),
        Shape::Rotation => array(field.name, value, &[4]).and_then(|array| {
            numbers.extend(&array);
            rotation(&array)
        }),
        Shape::Body => body(field.name, value).map(|body| numbers.extend(body)),
    };
    if let Err(why) = read {
        mistakes.push((field.name.to_owned(), why));
    }
    numbers.resize(next, 0.0);
}

fn array(name: &str, value: &Bound<'_, PyAny>, axes: &[usize]) -> Result<Vec<f64>, String> {
    let (numbers, found) = arrays::numbers(name, value).map_err(|error| error.value(value.py()).to_string())?;
    if found == axes {
        return Ok(numbers);
    }
    let expected = if axes.is_empty() { "one number".to_owned() } else { format!("shape {}", shown(axes)) };
    Err(format!("has shape {}; expected {expected}", shown(&found)))
}

/// Checks that the components of a quaternion are those of a rotation.
fn rotation(numbers: &[f64]) -> Result<(), String> {
    let squares = numbers.iter().map(|number| number * number).sum();
    if off_group(squares) { Err(format!("is no rotation: {}", off_group_words(squares))) } else { Ok(()) }
}

/// Mass, centre of mass and inertia of a mapping; the centre of mass is O where it is left out, and three numbers are
/// principal moments.
fn body(name: &str, value: &Bound<'_, PyAny>) -> Result<Vec<f64>, String> {
    let expected = "is a mapping with mass, center_of_mass and inertia";
    let Ok(parts) = value.cast::<PyDict>() else { return Err(expected.to_owned()) };
    if let Some(other) = parts.keys().iter().find(|key| BODY.iter().all(|(part, _)| !key.eq(part).unwrap_or(false))) {
        return Err(format!("has {other}, and {expected}"));
    }
    let mut numbers = Vec::new();
    for (part, axes) in BODY {
        let word = format!("{name}.{part}");
        match (part, parts.get_item(part).ok().flatten()) {
            ("center_of_mass", None) => numbers.extend([0.0; 3]),
            (_, None) => return Err(format!("has no {part}, and {expected}")),
            ("inertia", Some(value)) => match array(&word, &value, &[3]) {
                Ok(moments) => numbers.extend((0..9).map(|k| if k % 4 == 0 { moments[k / 4] } else { 0.0 })),
                Err(_) => numbers.extend(array(&word, &value, axes).map_err(|why| format!("{part} {why}"))?),
            },
            (_, Some(value)) => numbers.extend(array(&word, &value, axes).map_err(|why| format!("{part} {why}"))?),
        }
    }
    Ok(numbers)
}

/// The parameters of a kernel by name: numbers as floats, others as arrays.
pub fn as_dict<'py>(py: Python<'py>, kernel: &dyn AnyKernel) -> PyResult<Bound<'py, PyDict>> {
    let (parameters, mut rest) = (PyDict::new(py), kernel.numbers());
    for field in &kernel.scene().description().fields {
        let (own, others) = rest.split_at(field.shape.size());
        rest = others;
        match field.shape {
            Shape::Array(axes) => parameters.set_item(field.name, value(py, own, axes)?)?,
            Shape::Rotation => parameters.set_item(field.name, value(py, own, &[4])?)?,
            Shape::Body => {
                let (body, mut own) = (PyDict::new(py), own);
                for (part, axes) in BODY {
                    let (numbers, others) = own.split_at(axes.iter().product());
                    body.set_item(part, value(py, numbers, axes)?)?;
                    own = others;
                }
                parameters.set_item(field.name, body)?;
            }
        }
    }
    Ok(parameters)
}

fn value<'py>(py: Python<'py>, numbers: &[f64], axes: &[usize]) -> PyResult<Bound<'py, PyAny>> {
    match (axes, numbers) {
        ([], [number]) => Ok(number.into_pyobject(py)?.into_any()),
        _ => numpy::PyArray1::from_slice(py, numbers).call_method1("reshape", (axes.to_vec(),)),
    }
}

#[cfg(test)]
mod tests {
    use super::rotation;

    #[test]
    fn quaternions_have_norm_1() {
        assert_eq!(rotation(&[0.6, 0.0, 0.8, 0.0]), Ok(()));
        // Nine digits of a file.
        assert_eq!(rotation(&[0.547722558, 0.0, 0.836660027, 0.0]), Ok(()));
        for wrong in [[0.0; 4], [0.6, 0.0, 0.8, 1e-3], [f64::NAN, 0.0, 0.0, 1.0], [1e200, 0.0, 0.0, 0.0]] {
            let told = rotation(&wrong).expect_err("none");
            assert!(told.starts_with("is no rotation: squares of its numbers add up to "), "{told}");
        }
    }
}
