//! The calling convention of XLA's foreign functions, version 0, as its header `xla/ffi/api/c_api.h` publishes it:
//! only what a handler for hosts reads. Every struct says its size first; newer versions add fields behind these.

#![allow(unsafe_code)]

use std::ffi::{CString, c_char, c_void};

/// The kind of the extension by which a runtime asks for [`Metadata`].
const METADATA: i32 = 1;
/// The stage in which arguments may be read.
const EXECUTE: i32 = 3;
/// The version of the convention: within it fields stay where they are.
const MAJOR: i32 = 0;
const INVALID_ARGUMENT: i32 = 3;
const SCALAR: i32 = 3;
const S64: i32 = 5;

/// Types of numbers in buffers.
pub const F32: i32 = 11;
/// As [`F32`].
pub const F64: i32 = 12;

#[repr(C)]
struct Extension {
    size: usize,
    kind: i32,
    next: *mut Extension,
}

#[repr(C)]
struct Version {
    size: usize,
    extensions: *mut Extension,
    major: i32,
    minor: i32,
}

#[repr(C)]
struct Metadata {
    size: usize,
    version: Version,
    traits: u32,
}

#[repr(C)]
struct MetadataExtension {
    base: Extension,
    metadata: *mut Metadata,
}

#[repr(C)]
struct ErrorArguments {
    size: usize,
    extensions: *mut Extension,
    message: *const c_char,
    code: i32,
}

#[repr(C)]
struct Api {
    size: usize,
    extensions: *mut Extension,
    version: Version,
    internal: *const c_void,
    create_error: unsafe extern "C" fn(*mut ErrorArguments) -> *mut c_void,
}

/// An array.
#[repr(C)]
pub struct Buffer {
    size: usize,
    extensions: *mut Extension,
    /// [`F32`], [`F64`] or another type.
    pub dtype: i32,
    /// Its numbers in C order.
    pub data: *mut c_void,
    rank: i64,
    dims: *const i64,
}

impl Buffer {
    /// Its axes.
    pub fn axes(&self) -> Vec<usize> {
        // SAFETY: the runtime gives as many lengths as there are axes, for the time of the call.
        (0..self.rank.max(0) as usize).map(|k| unsafe { self.dims.add(k).read() }.max(0) as usize).collect()
    }
}

#[repr(C)]
struct List {
    size: usize,
    extensions: *mut Extension,
    count: i64,
    kinds: *const i32,
    items: *const *mut c_void,
}

impl List {
    /// Buffers, the only kind that there is.
    fn buffers(&self) -> Vec<&Buffer> {
        // SAFETY: the runtime gives as many addresses of buffers, for the time of the call.
        (0..self.count.max(0) as usize).map(|k| unsafe { &*self.items.add(k).read().cast::<Buffer>() }).collect()
    }
}

#[repr(C)]
struct Span {
    first: *const u8,
    length: usize,
}

#[repr(C)]
struct Number {
    dtype: i32,
    value: *const c_void,
}

#[repr(C)]
struct Attributes {
    size: usize,
    extensions: *mut Extension,
    count: i64,
    kinds: *const i32,
    names: *const *const Span,
    items: *const *mut c_void,
}

/// A call.
#[repr(C)]
pub struct Frame {
    size: usize,
    extensions: *mut Extension,
    api: *const Api,
    context: *mut c_void,
    stage: i32,
    arguments: List,
    results: List,
    attributes: Attributes,
}

impl Frame {
    /// The arrays that are read.
    pub fn arguments(&self) -> Vec<&Buffer> {
        self.arguments.buffers()
    }

    /// Arrays that are written.
    pub fn results(&self) -> Vec<&Buffer> {
        self.results.buffers()
    }

    /// A whole number by its name.
    pub fn attribute(&self, name: &str) -> Result<usize, String> {
        let all = &self.attributes;
        for k in 0..all.count.max(0) as usize {
            // SAFETY: the runtime gives as many kinds, names and values, for the time of the call; what a value is, its
            // kind says.
            unsafe {
                let span = &*all.names.add(k).read();
                let word = std::slice::from_raw_parts(span.first, span.length);
                if word == name.as_bytes() && all.kinds.add(k).read() == SCALAR {
                    let number = &*all.items.add(k).read().cast::<Number>();
                    if number.dtype == S64 {
                        let value = number.value.cast::<i64>().read_unaligned();
                        return usize::try_from(value).map_err(|_| format!("{name} is negative"));
                    }
                }
            }
        }
        Err(format!("the call has no whole number {name}"))
    }

    /// Answers a runtime that asks about the handler itself; whether it does.
    fn answered(&self) -> bool {
        let mut extension = self.extensions;
        while !extension.is_null() {
            // SAFETY: extensions are a list, and one of this kind has metadata behind it.
            unsafe {
                if (*extension).kind == METADATA {
                    let metadata = (*extension.cast::<MetadataExtension>()).metadata;
                    (*metadata).version.major = MAJOR;
                    // Newer versions of the same number only add fields: what is read here is in all of them.
                    (*metadata).version.minor = if self.api.is_null() { 0 } else { (*self.api).version.minor };
                    (*metadata).traits = 0;
                    return true;
                }
                extension = (*extension).next;
            }
        }
        false
    }

    fn error(&self, message: &str) -> *mut c_void {
        let message = CString::new(message.replace('\0', " ")).unwrap_or_default();
        let mut arguments = ErrorArguments {
            size: size_of::<ErrorArguments>(),
            extensions: std::ptr::null_mut(),
            message: message.as_ptr(),
            code: INVALID_ARGUMENT,
        };
        // SAFETY: the runtime copies the message.
        unsafe { ((*self.api).create_error)(&raw mut arguments) }
    }
}

/// Answers a call by a function, whose errors become those of the runtime.
///
/// # Safety
/// The frame is one of XLA's foreign functions.
pub unsafe fn answer(frame: *mut Frame, compute: impl FnOnce(&Frame) -> Result<(), String>) -> *mut c_void {
    // SAFETY: of this function.
    let frame = unsafe { &*frame };
    if frame.answered() || frame.stage != EXECUTE {
        return std::ptr::null_mut();
    }
    let computed = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| compute(frame)));
    match computed.unwrap_or_else(|_| Err("the kernel panicked".to_owned())) {
        Ok(()) => std::ptr::null_mut(),
        Err(message) => frame.error(&message),
    }
}
