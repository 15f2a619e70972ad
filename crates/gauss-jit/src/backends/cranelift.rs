//! Machine code by Cranelift: one function for each program, made when it is first called.
//!
//! A function reads its arguments where it needs them, computes everything, and then writes the results. Angles that
//! are arguments come first: their sines and cosines are one call of the runtime.

use std::sync::Arc;

use cranelift_codegen::Context;
use cranelift_codegen::ir::types::{F64, I64};
use cranelift_codegen::ir::{
    AbiParam, FuncRef, InstBuilder, MemFlags, Signature, StackSlot, StackSlotData, StackSlotKind, Type, Value,
};
use cranelift_codegen::isa::OwnedTargetIsa;
use cranelift_codegen::settings::{self, Configurable};
use cranelift_frontend::{FunctionBuilder, FunctionBuilderContext};
use cranelift_jit::{JITBuilder, JITModule};
use cranelift_module::{Linkage, Module, default_libcall_names};

use gauss_codegen::program::{Function, Input, Instruction, MOST_VARIABLES, Operand, OwnFunction, Program};

use super::backend::{Backend, Compiled, CompiledLanes, MOST_ARGUMENTS};
use super::functions::{BINARY, UNARY, binary, is_fused, unary};
use super::lanes;
use super::machine::{self, MachineCode};
use crate::tables::Tables;

/// Effort with which Cranelift tries to keep values in registers. Its optimiser is left out: it undoes the order of
/// statements.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum Effort {
    /// One pass over the code: the shortest time until the first call.
    Quick,
    /// Registers are assigned with backtracking: code that runs in three quarters of the time, and takes some ten times
    /// as long to make. Programs of more than 10,000 instructions are made in one pass all the same: backtracking takes
    /// longer than in proportion, 18 s where one pass takes 0.1.
    #[default]
    Thorough,
}

/// Instructions of the longest program whose registers are assigned with backtracking.
const LONGEST: usize = 10_000;

/// Machine code by Cranelift.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cranelift {
    /// Effort to keep values in registers.
    pub effort: Effort,
}

impl Backend for Cranelift {
    fn compile(&self, program: &Program, tables: &Tables) -> Option<Box<dyn Compiled>> {
        // Its fields can be written by anyone, and code reads what they name.
        program.verify().ok()?;
        let code = self.machine_code(program, tables)?;
        Some(Box::new(code))
    }

    fn compile_lanes(&self, program: &Program, tables: &Tables) -> Option<Box<dyn CompiledLanes>> {
        [8, 4].into_iter().find_map(|width| self.lanes(program, tables, width))
    }
}

impl Cranelift {
    /// The program for four rows (AVX2) or eight (AVX-512) at once; `None` for other counts and where the processor has
    /// no such vectors. Registers are assigned by code of this crate, since Cranelift has vectors of two numbers.
    #[must_use]
    pub fn lanes(&self, program: &Program, tables: &Tables, width: usize) -> Option<Box<dyn CompiledLanes>> {
        program.verify().ok()?;
        let module = || Some(JITModule::new(JITBuilder::with_isa(self.target(0)?, default_libcall_names())));
        lanes::compiled(program, tables, width, module)
    }

    /// `None` for processors that Cranelift does not know, or where executable memory is refused.
    fn machine_code(self, program: &Program, tables: &Tables) -> Option<MachineCode> {
        let mut builder = JITBuilder::with_isa(self.target(program.code.instructions.len())?, default_libcall_names());
        declare_symbols(&mut builder);
        let mut module = JITModule::new(builder);
        let mut context = module.make_context();
        let pointer = module.target_config().pointer_type();
        context.func.signature.params = vec![AbiParam::new(pointer), AbiParam::new(pointer)];
        Writer::write(program, tables, &mut module, &mut context)?;
        let signature = context.func.signature.clone();
        let id = module.declare_function("program", Linkage::Export, &signature).ok()?;
        let made = module.define_function(id, &mut context).is_ok() && module.finalize_definitions().is_ok();
        let counts = program.arguments.iter().map(|argument| argument.components.len()).collect();
        machine::code(module, made.then_some(id), (counts, program.code.outputs.len()), tables)
    }

    /// The processor that this runs on, for a program of so many instructions.
    fn target(self, length: usize) -> Option<OwnedTargetIsa> {
        let mut flags = settings::builder();
        let is_quick = self.effort == Effort::Quick || length > LONGEST;
        let registers = if is_quick { "single_pass" } else { "backtracking" };
        let wanted = [
            ("opt_level", "none"),
            ("regalloc_algorithm", registers),
            ("enable_verifier", if cfg!(debug_assertions) { "true" } else { "false" }),
            ("is_pic", "false"),
            ("use_colocated_libcalls", "false"),
        ];
        wanted.iter().try_for_each(|(name, value)| flags.set(name, value)).ok()?;
        let isa = cranelift_native::builder().ok()?;
        isa.finish(settings::Flags::new(flags)).ok()
    }
}

const SINES: &str = "sines_and_cosines";
const TABLE: &str = "table";

