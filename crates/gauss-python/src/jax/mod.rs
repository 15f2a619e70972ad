//! The door to JAX: a handler of XLA's foreign functions, as a capsule. JAX is needed by neither build nor import.

mod abi;

use std::ffi::c_void;
use std::sync::{Arc, Mutex};

use pyo3::exceptions::{PyImportError, PyRuntimeError, PyTypeError};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyCapsule, PyDict, PyList};

use crate::call::{self, Fault};
use crate::class::Kernel;
use crate::description::{Field, Shape};
use crate::kernels::{AnyKernel, AnyScene};
use crate::memory::{Source, Target};
use crate::methods::{Id, SPECS, Work};
use crate::own::OwnParameter;
use crate::steps::off_group_words;
use crate::tuples;
use abi::{Buffer, F32, F64, Frame};

/// Fields that a mask of parameters has bits for, with a sign that stays free.
const MOST_FIELDS: usize = 62;

/// Kernels of which JAX was given functions: compiled programs name them by their place here, and nobody tells when the
/// last such program is gone.
static KERNELS: Mutex<Vec<Arc<dyn AnyKernel>>> = Mutex::new(Vec::new());

/// The place of a kernel; kernels that are equal have one.
fn place(kernel: &Arc<dyn AnyKernel>) -> PyResult<usize> {
    let mut all = KERNELS.lock().map_err(|_| PyRuntimeError::new_err("the list of kernels is lost"))?;
    let equal = |other: &Arc<dyn AnyKernel>| {
        std::ptr::eq(other.scene().description(), kernel.scene().description()) && other.numbers() == kernel.numbers()
    };
    if let Some(place) = all.iter().position(equal) {
        return Ok(place);
    }
    all.push(Arc::clone(kernel));
    Ok(all.len() - 1)
}

/// Handler that XLA calls. All kernels of a module have this one handler.
#[allow(unsafe_code)]
unsafe extern "C" fn handler(frame: *mut Frame) -> *mut c_void {
    // SAFETY: XLA calls it with frames.
    unsafe { abi::answer(frame, compute) }
}

/// Numbers of a buffer that are read: where they are, or in 64 bits.
fn read(buffer: &Buffer, size: usize, count: usize, kept: &mut Vec<Vec<f64>>) -> Result<Source, String> {
    let numbers = buffer.axes().iter().product::<usize>();
    if numbers != size * count {
        return Err(format!("an argument has {numbers} numbers; expected {count} rows of {size}"));
    }
    let first = match buffer.dtype {
        F64 => buffer.data.cast::<f64>().cast_const(),
        F32 => {
            let first = buffer.data.cast::<f32>().cast_const();
            // SAFETY: the buffer has so many numbers of this type, alive over the call.
            #[allow(unsafe_code)]
            let wide = (0..numbers).map(|k| f64::from(unsafe { first.add(k).read() })).collect();
            kept.push(wide);
            kept.last().map_or(std::ptr::null(), |wide| wide.as_ptr())
        }
        other => return Err(format!("arrays are of float64 or float32, and not of XLA's type {other}")),
    };
    // SAFETY: rows of so many numbers, alive over the call: `kept` is dropped after it.
    #[allow(unsafe_code)]
    let source = unsafe { Source::new(first, size) };
    Ok(source)
}

/// The fields of a scene whose bits are in a mask.
fn fields_in(scene: &dyn AnyScene, mask: usize) -> impl Iterator<Item = usize> {
    (0..scene.description().fields.len().min(MOST_FIELDS)).filter(move |number| mask >> number & 1 == 1)
}

/// Parameters that rows have for themselves: those whose bits are in the attribute `own`, each an array of rows.
fn own(scene: &dyn AnyScene, mask: usize, buffers: &[&Buffer], count: usize) -> Result<Vec<OwnParameter>, String> {
    let of_field = |(number, buffer): (usize, &&Buffer)| {
        let size = scene.description().fields[number].shape.size();
        let (mut kept, mut numbers) = (Vec::new(), vec![0.0; count * size]);
        let source = read(buffer, size, count, &mut kept)?;
        // SAFETY: rows of so many numbers, alive over the call.
        #[allow(unsafe_code)]
        unsafe {
            source.copy(0..count, size, &mut numbers);
        }
        Ok(OwnParameter::of_rows(scene, number, numbers, count))
    };
    fields_in(scene, mask).zip(buffers).map(of_field).collect()
}

