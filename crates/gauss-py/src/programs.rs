//! Programs of a kernel by their names, over rows of numbers: those that are no methods of its class.

use std::ops::Range;

use gauss_jit::{CallError, Method};
use numpy::{PyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// The programs of a model with numbers for its parameters.
#[pyclass(frozen, module = "gauss._native")]
pub struct Programs {
    kernel: gauss_jit::Kernel,
}

/// Rows of one argument: one for all, or one for each state.
#[derive(Clone, Copy)]
struct Rows<'a> {
    numbers: &'a [f64],
    size: usize,
    is_shared: bool,
}

impl<'a> Rows<'a> {
    fn row(&self, row: usize) -> &'a [f64] {
        let first = if self.is_shared { 0 } else { row * self.size };
        &self.numbers[first..first + self.size]
    }
}

impl Programs {
    pub fn new(kernel: gauss_jit::Kernel) -> Self {
        Self { kernel }
    }

    /// The first rotation of a configuration that is none, as the classes of compiled structs refuse it: in more than
    /// half of the digits.
    fn check_rotations(&self, q: &Rows<'_>, rows: usize) -> Result<(), String> {
        for row in 0..if q.is_shared { 1 } else { rows } {
            for Range { start, end } in self.kernel.model().unit_components().iter().cloned() {
                let squares: f64 = q.row(row)[start..end].iter().map(|x| x * x).sum();
                let is_near = (squares - 1.0).abs() <= 2.0 * f64::EPSILON.sqrt();
                // What is not a number is not near either.
                if !is_near {
                    return Err(format!(
                        "q[{start}:{end}] of row {row} is no rotation: squares of its numbers add up to {squares:.6}, \
                         and to 1 of every rotation"
                    ));
                }
            }
        }
        Ok(())
    }
}

/// Calls a method for some rows.
fn call_rows(
    method: &Method<'_>,
    arguments: &[Rows<'_>],
    rows: Range<usize>,
    results: &mut [f64],
) -> Result<(), CallError> {
    let mut lists: Vec<&[f64]> = vec![&[]; arguments.len()];
    for (k, row) in rows.enumerate() {
        lists.iter_mut().zip(arguments).for_each(|(list, argument)| *list = argument.row(row));
        method.call(&lists, &mut results[k * method.outputs()..][..method.outputs()])?;
    }
    Ok(())
}

/// The same by several threads, which end with the call: a process that forks afterwards has lost none.
fn call_all(
    method: &Method<'_>,
    arguments: &[Rows<'_>],
    (rows, threads): (usize, usize),
    results: &mut [f64],
) -> Result<(), CallError> {
    if threads <= 1 || rows <= 1 || method.outputs() == 0 {
        return call_rows(method, arguments, 0..rows, results);
    }
    // More threads than cores gain nothing.
    let most = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let chunk = rows.div_ceil(threads.min(most));
    std::thread::scope(|scope| {
        let chunks = results.chunks_mut(chunk * method.outputs()).enumerate();
        let started = chunks.map(|(k, part)| {
            let own = k * chunk..((k + 1) * chunk).min(rows);
            scope.spawn(move || call_rows(method, arguments, own, part))
        });
        let started: Vec<_> = started.collect();
        started.into_iter().try_for_each(|thread| thread.join().unwrap_or_else(|why| std::panic::resume_unwind(why)))
    })
}

#[pymethods]
impl Programs {
    /// The results of a method, row after row: arrays in C order with one row, or as many as there are states.
    fn call<'py>(
        &self,
        py: Python<'py>,
        method: &str,
        arrays: Vec<PyReadonlyArray2<'py, f64>>,
        rows: usize,
        threads: usize,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let mut arguments = Vec::new();
        for array in &arrays {
            let [given, size] = [array.shape()[0], array.shape()[1]];
            if given != 1 && given != rows {
                return Err(PyValueError::new_err(format!("an argument has {given} rows of {rows}")));
            }
            arguments.push(Rows { numbers: array.as_slice()?, size, is_shared: given == 1 });
        }
        let computed = py.detach(|| {
            let method = self.kernel.method(method).map_err(|error| error.to_string())?;
            for (argument, own) in arguments.iter().zip(method.arguments()) {
                if own.name == "q" && own.components.len() == argument.size {
                    self.check_rotations(argument, rows)?;
                }
            }
            let mut results = vec![0.0; rows * method.outputs()];
            let called = call_all(&method, &arguments, (rows, threads), &mut results);
            called.map(|()| results).map_err(|error| error.to_string())
        });
        computed.map(|results| PyArray1::from_vec(py, results)).map_err(PyValueError::new_err)
    }
}
