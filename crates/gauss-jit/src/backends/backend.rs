//! The two traits of whatever carries programs out.

use std::fmt::Debug;

use gauss_codegen::program::Program;

use crate::tables::Tables;

/// A way to carry out programs.
///
/// All ways round alike: products are fused with sums where the processor has an instruction for that; sines and other
/// functions, and tables, are the runtime's. So each gives the same bits.
pub trait Backend: Debug + Send + Sync {
    /// The program, ready to be called, with the tables that it calls; `None` where this way is not open: the
    /// interpreter is taken then, whose tables are NaN where their numbers are not given.
    fn compile(&self, program: &Program, tables: &Tables) -> Option<Box<dyn Compiled>>;

    /// The program for several rows of numbers at once, in vectors; `None` where this way has none.
    fn compile_lanes(&self, _program: &Program, _tables: &Tables) -> Option<Box<dyn CompiledLanes>> {
        None
    }
}

/// A program that can be called, by any number of threads at once.
pub trait Compiled: Debug + Send + Sync {
    /// Writes the outputs, result by result.
    ///
    /// # Panics
    /// Lists whose lengths are not those of the program panic.
    fn run(&self, arguments: &[&[f64]], outputs: &mut [f64]);

    /// Whether it is machine code.
    fn is_machine_code(&self) -> bool;
}

/// A program for as many rows as vectors have places, that can be called by any number of threads at once.
///
/// Number `i` of row `k` is number `i · width + k` of a list: inputs are those of all arguments behind the first, whose
/// numbers all rows share.
pub trait CompiledLanes: Debug + Send + Sync {
    /// Number of rows.
    fn width(&self) -> usize;

    /// Count of the numbers of memory that it writes in between.
    fn room(&self) -> usize;

    /// Writes the outputs, with the bits that each row gets alone, but those of the rows in the result, bit `k` of row
    /// `k`: these are to be computed alone.
    ///
    /// # Panics
    /// Lists whose lengths are not those of the program panic.
    fn run(&self, shared: &[f64], inputs: &[f64], outputs: &mut [f64], room: &mut [f64]) -> u32;
}

/// The most arguments that a program has: constants, time, configuration, speeds, and at most four more.
pub const MOST_ARGUMENTS: usize = 8;
