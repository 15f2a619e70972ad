//! Columns of numbers: views for NumPy and a stream for Arrow, none of which copies.

use std::collections::HashMap;
use std::sync::Arc;

use arrow_array::ffi_stream::FFI_ArrowArrayStream;
use arrow_array::{ArrayRef, Float64Array, RecordBatch, RecordBatchIterator};
use arrow_buffer::{Buffer, ScalarBuffer};
use arrow_schema::{ArrowError, DataType, Field, Schema};
use numpy::ndarray::{ArrayView2, ShapeBuilder};
use numpy::{PyArray2, PyArrayMethods};
use pyo3::exceptions::{PyIndexError, PyKeyError, PyRuntimeError, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::{PyCapsule, PyDict, PyRange};

/// Named columns of one length, one after the other in memory that is never written again.
pub struct Columns {
    names: Vec<String>,
    numbers: ScalarBuffer<f64>,
    rows: usize,
}

impl Columns {
    /// From numbers, column by column.
    pub fn new(names: Vec<String>, numbers: Vec<f64>, rows: usize) -> Self {
        let length = names.len() * rows;
        Self { numbers: ScalarBuffer::new(Buffer::from_vec(numbers), 0, length), names, rows }
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.rows
    }

    /// All numbers, column by column.
    pub fn numbers(&self) -> &[f64] {
        &self.numbers
    }

    /// The names.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Some columns side by side as an array that cannot be written; `owner` has these columns.
    pub fn view<'py>(&self, owner: Bound<'py, PyAny>, first: usize, count: usize) -> Bound<'py, PyArray2<f64>> {
        let numbers = &self.numbers[first * self.rows..(first + count) * self.rows];
        let shape = (self.rows, count).f();
        // As many numbers as the shape has: the slice was cut for it.
        let view = ArrayView2::from_shape(shape, numbers).unwrap_or_else(|_| ArrayView2::from(&[[0.0; 0]; 0]));
        // SAFETY: `owner` keeps the memory as long as the array lives.
        #[allow(unsafe_code)]
        let array = unsafe { PyArray2::borrow_from_array(&view, owner) };
        array.readwrite().make_nonwriteable();
        array
    }

    /// One column by its place.
    pub fn column_at<'py>(&self, owner: Bound<'py, PyAny>, place: usize) -> PyResult<Bound<'py, PyAny>> {
        self.view(owner, place, 1).call_method0("ravel")
    }

    /// One column.
    fn column<'py>(&self, owner: Bound<'py, PyAny>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        match self.names.iter().position(|other| other == name) {
            Some(place) => self.column_at(owner, place),
            None => Err(PyKeyError::new_err(format!("no column {name}; there are {}", self.names.join(", ")))),
        }
    }

    /// A column by its name, a row by its number: one from the end where that is negative.
    pub fn item<'py>(&self, owner: Bound<'py, PyAny>, key: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        if let Ok(name) = key.extract::<&str>() {
            return self.column(owner, name);
        }
        let Ok(number) = key.extract::<isize>() else {
            return Err(PyTypeError::new_err("columns are asked for by a name, rows by a number"));
        };
        let row = if number < 0 { number.checked_add_unsigned(self.rows) } else { Some(number) };
        let row = row.and_then(|row| usize::try_from(row).ok()).filter(|row| *row < self.rows);
        match row {
            Some(row) => self.row(key.py(), row).map(Bound::into_any),
            None => Err(PyIndexError::new_err(format!("there is no row {number}; there are {}", self.rows))),
        }
    }

    /// A row by the names of its numbers.
    fn row<'py>(&self, py: Python<'py>, row: usize) -> PyResult<Bound<'py, PyDict>> {
        let named = PyDict::new(py);
        for (k, name) in self.names.iter().enumerate() {
            named.set_item(name, self.numbers[k * self.rows + row])?;
        }
        Ok(named)
    }

    /// All rows, one after the other, by the numbers of `owner`.
    pub fn iterator<'py>(&self, owner: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let py = owner.py();
        let numbers = PyRange::new(py, 0, self.rows as isize)?;
        py.import("builtins")?.getattr("map")?.call1((owner.getattr("__getitem__")?, numbers))
    }

    /// The columns as a stream of one record batch: a capsule named `arrow_array_stream`.
    pub fn stream<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyCapsule>> {
        let batch = self.batch().map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
        let schema = batch.schema();
        let batches = RecordBatchIterator::new([Ok(batch)], schema);
        PyCapsule::new_with_value(py, FFI_ArrowArrayStream::new(Box::new(batches)), c"arrow_array_stream")
    }

    fn batch(&self) -> Result<RecordBatch, ArrowError> {
        let fields = self.names.iter().map(|name| {
            let unit = (name == "t").then(|| ("unit".to_owned(), "s".to_owned()));
            Field::new(name, DataType::Float64, false).with_metadata(HashMap::from_iter(unit))
        });
        let fields: Vec<Field> = fields.collect();
        let column = |k: usize| self.numbers.slice(k * self.rows, self.rows);
        let arrays = (0..self.names.len()).map(|k| Arc::new(Float64Array::new(column(k), None)) as ArrayRef);
        RecordBatch::try_new(Arc::new(Schema::new(fields)), arrays.collect())
    }
}
