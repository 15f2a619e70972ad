//! The only file with `unsafe`: machine code is kept as long as it can be called, and called with the memory that it
//! reads and writes.
#![allow(unsafe_code)]

use std::fmt;
use std::mem;
use std::slice;

use cranelift_jit::JITModule;
use cranelift_module::FuncId;
use gauss_runtime::table::Table;

use super::backend::{Compiled, MOST_ARGUMENTS};
use super::functions;
use crate::tables::Tables;

/// A function of the lists of numbers of its arguments, one pointer for each, and of the place for its results.
type Function = unsafe extern "C" fn(*const *const f64, *mut f64);

/// A compiled program with the memory that it is in, which is never written again.
pub struct MachineCode {
    function: Function,
    /// Count of the numbers of each argument.
    counts: Vec<usize>,
    outputs: usize,
    memory: Memory,
    /// Tables whose addresses are in the code.
    _tables: Tables,
}

/// The memory of code: writable while it is made, executable afterwards and no longer writable.
struct Memory(Option<JITModule>);

// SAFETY: nothing is reached through the module after it is finalised but its memory, which no one writes until it is
// freed, by one owner.
unsafe impl Sync for Memory {}

impl Drop for Memory {
    fn drop(&mut self) {
        if let Some(module) = self.0.take() {
            // SAFETY: the only pointer into this memory is `function` of the `MachineCode` that is dropped with it, or
            // none; no call runs, because calls borrow it.
            unsafe { module.free_memory() };
        }
    }
}

/// The function of that name in a module that is finalised, if it could be. Tables that it calls are among these.
pub fn code(
    module: JITModule,
    id: Option<FuncId>,
    (counts, outputs): (Vec<usize>, usize),
    tables: &Tables,
) -> Option<MachineCode> {
    let memory = Memory(Some(module));
    let address = memory.0.as_ref()?.get_finalized_function(id?);
    // SAFETY: the function was declared with two pointers as parameters, nothing as its result, and the calling
    // convention of the host, which is that of `extern "C"`.
    let function = unsafe { mem::transmute::<*const u8, Function>(address) };
    Some(MachineCode { function, counts, outputs, memory, _tables: tables.clone() })
}

impl Compiled for MachineCode {
    fn run(&self, arguments: &[&[f64]], outputs: &mut [f64]) {
        let fits = arguments.len() == self.counts.len()
            && arguments.iter().zip(&self.counts).all(|(list, count)| list.len() == *count);
        assert!(fits && outputs.len() == self.outputs, "numbers of another program");
        let mut lists = [std::ptr::null(); MOST_ARGUMENTS];
        lists.iter_mut().zip(arguments).for_each(|(pointer, list)| *pointer = list.as_ptr());
        // SAFETY: code reads as many pointers as there are arguments, at most `MOST_ARGUMENTS`, and behind each the
        // components that its argument has (`Program::verify`, which was asked when it was made); it writes as many
        // numbers as there are outputs. Both were compared above. Its memory lives as long as `self`, as do the tables
        // whose addresses are in it.
        unsafe { (self.function)(lists.as_ptr(), outputs.as_mut_ptr()) };
    }

    fn is_machine_code(&self) -> bool {
        self.memory.0.is_some()
    }
}

impl fmt::Debug for MachineCode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("MachineCode").field("arguments", &self.counts).field("outputs", &self.outputs).finish()
    }
}

/// Computes sines and cosines of several angles, for machine code.
///
/// # Safety
/// There are `count` numbers at `angles`, and place for twice as many at `results`, none of them among the former.
pub unsafe extern "C" fn sines_and_cosines(angles: *const f64, count: usize, results: *mut f64) {
    // SAFETY: only code of this crate calls it, with two places in its own frame, of `count` numbers, which it has
    // written, and of twice as many; it touches neither meanwhile, and both are aligned to eight bytes.
    let (angles, results) = unsafe {
        results.write_bytes(0, 2 * count);
        (slice::from_raw_parts(angles, count), slice::from_raw_parts_mut(results.cast::<[f64; 2]>(), count))
    };
    functions::sines_and_cosines(angles, results);
}

/// Calls a table, for machine code: the derivative whose orders are the bytes of a number, the first one lowest.
///
/// # Safety
/// The address is that of a table that lives over the call.
pub unsafe extern "C" fn table(table: *const Table, orders: u64, x: f64, y: f64, z: f64) -> f64 {
    let [first, second, third, ..] = orders.to_le_bytes();
    // SAFETY: only code of this crate calls it, with the address of a table that `MachineCode` holds, which the call
    // borrows; nobody writes tables.
    unsafe { &*table }.at([first, second, third], [x, y, z])
}