/// One call of XLA: time, arguments, parameters of rows, and results in the order of the method's words.
fn compute(frame: &Frame) -> Result<(), String> {
    let number = |name| frame.attribute(name);
    let (place, method, name) = (number("kernel")?, number("method")?, number("frame")?);
    let kernel = KERNELS.lock().ok().and_then(|all| all.get(place).cloned()).ok_or("the kernel is not known")?;
    let id = Id::ALL.into_iter().find(|id| *id as usize == method).ok_or("the method is not known")?;
    let (scene, spec) = (kernel.scene(), &SPECS[method]);
    if !scene.has(id) {
        return Err(format!("the kernel has no {}", spec.name));
    }
    let (arguments, results) = (frame.arguments(), frame.results());
    let mask = number("own")?;
    let named = spec.arguments.iter().filter(|argument| scene.sizes().get(argument.size) > 0);
    let (wanted, parameters) = (named.clone().count(), fields_in(scene, mask).count());
    let (Some((time, others)), true) = (arguments.split_first(), results.len() == spec.results.len()) else {
        return Err("the call has not the arrays of the method".to_owned());
    };
    if others.len() != wanted + parameters {
        return Err(format!("{} has {} arrays besides time", spec.name, wanted + parameters));
    }
    let (others, of_rows) = others.split_at(wanted);
    let count = time.axes().iter().product();
    let (mut kept, mut wide) = (Vec::new(), Vec::new());
    let mut work = Work { t: read(time, 1, count, &mut kept)?, frame: name, ..Work::NONE };
    let own = own(scene, mask, of_rows, count)?;
    for (argument, buffer) in named.zip(others) {
        work.arguments[argument.slot as usize] = read(buffer, scene.sizes().get(argument.size), count, &mut kept)?;
    }
    for (k, (result, buffer)) in spec.results.iter().zip(&results).enumerate() {
        let size: usize = result.axes.iter().map(|axis| scene.sizes().get(*axis)).product();
        work.results[k] = written(buffer, size, count, &mut wide)?;
    }
    // SAFETY: all arrays of the method have these rows: their sizes were compared.
    #[allow(unsafe_code)]
    let computed = unsafe { call::rows_with(&*kernel, id, &work, count, &own) };
    computed.map_err(|fault| match fault {
        Fault::OffGroup(off) => format!("row {} of q is no rotation: {}", off.row, off_group_words(off.squares)),
        Fault::Parameters(row, all) => {
            let all: Vec<String> = all.into_iter().map(|one| one.message).collect();
            format!("parameters of row {} are of no body: {}", row.unwrap_or(0), all.join("; "))
        }
    })?;
    round(wide);
    Ok(())
}

/// Results that are computed in 64 bits, of buffers of 32.
type Wide<'a> = Vec<(&'a Buffer, Vec<f64>)>;

/// Rows of a buffer that are written: where they are, or in 64 bits, from which they are rounded.
fn written<'a>(buffer: &'a Buffer, size: usize, count: usize, wide: &mut Wide<'a>) -> Result<Target, String> {
    let numbers = buffer.axes().iter().product::<usize>();
    if numbers != size * count {
        return Err(format!("a result has {numbers} numbers; expected {count} rows of {size}"));
    }
    let first = match buffer.dtype {
        F64 => buffer.data.cast::<f64>(),
        F32 => {
            let mut numbers = vec![0.0; numbers];
            let first = numbers.as_mut_ptr();
            wide.push((buffer, numbers));
            first
        }
        other => return Err(format!("results are of float64 or float32, and not of XLA's type {other}")),
    };
    // SAFETY: rows of so many numbers, alive over the call, which XLA lets nobody else touch.
    #[allow(unsafe_code)]
    let target = unsafe { Target::new(first, size) };
    Ok(target)
}

/// Writes what was computed in 64 bits to buffers of 32.
fn round(wide: Wide<'_>) {
    for (buffer, numbers) in wide {
        let first = buffer.data.cast::<f32>();
        for (k, number) in numbers.into_iter().enumerate() {
            // SAFETY: the buffer has as many numbers of this type.
            #[allow(unsafe_code)]
            unsafe {
                first.add(k).write(number as f32);
            }
        }
    }
}

