//! Programs whose products are fused with sums → steps.

use gauss_codegen::program::{Function, Input, Instruction, Operand, Program};

use super::sines::{SIGN, sine_and_cosine};
use super::steps::{Callee, LaneOperand, Operation, Steps};

/// The steps of a program. All rows share the numbers of its first argument.
pub fn lowered(program: &Program) -> Steps {
    let mut first_inputs = vec![0; 2];
    for argument in program.arguments.iter().skip(1) {
        first_inputs.push(first_inputs[first_inputs.len() - 1] + argument.components.len());
    }
    let mut lowering = Lowering { program, first_inputs, steps: Steps::default(), results: Vec::new() };
    for instruction in &program.code.instructions {
        let result = lowering.result(instruction);
        lowering.results.push(result);
    }
    lowering.steps.outputs = program.code.outputs.iter().map(|output| lowering.place(*output)).collect();
    lowering.steps
}

struct Lowering<'a> {
    program: &'a Program,
    /// The place of the first number of each argument among those of a row.
    first_inputs: Vec<usize>,
    steps: Steps,
    /// Results of instructions so far, of pairs both.
    results: Vec<[LaneOperand; 2]>,
}

impl Lowering<'_> {
    fn place(&mut self, operand: Operand) -> LaneOperand {
        match operand {
            Operand::Input(Input::Component { argument: 0, component }) => LaneOperand::Constant(component),
            Operand::Input(Input::Component { argument, component }) => {
                LaneOperand::Input(self.first_inputs[argument] + component)
            }
            Operand::Input(Input::Number(number)) => self.steps.number(self.program.numbers[number]),
            Operand::Number(value) => self.steps.number(value.to_f64()),
            Operand::Value(k) | Operand::Sine(k) => self.results[k][0],
            Operand::Cosine(k) => self.results[k][1],
        }
    }

    fn result(&mut self, instruction: &Instruction) -> [LaneOperand; 2] {
        let operands: Vec<LaneOperand> = match *instruction {
            // Tables take three numbers, whatever they depend on.
            Instruction::Own(_, operands) => operands.iter().map(|operand| self.place(*operand)).collect(),
            _ => instruction.operands().map(|operand| self.place(operand)).collect(),
        };
        let operation = match *instruction {
            Instruction::SineCosine(_) => return sine_and_cosine(&mut self.steps, operands[0]),
            Instruction::Add(..) => Operation::Add,
            Instruction::Subtract(..) => Operation::Subtract,
            Instruction::Multiply(..) => Operation::Multiply,
            Instruction::Divide(..) => Operation::Divide,
            Instruction::MultiplyAdd(..) => Operation::MultiplyAdd,
            Instruction::MultiplySubtract(..) => Operation::MultiplySubtract,
            Instruction::Call(Function::Sqrt, _) => Operation::Root,
            Instruction::Call(Function::Abs, _) => {
                let rest = self.steps.bits(!SIGN);
                return [self.steps.step(Operation::And, &[operands[0], rest]); 2];
            }
            Instruction::Negate(_) => {
                let sign = self.steps.bits(SIGN);
                return [self.steps.step(Operation::Xor, &[operands[0], sign]); 2];
            }
            Instruction::Call(function, _) => Operation::Call(Callee::Unary(function)),
            Instruction::Binary(function, ..) => Operation::Call(Callee::Binary(function)),
            Instruction::Own(function, _) => Operation::Call(Callee::Table(function)),
        };
        [self.steps.step(operation, &operands); 2]
    }
}
