//! Arrays of NumPy as rows of numbers: arguments read in place where they are what a kernel reads, converted otherwise.

use numpy::{PyArrayDyn, PyArrayMethods, PyUntypedArray, PyUntypedArrayMethods};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyDict;

use crate::memory::{Source, Target};

/// An array of 64-bit floats, alive as long as its rows are read: each row is in one piece, and all are equally far
/// apart.
pub struct Rows<'py> {
    array: Bound<'py, PyArrayDyn<f64>>,
    /// From one row to the next, in numbers, where they do not follow each other; else nothing.
    apart: Option<usize>,
}

/// The leading axes of a call.
#[derive(Clone, Copy)]
pub struct Batch<'a> {
    /// Their lengths; none of a call for one state.
    pub axes: &'a [usize],
    /// The argument that they were read from.
    pub of: &'static str,
}

fn is_plain(array: &Bound<'_, PyArrayDyn<f64>>) -> bool {
    array.is_c_contiguous() && array.is_aligned()
}

/// The array itself, where it is of no class of its own, such as one that masks numbers.
fn itself<'a, 'py>(value: &'a Bound<'py, PyAny>) -> Option<&'a Bound<'py, PyArrayDyn<f64>>> {
    value.cast().ok().filter(|_| value.is_exact_instance_of::<PyUntypedArray>())
}

/// Distance between rows, in numbers, where they are parts of longer rows that follow each other, as fields of
/// structured arrays are; nothing where the array is no such.
fn apart(array: &Bound<'_, PyArrayDyn<f64>>) -> Option<usize> {
    const SIZE: isize = size_of::<f64>() as isize;
    let (shape, strides) = (array.shape(), array.strides());
    let (&size, axes) = shape.split_last()?;
    let (&within, steps) = strides.split_last()?;
    let own = *steps.last()?;
    if !array.is_aligned() || (size > 1 && within != SIZE) || own % SIZE != 0 || own < size as isize * SIZE {
        return None;
    }
    // Axis by axis from the last one.
    let mut next = own;
    for (&count, &step) in axes.iter().zip(steps).rev() {
        if count != 1 && step != next {
            return None;
        }
        next *= count as isize;
    }
    usize::try_from(own / SIZE).ok()
}

/// `numpy.asarray(x).astype(float, order="C", casting="same_kind", copy=False)`, copied where it is not aligned:
/// complex numbers and texts are refused.
fn converted<'py>(name: &str, value: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    static ASARRAY: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
    let py = value.py();
    let named = |error: PyErr| PyTypeError::new_err(format!("{name} is no array of real numbers: {}", error.value(py)));
    let asarray = ASARRAY.get_or_try_init(py, || Ok::<_, PyErr>(py.import("numpy")?.getattr("asarray")?.unbind()))?;
    let array = asarray.bind(py).call1((value,)).map_err(named)?;
    if value.hasattr("mask")? && py.import("numpy.ma")?.call_method1("is_masked", (value,))?.is_truthy()? {
        let why = format!("{name} has masked entries, and every number counts; fill them, or leave those rows out");
        return Err(PyTypeError::new_err(why));
    }
    let how = PyDict::new(py);
    how.set_item("order", "C")?;
    how.set_item("casting", "same_kind")?;
    how.set_item("copy", false)?;
    let array = array.call_method("astype", ("float64",), Some(&how)).map_err(named)?;
    let array = array.cast_into::<PyArrayDyn<f64>>()?;
    if is_plain(&array) { Ok(array) } else { array.call_method1("copy", ("C",))?.cast_into().map_err(Into::into) }
}

/// All numbers of a value in C order, with the axes that it has.
pub fn numbers(name: &str, value: &Bound<'_, PyAny>) -> PyResult<(Vec<f64>, Vec<usize>)> {
    let array = converted(name, value)?;
    Ok((array.readonly().as_slice()?.to_vec(), array.shape().to_vec()))
}

/// A vector of so many numbers.
pub fn vector(name: &str, value: &Bound<'_, PyAny>, size: usize) -> PyResult<Vec<f64>> {
    let (numbers, axes) = numbers(name, value)?;
    match axes[..] {
        [count] if count == size => Ok(numbers),
        _ => Err(PyValueError::new_err(format!("{name} has shape {}; expected ({size},)", shown(&axes)))),
    }
}

impl<'py> Rows<'py> {
    /// Reads an argument.
    pub fn of(name: &'static str, value: &Bound<'py, PyAny>) -> PyResult<Self> {
        match itself(value) {
            Some(array) if is_plain(array) => Ok(Self { array: array.clone(), apart: None }),
            Some(array) => match apart(array) {
                Some(apart) => Ok(Self { array: array.clone(), apart: Some(apart) }),
                None => Ok(Self { array: converted(name, value)?, apart: None }),
            },
            None => Ok(Self { array: converted(name, value)?, apart: None }),
        }
    }

    /// Numbers, one for each state: in one piece.
    pub fn numbers(name: &'static str, value: &Bound<'py, PyAny>) -> PyResult<Self> {
        match itself(value) {
            Some(array) if is_plain(array) => Ok(Self { array: array.clone(), apart: None }),
            _ => Ok(Self { array: converted(name, value)?, apart: None }),
        }
    }

    /// The axes before the last one, which has so many numbers.
    pub fn leading(&self, name: &'static str, size: usize) -> PyResult<&[usize]> {
        match self.array.shape().split_last() {
            Some((&last, leading)) if last == size => Ok(leading),
            _ => {
                let shape = shown(self.array.shape());
                Err(PyValueError::new_err(format!("{name} has shape {shape}; expected (..., {size})")))
            }
        }
    }