fn declare_symbols(builder: &mut JITBuilder) {
    builder.symbol(SINES, machine::sines_and_cosines as *const u8);
    builder.symbol(TABLE, machine::table as *const u8);
    UNARY.iter().for_each(|function| {
        builder.symbol(function.name(), unary(*function) as *const u8);
    });
    BINARY.iter().for_each(|function| {
        builder.symbol(function.name(), binary(*function) as *const u8);
    });
}

/// A program as far as it has been written.
struct Writer<'a, 'b> {
    program: &'a Program,
    tables: &'a Tables,
    builder: FunctionBuilder<'b>,
    module: &'a mut JITModule,
    /// Addresses of the numbers of each argument.
    arguments: Vec<Value>,
    results: Vec<Computed>,
    functions: Vec<(&'static str, FuncRef)>,
    is_fused: bool,
}

/// Place of the result of an instruction.
#[derive(Clone, Copy)]
enum Computed {
    Value(Value),
    /// Sine and cosine, from that byte of the frame on: read where they are used, so that they hold no registers.
    Pair(StackSlot, i32),
}

impl Writer<'_, '_> {
    fn write(program: &Program, tables: &Tables, module: &mut JITModule, context: &mut Context) -> Option<()> {
        if program.arguments.len() > MOST_ARGUMENTS {
            return None;
        }
        let mut memory = FunctionBuilderContext::new();
        let mut builder = FunctionBuilder::new(&mut context.func, &mut memory);
        let block = builder.create_block();
        builder.append_block_params_for_function_params(block);
        builder.switch_to_block(block);
        builder.seal_block(block);
        let [lists, outputs] = [0, 1].map(|k| builder.block_params(block)[k]);
        let pointer = module.target_config().pointer_type();
        let size = pointer.bytes() as i32;
        let places = 0..program.arguments.len() as i32;
        let arguments = places.map(|k| builder.ins().load(pointer, trusted(), lists, size * k)).collect();
        let count = program.code.instructions.len();
        let unwritten = builder.ins().f64const(f64::NAN);
        let (results, functions) = (vec![Computed::Value(unwritten); count], Vec::new());
        let is_fused = is_fused();
        let mut writer = Writer { program, tables, builder, module, arguments, results, functions, is_fused };
        writer.instructions()?;
        // Everything is computed before anything is written.
        let values: Vec<Value> = program.code.outputs.iter().map(|&output| writer.value(output)).collect();
        for (k, value) in values.into_iter().enumerate() {
            writer.builder.ins().store(trusted(), value, outputs, 8 * k as i32);
        }
        writer.builder.ins().return_(&[]);
        writer.builder.finalize();
        Some(())
    }

    fn instructions(&mut self) -> Option<()> {
        let instructions = &self.program.code.instructions;
        let of_input = |k: &usize| matches!(instructions[*k], Instruction::SineCosine(Operand::Input(_)));
        let first: Vec<usize> = (0..instructions.len()).filter(of_input).collect();
        self.sines_and_cosines(&first)?;
        for (k, instruction) in instructions.iter().enumerate() {
            match *instruction {
                Instruction::SineCosine(Operand::Input(_)) => {}
                Instruction::SineCosine(_) => self.sines_and_cosines(&[k])?,
                ref other => self.results[k] = Computed::Value(self.result(other)?),
            }
        }
        Some(())
    }

    /// Sines and cosines of the angles of these instructions, by one call.
    fn sines_and_cosines(&mut self, instructions: &[usize]) -> Option<()> {
        if instructions.is_empty() {
            return Some(());
        }
        let count = instructions.len() as i32;
        let mut slot = |numbers: i32| {
            let data = StackSlotData::new(StackSlotKind::ExplicitSlot, 8 * numbers as u32, 3);
            self.builder.create_sized_stack_slot(data)
        };
        let (angles, pairs) = (slot(count), slot(2 * count));
        for (place, &k) in instructions.iter().enumerate() {
            let Instruction::SineCosine(angle) = self.program.code.instructions[k] else { return None };
            let angle = self.value(angle);
            self.builder.ins().stack_store(angle, angles, 8 * place as i32);
        }
        let pointer = self.module.target_config().pointer_type();
        let function = self.function(SINES, &[pointer, I64, pointer], false)?;
        let ins = |builder: &mut FunctionBuilder<'_>, slot| builder.ins().stack_addr(pointer, slot, 0);
        let (from, to) = (ins(&mut self.builder, angles), ins(&mut self.builder, pairs));
        let count = self.builder.ins().iconst(I64, i64::from(count));
        self.builder.ins().call(function, &[from, count, to]);
        for (place, &k) in instructions.iter().enumerate() {
            self.results[k] = Computed::Pair(pairs, 16 * place as i32);
        }
        Some(())
    }

