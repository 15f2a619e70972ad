//! The interpreter: a program run on any numbers.

use crate::algebra::{OwnFunction, Scalar};

use super::code::Code;
use super::instruction::{Instruction, Operand};

/// The result of an instruction.
enum InstructionResult<T> {
    One(T),
    /// Sine and cosine.
    Pair(T, T),
}

impl<S: Copy> Code<S> {
    /// Carries out the instructions; `input` gives the value of every input. Products are rounded before anything is
    /// added to them. Functions of the user's own are NaN.
    ///
    /// # Panics
    /// Of code that [`Code::verify`] refuses.
    pub fn evaluate<T: Scalar>(&self, input: impl Fn(S) -> T) -> Vec<T> {
        self.evaluate_with(input, |_, _| T::number(f64::NAN))
    }

    /// The same; `own` gives the values of functions of the user's own.
    ///
    /// # Panics
    /// Of code that [`Code::verify`] refuses.
    pub fn evaluate_with<T: Scalar>(&self, input: impl Fn(S) -> T, own: impl Fn(OwnFunction, &[T]) -> T) -> Vec<T> {
        let mut results: Vec<InstructionResult<T>> = Vec::with_capacity(self.instructions.len());
        let get = |operand: Operand<S>, results: &[InstructionResult<T>]| match operand {
            Operand::Input(symbol) => input(symbol),
            Operand::Number(value) => T::fraction(value),
            Operand::Value(k) | Operand::Sine(k) => match &results[k] {
                InstructionResult::One(value) | InstructionResult::Pair(value, _) => value.clone(),
            },
            Operand::Cosine(k) => match &results[k] {
                InstructionResult::One(value) | InstructionResult::Pair(_, value) => value.clone(),
            },
        };
        for instruction in &self.instructions {
            let at = |operand: Operand<S>| get(operand, &results);
            let value = match *instruction {
                Instruction::Add(a, b) => at(a) + at(b),
                Instruction::Subtract(a, b) => at(a) - at(b),
                Instruction::Multiply(a, b) => at(a) * at(b),
                Instruction::MultiplyAdd(a, b, c) => at(a) * at(b) + at(c),
                Instruction::MultiplySubtract(a, b, c) => at(c) - at(a) * at(b),
                Instruction::Divide(a, b) => at(a) / at(b),
                Instruction::Negate(a) => -at(a),
                Instruction::SineCosine(a) => {
                    let (sine, cosine) = at(a).sine_cosine();
                    results.push(InstructionResult::Pair(sine, cosine));
                    continue;
                }
                Instruction::Call(function, a) => at(a).call(function),
                Instruction::Binary(function, a, b) => at(a).call_with(function, at(b)),
                Instruction::Own(function, arguments) => {
                    own(function, &function.of(&arguments).iter().map(|&a| at(a)).collect::<Vec<T>>())
                }
            };
            results.push(InstructionResult::One(value));
        }
        self.outputs.iter().map(|&output| get(output, &results)).collect()
    }
}