/// The methods of a kernel as functions of JAX.
pub fn functions<'py>(module: &str, kernel: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    static DOOR: PyOnceLock<Py<PyModule>> = PyOnceLock::new();
    let py = kernel.py();
    let Ok(own) = kernel.cast::<Kernel>() else {
        return Err(PyTypeError::new_err("functions of JAX are those of a kernel"));
    };
    own.get().knows_all_forces(py, ("jax", "jax(kernel.without_contacts())"))?;
    // Each extension has a handler, and so a module, of its own.
    let target = format!("gauss_{}", module.replace('.', "_"));
    let source = || {
        let (file, name) = (c_text(&format!("{target}_jax.py"))?, c_text(&format!("{target}_jax"))?);
        PyModule::from_code(py, &c_text(include_str!("door.py"))?, &file, &name).map(Bound::unbind)
    };
    let missing = |error: PyErr| {
        let why = error.value(py).to_string();
        PyImportError::new_err(format!("functions of JAX need the package jax, 0.5 or later (pip install jax): {why}"))
    };
    let door = DOOR.get_or_try_init(py, source).map_err(missing)?.bind(py);
    let address = handler as *const () as *mut c_void;
    let capsule = capsule(py, address)?;
    let shared = own.get().shared();
    let how = PyDict::new(py);
    how.set_item("kernel", kernel)?;
    how.set_item("target", target)?;
    how.set_item("capsule", capsule)?;
    how.set_item("number", place(&shared)?)?;
    how.set_item("specs", specs(py, &*shared)?)?;
    let sizes = shared.scene().sizes();
    how.set_item("parameters", parameters(&*shared))?;
    how.set_item("columns", columns(&*shared))?;
    how.set_item("increment", sizes.increment)?;
    how.set_item("flat", shared.scene().description().coordinates.iter().all(|part| part.unit == 0))?;
    door.getattr("make")?.call((), Some(&how))
}

/// The parameters that rows may have for themselves: number of the field, name, axes.
fn parameters(kernel: &dyn AnyKernel) -> Vec<(usize, &'static str, Vec<usize>)> {
    let fields = kernel.scene().description().fields.iter().enumerate().take(MOST_FIELDS);
    let of_field = |(number, field): (usize, &Field)| match field.shape {
        Shape::Array(axes) if field.shape.size() > 0 => Some((number, field.name, axes.to_vec())),
        _ => None,
    };
    fields.filter_map(of_field).collect()
}

/// The field of each column of `by_parameters`, by its number, and the place there.
fn columns(kernel: &dyn AnyKernel) -> Vec<Option<(usize, usize)>> {
    let scene = kernel.scene();
    scene.parameters().iter().map(|name| scene.description().place_of(name)).collect()
}

fn c_text(text: &str) -> PyResult<std::ffi::CString> {
    std::ffi::CString::new(text).map_err(Into::into)
}

/// A capsule without a name, as `jax.ffi.pycapsule` makes them.
fn capsule(py: Python<'_>, address: *mut c_void) -> PyResult<Bound<'_, PyCapsule>> {
    // SAFETY: the address is that of a function, which is there as long as the process.
    #[allow(unsafe_code)]
    unsafe {
        let capsule = pyo3::ffi::PyCapsule_New(address, std::ptr::null(), None);
        Bound::from_owned_ptr_or_err(py, capsule)?.cast_into::<PyCapsule>().map_err(Into::into)
    }
}

/// The methods that the kernel has: name, number, what names come first, arguments and results with their sizes, and
/// the class of several results.
fn specs<'py>(py: Python<'py>, kernel: &dyn AnyKernel) -> PyResult<Bound<'py, PyList>> {
    let scene = kernel.scene();
    let sizes = scene.sizes();
    let all = PyList::empty(py);
    for id in Id::ALL.into_iter().filter(|id| scene.has(*id)) {
        let spec = &SPECS[id as usize];
        let names: Option<Vec<&str>> = match (spec.frame, id) {
            (false, _) => None,
            (true, Id::Reaction) => Some(scene.joints().to_vec()),
            (true, _) => Some(scene.frames().to_vec()),
        };
        let arguments: Vec<(&str, usize)> =
            spec.arguments.iter().map(|argument| (argument.name, sizes.get(argument.size))).collect();
        let results: Vec<(&str, Vec<usize>)> = spec
            .results
            .iter()
            .map(|result| (result.name, result.axes.iter().map(|axis| sizes.get(*axis)).collect()))
            .collect();
        // That of the package, so that pickles find it.
        let class = (results.len() > 1).then(|| tuples::class(py, &spec.class_name())).transpose()?;
        all.append((spec.name, id as usize, names, arguments, results, class))?;
    }
    Ok(all)
}
