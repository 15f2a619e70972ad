//! The interpreter, which is always there.

use gauss_codegen::program::{Code, Input, Instruction, Operand, Program};
use gauss_runtime::prelude::Real;

use super::backend::{Backend, Compiled};
use super::functions::{binary, is_fused, unary};
use crate::tables::Tables;

/// Carries programs out instruction by instruction.
#[derive(Clone, Copy, Debug, Default)]
pub struct Interpreter;

impl Backend for Interpreter {
    fn compile(&self, program: &Program, tables: &Tables) -> Option<Box<dyn Compiled>> {
        Some(Box::new(interpreted(program, tables)))
    }
}

/// The same, which is never refused.
pub fn interpreted(program: &Program, tables: &Tables) -> Interpreted {
    let (code, numbers, tables) = (program.code.clone(), program.numbers.clone(), tables.clone());
    Interpreted { code, numbers, tables, is_fused: is_fused() }
}

#[derive(Debug)]
pub struct Interpreted {
    code: Code,
    numbers: Vec<f64>,
    tables: Tables,
    is_fused: bool,
}

impl Compiled for Interpreted {
    fn run(&self, arguments: &[&[f64]], outputs: &mut [f64]) {
        // Of each instruction its result, of pairs both.
        let mut results: Vec<[f64; 2]> = Vec::with_capacity(self.code.instructions.len());
        for instruction in &self.code.instructions {
            let result = self.result(instruction, |operand| self.value(operand, arguments, &results));
            results.push(result);
        }
        for (output, operand) in outputs.iter_mut().zip(&self.code.outputs) {
            *output = self.value(*operand, arguments, &results);
        }
    }

    fn is_machine_code(&self) -> bool {
        false
    }
}

impl Interpreted {
    fn value(&self, operand: Operand, arguments: &[&[f64]], results: &[[f64; 2]]) -> f64 {
        match operand {
            Operand::Input(Input::Component { argument, component }) => arguments[argument][component],
            Operand::Input(Input::Number(number)) => self.numbers[number],
            Operand::Number(value) => value.to_f64(),
            Operand::Value(k) | Operand::Sine(k) => results[k][0],
            Operand::Cosine(k) => results[k][1],
        }
    }

    fn result(&self, instruction: &Instruction, at: impl Fn(Operand) -> f64) -> [f64; 2] {
        let value = match *instruction {
            Instruction::Add(a, b) => at(a) + at(b),
            Instruction::Subtract(a, b) => at(a) - at(b),
            Instruction::Multiply(a, b) => at(a) * at(b),
            Instruction::MultiplyAdd(a, b, c) if self.is_fused => at(a).mul_add(at(b), at(c)),
            Instruction::MultiplyAdd(a, b, c) => at(a) * at(b) + at(c),
            Instruction::MultiplySubtract(a, b, c) if self.is_fused => (-at(a)).mul_add(at(b), at(c)),
            Instruction::MultiplySubtract(a, b, c) => at(c) - at(a) * at(b),
            Instruction::Divide(a, b) => at(a) / at(b),
            Instruction::Negate(a) => -at(a),
            Instruction::SineCosine(a) => return Real::sin_cos(at(a)).into(),
            Instruction::Call(function, a) => unary(function)(at(a)),
            Instruction::Binary(function, a, b) => binary(function)(at(a), at(b)),
            // Models whose equations call functions of Rust, or tables without numbers, have no kernels.
            Instruction::Own(function, arguments) => self.tables.value(function, arguments.map(at)).unwrap_or(f64::NAN),
        };
        [value, 0.0]
    }
}