    /// A function of the runtime, which is declared when it is first called.
    fn function(&mut self, name: &'static str, parameters: &[Type], gives: bool) -> Option<FuncRef> {
        if let Some((_, known)) = self.functions.iter().find(|(known, _)| *known == name) {
            return Some(*known);
        }
        let mut signature: Signature = self.module.make_signature();
        signature.params.extend(parameters.iter().map(|ty| AbiParam::new(*ty)));
        signature.returns.extend(gives.then(|| AbiParam::new(F64)));
        let id = self.module.declare_function(name, Linkage::Import, &signature).ok()?;
        let function = self.module.declare_func_in_func(id, self.builder.func);
        self.functions.push((name, function));
        Some(function)
    }

    fn value(&mut self, operand: Operand) -> Value {
        match operand {
            Operand::Input(Input::Component { argument, component }) => {
                let list = self.arguments[argument];
                self.builder.ins().load(F64, trusted().with_readonly(), list, 8 * component as i32)
            }
            Operand::Input(Input::Number(number)) => self.builder.ins().f64const(self.program.numbers[number]),
            Operand::Number(value) => self.builder.ins().f64const(value.to_f64()),
            Operand::Value(k) | Operand::Sine(k) => self.computed(k, 0),
            Operand::Cosine(k) => self.computed(k, 8),
        }
    }

    fn computed(&mut self, k: usize, part: i32) -> Value {
        match self.results[k] {
            Computed::Value(value) => value,
            Computed::Pair(slot, place) => self.builder.ins().stack_load(F64, slot, place + part),
        }
    }

    fn result(&mut self, instruction: &Instruction) -> Option<Value> {
        let of = |writer: &mut Self, operands: [Operand; 2]| operands.map(|operand| writer.value(operand));
        Some(match *instruction {
            Instruction::Add(a, b) => {
                let [a, b] = of(self, [a, b]);
                self.builder.ins().fadd(a, b)
            }
            Instruction::Subtract(a, b) => {
                let [a, b] = of(self, [a, b]);
                self.builder.ins().fsub(a, b)
            }
            Instruction::Multiply(a, b) => {
                let [a, b] = of(self, [a, b]);
                self.builder.ins().fmul(a, b)
            }
            Instruction::Divide(a, b) => {
                let [a, b] = of(self, [a, b]);
                self.builder.ins().fdiv(a, b)
            }
            Instruction::MultiplyAdd(a, b, c) => {
                let ([a, b], c) = (of(self, [a, b]), self.value(c));
                self.sum(a, b, c)
            }
            Instruction::MultiplySubtract(a, b, c) => {
                let ([a, b], c) = (of(self, [a, b]), self.value(c));
                if self.is_fused {
                    let a = self.builder.ins().fneg(a);
                    self.builder.ins().fma(a, b, c)
                } else {
                    let product = self.builder.ins().fmul(a, b);
                    self.builder.ins().fsub(c, product)
                }
            }
            Instruction::Negate(a) => {
                let a = self.value(a);
                self.builder.ins().fneg(a)
            }
            Instruction::Call(function, a) => {
                let a = self.value(a);
                self.call(function, a)?
            }
            Instruction::Binary(function, a, b) => {
                let arguments = of(self, [a, b]);
                let function = self.function(function.name(), &[F64, F64], true)?;
                let call = self.builder.ins().call(function, &arguments);
                self.builder.inst_results(call)[0]
            }
            Instruction::Own(function, arguments) => self.table(function, arguments)?,
            // Pairs are written together.
            Instruction::SineCosine(_) => return None,
        })
    }

    /// A call of a table, which lives as long as the code: this holds it too.
    fn table(&mut self, function: OwnFunction, arguments: [Operand; MOST_VARIABLES]) -> Option<Value> {
        let table = Arc::as_ptr(self.tables.get(function)?) as i64;
        let [first, second, third] = function.orders;
        let orders = i64::from_le_bytes([first, second, third, 0, 0, 0, 0, 0]);
        let pointer = self.module.target_config().pointer_type();
        let called = self.function(TABLE, &[pointer, I64, F64, F64, F64], true)?;
        let [x, y, z] = arguments.map(|own| self.value(own));
        let [table, orders] =
            [(pointer, table), (I64, orders)].map(|(ty, number)| self.builder.ins().iconst(ty, number));
        let call = self.builder.ins().call(called, &[table, orders, x, y, z]);
        Some(self.builder.inst_results(call)[0])
    }

    fn sum(&mut self, a: Value, b: Value, c: Value) -> Value {
        if self.is_fused {
            self.builder.ins().fma(a, b, c)
        } else {
            let product = self.builder.ins().fmul(a, b);
            self.builder.ins().fadd(product, c)
        }
    }

    fn call(&mut self, function: Function, a: Value) -> Option<Value> {
        Some(match function {
            Function::Sqrt => self.builder.ins().sqrt(a),
            Function::Abs => self.builder.ins().fabs(a),
            _ => {
                let function = self.function(function.name(), &[F64], true)?;
                let call = self.builder.ins().call(function, &[a]);
                self.builder.inst_results(call)[0]
            }
        })
    }
}

/// Flags of memory that is aligned and there.
fn trusted() -> MemFlags {
    MemFlags::trusted()
}
