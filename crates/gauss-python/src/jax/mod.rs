//! The door to JAX: a handler of XLA's foreign functions, as a capsule. JAX is needed by neither build nor import.

mod abi;

use std::ffi::c_void;
use std::sync::{Arc, Mutex};

use pyo3::exceptions::{PyImportError, PyRuntimeError, PyTypeError};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyCapsule, PyDict, PyList};

use crate::call;
use crate::class::Kernel;
use crate::kernels::AnyKernel;
use crate::memory::{Source, Target};
use crate::methods::{Id, SPECS, Work};
use crate::steps::off_group_words;
use crate::tuples;
use abi::{Buffer, F32, F64, Frame};

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

/// One call of XLA: time, arguments and results in the order of the method's words.
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
    let own = spec.arguments.iter().filter(|argument| scene.sizes().get(argument.size) > 0);
    let (Some((time, others)), true) = (arguments.split_first(), results.len() == spec.results.len()) else {
        return Err("the call has not the arrays of the method".to_owned());
    };
    if others.len() != own.clone().count() {
        return Err(format!("{} has {} arrays besides time", spec.name, own.count()));
    }
    let count = time.axes().iter().product();
    let (mut kept, mut wide) = (Vec::new(), Vec::new());
    let mut work = Work { t: read(time, 1, count, &mut kept)?, frame: name, ..Work::NONE };
    for (argument, buffer) in own.zip(others) {
        work.arguments[argument.slot as usize] = read(buffer, scene.sizes().get(argument.size), count, &mut kept)?;
    }
    for (k, (result, buffer)) in spec.results.iter().zip(&results).enumerate() {
        let size: usize = result.axes.iter().map(|axis| scene.sizes().get(*axis)).product();
        let numbers = buffer.axes().iter().product::<usize>();
        if numbers != size * count {
            return Err(format!("a result has {numbers} numbers; expected {count} rows of {size}"));
        }
        let first = match buffer.dtype {
            F64 => buffer.data.cast::<f64>(),
            F32 => {
                let mut numbers = vec![0.0; numbers];
                let first = numbers.as_mut_ptr();
                wide.push((*buffer, numbers));
                first
            }
            other => return Err(format!("results are of float64 or float32, and not of XLA's type {other}")),
        };
        // SAFETY: rows of so many numbers, alive over the call, which XLA lets nobody else touch.
        #[allow(unsafe_code)]
        let target = unsafe { Target::new(first, size) };
        work.results[k] = target;
    }
    // SAFETY: all arrays of the method have these rows: their sizes were compared.
    #[allow(unsafe_code)]
    let computed = unsafe { call::rows(&*kernel, id, &work, count) };
    computed.map_err(|off| format!("row {} of q is no rotation: {}", off.row, off_group_words(off.squares)))?;
    round(wide);
    Ok(())
}

/// Writes what was computed in 64 bits to buffers of 32.
fn round(wide: Vec<(&Buffer, Vec<f64>)>) {
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
    how.set_item("increment", sizes.increment)?;
    how.set_item("flat", shared.scene().description().coordinates.iter().all(|part| part.unit == 0))?;
    door.getattr("make")?.call((), Some(&how))
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
