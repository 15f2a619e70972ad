//! The only file with `unsafe`: machine code is kept as long as it can be called, and called with the memory that it
//! reads and writes.
#![allow(unsafe_code)]

use std::fmt;
use std::mem;
use std::slice;

use cranelift_jit::JITModule;
use cranelift_module::FuncId;
use gauss_runtime::table::Table;

#[cfg(target_arch = "x86_64")]
use super::backend::CompiledLanes;
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

/// A function of the inputs in lanes, the place for outputs, the room, the numbers that rows share, those of the code.
#[cfg(target_arch = "x86_64")]
type LanesFunction = unsafe extern "sysv64" fn(*const f64, *mut f64, *mut f64, *const f64, *const u64);

/// Counts of the numbers that code in lanes reads and writes.
#[cfg(target_arch = "x86_64")]
pub struct Extent {
    /// Numbers in a vector.
    pub width: usize,
    /// Numbers that rows share.
    pub shared: usize,
    /// Numbers of a row.
    pub inputs: usize,
    pub outputs: usize,
    /// Vectors that are stored in between, and which of them has the exceptions, if there are any.
    pub room: usize,
    pub exceptions: Option<usize>,
}

/// A compiled program for several rows, with the memory that it is in.
#[cfg(target_arch = "x86_64")]
pub struct MachineLanes {
    function: LanesFunction,
    extent: Extent,
    numbers: Vec<u64>,
    _memory: Memory,
    /// Tables whose addresses are in the code.
    _tables: Tables,
}

/// The function of that name in a module that is finalised, if it could be.
#[cfg(target_arch = "x86_64")]
pub fn lanes(
    module: JITModule,
    id: Option<FuncId>,
    (extent, numbers): (Extent, Vec<u64>),
    tables: &Tables,
) -> Option<MachineLanes> {
    let memory = Memory(Some(module));
    let address = memory.0.as_ref()?.get_finalized_function(id?);
    // SAFETY: `Assembler` writes functions of five addresses, without a result, of this calling convention, whatever
    // that of the host is.
    let function = unsafe { mem::transmute::<*const u8, LanesFunction>(address) };
    Some(MachineLanes { function, extent, numbers, _memory: memory, _tables: tables.clone() })
}

#[cfg(target_arch = "x86_64")]
impl CompiledLanes for MachineLanes {
    fn width(&self) -> usize {
        self.extent.width
    }

    fn room(&self) -> usize {
        self.extent.room * self.extent.width
    }

    fn run(&self, shared: &[f64], inputs: &[f64], outputs: &mut [f64], room: &mut [f64]) -> u32 {
        let Extent { width, exceptions, .. } = self.extent;
        let lengths = [self.extent.inputs * width, self.extent.outputs * width, self.room(), self.extent.shared];
        let found = [inputs.len(), outputs.len(), room.len(), shared.len()];
        assert!(lengths == found, "numbers of another program");
        let (to, between) = (outputs.as_mut_ptr(), room.as_mut_ptr());
        // SAFETY: the steps of the code read vectors of inputs that the arguments of the program have, components of
        // its first one, and numbers that were written with it (`Program::verify`, which was asked when it was made);
        // they write as many vectors of outputs and of the room as there are. All were compared above; the processor
        // was asked for its instructions when the code was made. Its memory lives as long as `self`, as do the tables
        // whose addresses are in it.
        unsafe { (self.function)(inputs.as_ptr(), to, between, shared.as_ptr(), self.numbers.as_ptr()) };
        let Some(first) = exceptions.map(|vector| vector * width) else { return 0 };
        let rows = room[first..first + width].iter().enumerate();
        rows.fold(0, |all, (k, number)| all | u32::from(number.to_bits() != 0) << k)
    }
}

#[cfg(target_arch = "x86_64")]
impl fmt::Debug for MachineLanes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("MachineLanes").field("width", &self.extent.width).finish_non_exhaustive()
    }
}

/// Calls a function of one number lane by lane, for code in lanes: the arguments are the first vector of the room,
/// which the results replace.
///
/// # Safety
/// There are `width` numbers in the room; the function has one of the numbers of [`functions::UNARY`].
#[cfg(target_arch = "x86_64")]
pub unsafe extern "sysv64" fn unary_lanes(room: *mut f64, width: usize, function: usize, _: u64) {
    // SAFETY: only code of this crate calls it, with its room, which nothing else reads or writes meanwhile.
    let lanes = unsafe { slice::from_raw_parts_mut(room, width) };
    let function = functions::unary(functions::UNARY[function]);
    lanes.iter_mut().for_each(|x| *x = function(*x));
}

/// The same of two numbers, by the first two vectors of the room.
///
/// # Safety
/// There are twice as many numbers; the function has one of the numbers of [`functions::BINARY`].
#[cfg(target_arch = "x86_64")]
pub unsafe extern "sysv64" fn binary_lanes(room: *mut f64, width: usize, function: usize, _: u64) {
    // SAFETY: as of `unary_lanes`.
    let lanes = unsafe { slice::from_raw_parts_mut(room, 2 * width) };
    let (first, second) = lanes.split_at_mut(width);
    let function = functions::binary(functions::BINARY[function]);
    first.iter_mut().zip(second).for_each(|(x, y)| *x = function(*x, *y));
}

/// Calls a table lane by lane, as [`table`] does, by the first three vectors of the room.
///
/// # Safety
/// There are three times as many numbers; the address is that of a table that lives over the call.
#[cfg(target_arch = "x86_64")]
pub unsafe extern "sysv64" fn table_lanes(room: *mut f64, width: usize, address: *const Table, orders: u64) {
    for k in 0..width {
        // SAFETY: as of `unary_lanes`, and of `table`.
        unsafe { *room.add(k) = table(address, orders, *room.add(k), *room.add(width + k), *room.add(2 * width + k)) };
    }
}
