//! Code in lanes for x86-64: a program for four rows at once in vectors of AVX2, or for eight in those of AVX-512.
//!
//! `lowering` turns a program into `steps`, sines and cosines by `sines`; `registers` writes them by `assembler`. The
//! program is that of one row, instruction by instruction, so that each row gets the bits that it gets alone.

mod assembler;
mod lowering;
mod registers;
mod sines;
mod steps;

use std::sync::Arc;

use cranelift_jit::JITModule;
use cranelift_module::{Linkage, Module};
use gauss_codegen::program::Program;

use super::backend::CompiledLanes;
use super::functions::{BINARY, UNARY};
use super::machine::{self, Extent};
use crate::tables::Tables;
use assembler::Width;
use registers::{Address, EXCEPTIONS, assembled};
use steps::Callee;

/// The program for so many rows at once, if the processor has vectors for them; `module` has memory for its code.
pub fn compiled(
    program: &Program,
    tables: &Tables,
    width: usize,
    module: impl FnOnce() -> Option<JITModule>,
) -> Option<Box<dyn CompiledLanes>> {
    let width = width_of(width)?;
    let steps = lowering::lowered(program);
    let code = assembled(&steps, width, |callee| address(callee, tables))?;
    let mut counts = program.arguments.iter().map(|argument| argument.components.len());
    let extent = Extent {
        width: width.count(),
        shared: counts.next().unwrap_or_default(),
        inputs: counts.sum(),
        outputs: steps.outputs.len(),
        room: code.room,
        exceptions: steps.exceptions.map(|_| EXCEPTIONS),
    };
    let mut module = module()?;
    let id = module.declare_function("lanes", Linkage::Export, &module.make_signature()).ok()?;
    let made = module.define_function_bytes(id, 64, &code.bytes, &[]).is_ok() && module.finalize_definitions().is_ok();
    let lanes = machine::lanes(module, made.then_some(id), (extent, steps.numbers), tables)?;
    Some(Box::new(lanes))
}

/// Vectors for so many rows that the processor has, with products that are fused with sums as elsewhere.
fn width_of(rows: usize) -> Option<Width> {
    let is_fused = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
    match rows {
        4 if is_fused => Some(Width::Four),
        8 if is_fused && is_x86_feature_detected!("avx512f") => Some(Width::Eight),
        _ => None,
    }
}

/// The function that a step calls, and the numbers that it is given.
fn address(callee: Callee, tables: &Tables) -> Option<Address> {
    Some(match callee {
        Callee::Unary(function) => {
            let place = UNARY.iter().position(|own| *own == function)?;
            (machine::unary_lanes as *const () as u64, [place as u64, 0])
        }
        Callee::Binary(function) => {
            let place = BINARY.iter().position(|own| *own == function)?;
            (machine::binary_lanes as *const () as u64, [place as u64, 0])
        }
        Callee::Table(function) => {
            let table = Arc::as_ptr(tables.get(function)?) as u64;
            let [first, second, third] = function.orders;
            let orders = u64::from_le_bytes([first, second, third, 0, 0, 0, 0, 0]);
            (machine::table_lanes as *const () as u64, [table, orders])
        }
    })
}
