//! Parameters that rows of a batch have for themselves: `kernel.acceleration(q, z, length=lengths)`.

use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::{self, shown};
use crate::description::Shape;
use crate::kernels::AnyScene;

/// A parameter with its numbers, for all rows or for each.
pub struct OwnParameter {
    /// Its name.
    pub name: &'static str,
    /// Place of its first number among those of all parameters.
    place: usize,
    /// Count of its numbers in a row.
    size: usize,
    numbers: Vec<f64>,
    leading: Vec<usize>,
}

impl OwnParameter {
    /// The parameter of a field, by its number, with numbers for each of so many rows.
    pub fn of_rows(scene: &dyn AnyScene, number: usize, numbers: Vec<f64>, rows: usize) -> Self {
        let (before, own) = scene.description().fields.split_at(number);
        let place = before.iter().map(|field| field.shape.size()).sum();
        Self { name: own[0].name, place, size: own[0].shape.size(), numbers, leading: vec![rows] }
    }

    /// The axes before its own.
    pub fn leading(&self) -> &[usize] {
        &self.leading
    }

    fn of_row(&self, row: usize) -> &[f64] {
        let first = if self.leading.is_empty() { 0 } else { row * self.size };
        &self.numbers[first..first + self.size]
    }
}

/// The keywords of a method that are none of its arguments, as parameters.
///
/// # Errors
/// Names of no parameter, or of one that is no array of numbers; arrays of other shapes.
pub fn parameters(
    scene: &dyn AnyScene,
    method: &str,
    given: Option<&Bound<'_, PyDict>>,
) -> PyResult<Vec<OwnParameter>> {
    let fields = &scene.description().fields;
    let mut all = Vec::new();
    for (name, value) in given.into_iter().flat_map(|given| given.iter()) {
        let name: String = name.extract()?;
        let found = fields.iter().position(|field| field.name == name);
        let Some((number, Shape::Array(axes))) = found.map(|number| (number, fields[number].shape)) else {
            let arrays = fields.iter().filter(|field| matches!(field.shape, Shape::Array(_)));
            let names: Vec<&str> = arrays.map(|field| field.name).collect();
            return Err(PyTypeError::new_err(format!(
                "{method} has no argument {name}, and {} no parameter of that name that rows may have for themselves: \
                 there are {}",
                scene.description().name,
                if names.is_empty() { "none".to_owned() } else { names.join(", ") }
            )));
        };
        let (numbers, shape) = arrays::numbers(&name, &value)?;
        let leading = shape.len().checked_sub(axes.len()).filter(|first| shape[*first..] == *axes);
        let Some(leading) = leading.map(|first| shape[..first].to_vec()) else {
            let own: Vec<String> = axes.iter().map(|axis| format!(", {axis}")).collect();
            let shape = shown(&shape);
            return Err(PyValueError::new_err(format!("{name} has shape {shape}; expected (...{})", own.concat())));
        };
        let place = fields[..number].iter().map(|field| field.shape.size()).sum();
        all.push(OwnParameter { name: fields[number].name, place, size: axes.iter().product(), numbers, leading });
    }
    Ok(all)
}

/// The numbers of all parameters in a row.
pub fn numbers(own: &[OwnParameter], shared: &[f64], row: usize) -> Vec<f64> {
    let mut numbers = shared.to_vec();
    for parameter in own {
        numbers[parameter.place..parameter.place + parameter.size].copy_from_slice(parameter.of_row(row));
    }
    numbers
}
