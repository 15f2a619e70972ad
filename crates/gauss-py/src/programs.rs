//! Programs of a kernel by their names, over rows of numbers: those that are no methods of its class.

use std::ops::Range;

use gauss_jit::{CallError, KernelError};
use numpy::{PyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors;

/// The programs of a model with numbers for its parameters.
#[pyclass(frozen, module = "gauss._native")]
pub struct Programs {
    kernel: gauss_jit::Kernel,
    parameters: Vec<(String, Vec<f64>)>,
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

    /// The numbers of some rows, or those for all.
    fn rows(&self, rows: Range<usize>) -> &'a [f64] {
        if self.is_shared { self.numbers } else { &self.numbers[rows.start * self.size..rows.end * self.size] }
    }
}

/// Why a row is not computed.
enum Fault {
    Call(CallError),
    /// Its parameters, or those of all rows, are of no body.
    Parameters(Option<usize>, KernelError),
}

impl From<CallError> for Fault {
    fn from(error: CallError) -> Self {
        Self::Call(error)
    }
}

/// One call of a method: its arguments, and parameters that rows have for themselves, by their names.
struct Call<'a> {
    programs: &'a Programs,
    method: &'a str,
    arguments: &'a [Rows<'a>],
    own: &'a [(String, Rows<'a>)],
    outputs: usize,
}

impl Programs {
    pub fn new(kernel: gauss_jit::Kernel, parameters: Vec<(String, Vec<f64>)>) -> Self {
        Self { kernel, parameters }
    }

    /// The kernel with the parameters of a row.
    fn of_row(&self, own: &[(String, Rows<'_>)], row: Option<usize>) -> Result<gauss_jit::Kernel, Fault> {
        let value = |(name, shared): &'_ (String, Vec<f64>)| {
            let own = own.iter().find(|(other, _)| other == name);
            (name.clone(), own.map_or_else(|| shared.clone(), |(_, rows)| rows.row(row.unwrap_or(0)).to_vec()))
        };
        let all: Vec<(String, Vec<f64>)> = self.parameters.iter().map(value).collect();
        let all: Vec<(&str, &[f64])> = all.iter().map(|(name, numbers)| (&name[..], &numbers[..])).collect();
        self.kernel.model().kernel(&all).map_err(|error| Fault::Parameters(row, error))
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

impl Call<'_> {
    /// Some rows.
    fn rows(&self, kernel: &gauss_jit::Kernel, rows: Range<usize>, results: &mut [f64]) -> Result<(), Fault> {
        if self.own.is_empty() {
            let lists: Vec<&[f64]> = self.arguments.iter().map(|argument| argument.rows(rows.clone())).collect();
            return Ok(kernel.method(self.method)?.call_rows(rows.len(), &lists, results)?);
        }
        for (k, row) in rows.enumerate() {
            let lists: Vec<&[f64]> = self.arguments.iter().map(|argument| argument.row(row)).collect();
            let results = &mut results[k * self.outputs..][..self.outputs];
            self.programs.of_row(self.own, Some(row))?.method(self.method)?.call(&lists, results)?;
        }
        Ok(())
    }

    /// All rows by several threads, which end with the call: a process that forks afterwards has lost none.
    fn all(&self, kernel: &gauss_jit::Kernel, rows: usize, threads: usize, results: &mut [f64]) -> Result<(), Fault> {
        if threads <= 1 || rows <= 1 || self.outputs == 0 {
            return self.rows(kernel, 0..rows, results);
        }
        // More threads than cores gain nothing.
        let most = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
        let chunk = rows.div_ceil(threads.min(most));
        std::thread::scope(|scope| {
            let chunks = results.chunks_mut(chunk * self.outputs).enumerate();
            let started = chunks.map(|(k, part)| {
                let own = k * chunk..((k + 1) * chunk).min(rows);
                scope.spawn(move || self.rows(kernel, own, part))
            });
            let started: Vec<_> = started.collect();
            started
                .into_iter()
                .try_for_each(|thread| thread.join().unwrap_or_else(|why| std::panic::resume_unwind(why)))
        })
    }
}

/// Rows of an array: one, or as many as there are states.
fn rows_of<'a>(array: &'a PyReadonlyArray2<'_, f64>, rows: usize) -> PyResult<Rows<'a>> {
    let [given, size] = [array.shape()[0], array.shape()[1]];
    if given != 1 && given != rows {
        return Err(PyValueError::new_err(format!("an argument has {given} rows of {rows}")));
    }
    Ok(Rows { numbers: array.as_slice()?, size, is_shared: given == 1 })
}

#[pymethods]
impl Programs {
    /// The results of a method, row after row: arrays in C order with one row, or as many as there are states; `own`
    /// has such arrays of parameters by their names.
    fn call<'py>(
        &self,
        py: Python<'py>,
        method: &str,
        arrays: Vec<PyReadonlyArray2<'py, f64>>,
        rows: usize,
        threads: usize,
        own: Vec<(String, PyReadonlyArray2<'py, f64>)>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let arguments = arrays.iter().map(|array| rows_of(array, rows)).collect::<PyResult<Vec<_>>>()?;
        let own = own.iter().map(|(name, array)| Ok((name.clone(), rows_of(array, rows)?)));
        let own = own.collect::<PyResult<Vec<_>>>()?;
        let refused = |error: String| PyValueError::new_err(error);
        let found = self.kernel.method(method).map_err(|error| refused(error.to_string()))?;
        for (argument, known) in arguments.iter().zip(found.arguments()) {
            if known.name == "q" && known.components.len() == argument.size {
                self.check_rotations(argument, rows).map_err(refused)?;
            }
        }
        let computed = py.detach(|| {
            let mut results = vec![0.0; rows * found.outputs()];
            let is_one = own.iter().all(|(_, rows)| rows.is_shared);
            let other = (is_one && !own.is_empty()).then(|| self.of_row(&own, None)).transpose()?;
            let own = if is_one { &[][..] } else { &own[..] };
            let call = Call { programs: self, method, arguments: &arguments, own, outputs: found.outputs() };
            call.all(other.as_ref().unwrap_or(&self.kernel), rows, threads, &mut results).map(|()| results)
        });
        computed.map(|results| PyArray1::from_vec(py, results)).map_err(|fault| match fault {
            Fault::Call(error) => refused(error.to_string()),
            Fault::Parameters(row, error) => errors::parameters(py, self.kernel.model().name(), row, &error),
        })
    }
}
