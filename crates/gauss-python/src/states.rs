//! States by name: structured arrays of NumPy, whose fields are the numbers of q and z.

use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PySlice, PyTuple};

use crate::arrays;
use crate::class::{Kernel, place};

impl Kernel {
    fn fields<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let names = self.scene().names().concat();
        PyList::new(py, names.iter().map(|name| (*name, "f8")))
    }
}

#[pymethods]
impl Kernel {
    /// The type of structured arrays of states: a field for each number of q and z, by its name.
    #[getter]
    fn dtype<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        py.import("numpy")?.call_method1("dtype", (self.fields(py)?,))
    }

    /// A structured array of states, alike in the beginning: coordinates and speeds by name, whole ones or their
    /// numbers; what is not named is at rest in the origin.
    #[pyo3(signature = (shape=None, **named))]
    fn states<'py>(
        &self,
        py: Python<'py>,
        shape: Option<&Bound<'py, PyAny>>,
        named: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let mut numbers = self.scene().at_rest();
        for (name, value) in named.into_iter().flat_map(|named| named.iter()) {
            let name: String = name.extract()?;
            place(self.scene(), &name, &arrays::numbers(&name, &value)?.0, &mut numbers)?;
        }
        let shape = shape.map_or_else(|| PyTuple::empty(py).into_any(), Clone::clone);
        let states = py.import("numpy")?.call_method1("empty", (shape, self.dtype(py)?))?;
        let all = PyTuple::new(py, numbers.concat())?;
        // One structured number; a tuple of one would be taken for an array otherwise.
        let one = py.import("numpy")?.call_method1("array", (all, self.dtype(py)?))?;
        states.set_item(py.Ellipsis(), one)?;
        Ok(states)
    }

    /// The arrays q and z of a structured array of states, which share its memory: kernels read them where they are.
    fn views<'py>(&self, py: Python<'py>, states: &Bound<'py, PyAny>) -> PyResult<[Bound<'py, PyAny>; 2]> {
        let expected = self.dtype(py)?;
        let found = states.getattr("dtype").map_err(|_| PyTypeError::new_err("states are a structured array"))?;
        if !found.eq(&expected)? {
            let name = self.scene().description().name;
            return Err(PyValueError::new_err(format!("states have the type {found}; expected `dtype` of {name}")));
        }
        let sizes = self.scene().sizes();
        let (coordinates, all) = (sizes.configuration, sizes.configuration + sizes.speeds);
        // Each state as so many numbers: a view, whatever the strides of the array are.
        let numbers = states.call_method1("view", (("f8", (all,)),))?;
        let part = |from: usize, to: usize| {
            let slice = PySlice::new(py, from as isize, to as isize, 1);
            numbers.get_item((py.Ellipsis(), slice))
        };
        Ok([part(0, coordinates)?, part(coordinates, all)?])
    }
}