    /// All axes: of an array of numbers, one for each state.
    pub fn axes(&self) -> &[usize] {
        self.array.shape()
    }

    /// Its rows of `size` numbers; 0 where one row is for all.
    pub fn source(&self, size: usize) -> Source {
        let stride = if size == 0 { 0 } else { self.apart.unwrap_or(size) };
        // SAFETY: the array is alive, and has the rows, so far apart: its shape was compared.
        #[allow(unsafe_code)]
        unsafe {
            Source::new(self.array.data(), stride)
        }
    }

    /// The addresses that it occupies.
    pub fn extent(&self) -> (usize, usize) {
        let (first, last) = extent(&self.array);
        match (self.apart, self.array.shape().split_last()) {
            (Some(apart), Some((&size, axes))) if self.array.len() > 0 => {
                let rows: usize = axes.iter().product();
                (first, first + ((rows - 1) * apart + size) * size_of::<f64>())
            }
            _ => (first, last),
        }
    }
}

fn extent(array: &Bound<'_, PyArrayDyn<f64>>) -> (usize, usize) {
    let first = array.data() as usize;
    (first, first + array.len() * size_of::<f64>())
}

/// `(100, 7)`, as Python writes it.
pub fn shown(axes: &[usize]) -> String {
    match axes {
        [one] => format!("({one},)"),
        axes => format!("({})", axes.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")),
    }
}

/// An array for results, new.
pub fn new<'py>(py: Python<'py>, axes: &[usize]) -> Bound<'py, PyArrayDyn<f64>> {
    // SAFETY: every number is written before anybody reads it: by the loop over all rows, or the array is dropped.
    #[allow(unsafe_code)]
    unsafe {
        PyArrayDyn::<f64>::new(py, axes, false)
    }
}

/// An array of 32-bit floats that `out` is.
pub fn single<'py>(out: &Bound<'py, PyAny>) -> Option<Bound<'py, PyArrayDyn<f32>>> {
    out.cast::<PyArrayDyn<f32>>().ok().cloned()
}

/// Checks that an array of 32-bit floats can take results: its shape, and that it may be written.
pub fn takes<'py>(name: &str, out: &Bound<'py, PyArrayDyn<f32>>, axes: &[usize]) -> PyResult<()> {
    if out.shape() != axes {
        let (shape, axes) = (shown(out.shape()), shown(axes));
        return Err(PyValueError::new_err(format!("{name} has shape {shape}; expected {axes}")));
    }
    // SAFETY: the object is an array.
    #[allow(unsafe_code)]
    let flags = unsafe { (*out.as_array_ptr()).fields.flags };
    match flags & numpy::npyffi::NPY_ARRAY_WRITEABLE {
        0 => Err(PyValueError::new_err(format!("{name} is read-only"))),
        _ => Ok(()),
    }
}

/// Whether arrays may share memory: the addresses that they occupy overlap.
pub fn overlap(array: &Bound<'_, PyArrayDyn<f32>>, other: &Bound<'_, PyArrayDyn<f32>>) -> PyResult<bool> {
    array.py().import("numpy")?.call_method1("may_share_memory", (array, other))?.extract()
}

/// Rounds numbers into an array of 32-bit floats.
pub fn round<'py>(from: &Bound<'py, PyArrayDyn<f64>>, to: &Bound<'py, PyArrayDyn<f32>>) -> PyResult<()> {
    let how = PyDict::new(from.py());
    how.set_item("casting", "same_kind")?;
    from.py().import("numpy")?.call_method("copyto", (to, from), Some(&how)).map(|_| ())
}

/// The array that `out` is, if it can take these results as they are.
pub fn given<'py>(
    name: &str,
    out: &Bound<'py, PyAny>,
    axes: impl Iterator<Item = usize> + Clone,
    inputs: &[(&'static str, (usize, usize))],
) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let Ok(array) = out.cast::<PyArrayDyn<f64>>() else {
        let found = match out.getattr("dtype") {
            Ok(dtype) => format!("one of {dtype}"),
            Err(_) => out.get_type().name()?.to_string(),
        };
        return Err(PyTypeError::new_err(match single(out) {
            Some(_) => format!("{name} is an array of float32; out has arrays of float64, or of float32, and not both"),
            None => format!("{name} must be an array of float64 or float32, found {found}"),
        }));
    };
    if !is_plain(array) {
        return Err(PyValueError::new_err(format!("{name} must be in C order, and aligned")));
    }
    if !array.shape().iter().copied().eq(axes.clone()) {
        let (shape, axes) = (shown(array.shape()), shown(&axes.collect::<Vec<_>>()));
        return Err(PyValueError::new_err(format!("{name} has shape {shape}; expected {axes}")));
    }
    if !is_writeable(array) {
        return Err(PyValueError::new_err(format!("{name} is read-only")));
    }
    let (first, last) = extent(array);
    for (other, (start, end)) in inputs {
        if first < *end && *start < last {
            return Err(PyValueError::new_err(format!("{name} shares memory with {other}")));
        }
    }
    Ok(array.clone())
}

fn is_writeable(array: &Bound<'_, PyArrayDyn<f64>>) -> bool {
    // SAFETY: the object is an array.
    #[allow(unsafe_code)]
    let flags = unsafe { (*array.as_array_ptr()).fields.flags };
    flags & numpy::npyffi::NPY_ARRAY_WRITEABLE != 0
}

/// The place to which results go.
pub fn target(array: &Bound<'_, PyArrayDyn<f64>>, stride: usize) -> Target {
    // SAFETY: the array is alive over the call, has rows of this length, and shares no memory with arguments.
    #[allow(unsafe_code)]
    unsafe {
        Target::new(array.data(), stride)
    }
}
