//! Backward differentiation, instruction by instruction: all derivatives of one number cost a few times the number,
//! however many there are.

use crate::algebra::{BinaryFunction, Function, Key, Map, Rational};
use crate::program::{Instruction, Operand};

use super::forward::TangentPass;
use super::writer::{Rate, Tangent};

/// The derivatives of a sum of outputs by all that they are made of, last instruction first.
pub(crate) struct Sweep<'a, S> {
    pub(crate) pass: TangentPass<'a, S>,
    pub(crate) of_symbols: Map<S, Rate<S>>,
    /// Derivatives by the instructions; of sines and cosines by the angle.
    of_instructions: Vec<Rate<S>>,
}

impl<'a, S: Copy + Key> Sweep<'a, S> {
    pub(crate) fn new(pass: TangentPass<'a, S>) -> Self {
        let of_instructions = vec![None; pass.program.instructions.len()];
        Self { pass, of_symbols: Map::default(), of_instructions }
    }

    /// Goes back from the outputs, each with its weight in the sum that is differentiated.
    pub(crate) fn run(&mut self, weights: &[Rate<S>]) {
        let program = self.pass.program;
        let one = Tangent { negative: false, value: Operand::Number(Rational::one()) };
        for (output, weight) in program.outputs.iter().zip(weights) {
            self.add(*output, *weight, one);
        }
        for k in (0..program.instructions.len()).rev() {
            let own = self.of_instructions[k];
            if own.is_some() {
                self.instruction(k, own);
            }
        }
    }

    /// Adds a part of the derivative by an operand: the slope of its reader, times that of the reader by the operand.
    fn add(&mut self, operand: Operand<S>, slope: Rate<S>, by: Tangent<S>) {
        let slope = signed(slope, by);
        match operand {
            Operand::Number(_) => {}
            Operand::Input(e) => {
                let sum = self.of_symbols.get(&e).copied().flatten();
                let sum = self.pass.writer.times_plus(slope, by.value, sum);
                self.of_symbols.insert(e, sum);
            }
            Operand::Value(k) => {
                self.of_instructions[k] = self.pass.writer.times_plus(slope, by.value, self.of_instructions[k]);
            }
            Operand::Sine(k) | Operand::Cosine(k) => {
                let place = self.pass.places[k];
                let (slope, other) = match operand {
                    Operand::Sine(_) => (slope, Operand::Cosine(place)),
                    _ => (slope.map(Tangent::negated), Operand::Sine(place)),
                };
                let slope = self.pass.writer.times(slope, by.value);
                self.of_instructions[k] = self.pass.writer.times_plus(slope, other, self.of_instructions[k]);
            }
        }
    }

    fn instruction(&mut self, k: usize, slope: Rate<S>) {
        let own = Operand::Value(self.pass.places[k]);
        let plain = |value: Operand<S>| Tangent { negative: false, value };
        let one = plain(Operand::Number(Rational::one()));
        match self.pass.program.instructions[k] {
            Instruction::Add(a, b) => {
                self.add(a, slope, one);
                self.add(b, slope, one);
            }
            Instruction::Subtract(a, b) => {
                self.add(a, slope, one);
                self.add(b, slope, one.negated());
            }
            Instruction::Multiply(a, b) => self.product([a, b], slope),
            Instruction::MultiplyAdd(a, b, c) => {
                self.add(c, slope, one);
                self.product([a, b], slope);
            }
            Instruction::MultiplySubtract(a, b, c) => {
                self.add(c, slope, one);
                self.product([a, b], slope.map(Tangent::negated));
            }
            // By b it is −(a/b)/b.
            Instruction::Divide(a, b) => {
                let below = self.pass.here(b);
                let reciprocal = self.pass.writer.reciprocal(below);
                let slope = self.pass.writer.times(slope, reciprocal);
                self.add(a, slope, one);
                self.add(b, slope, plain(own).negated());
            }
            Instruction::Negate(a) => self.add(a, slope, one.negated()),
            Instruction::SineCosine(a) => self.add(a, slope, one),
            Instruction::Call(function, a) => {
                if let Some(by) = self.pass.slope(function, a, own) {
                    self.add(a, slope, plain(by));
                }
            }
            Instruction::Binary(function, a, b) => {
                for (operand, by) in [a, b].into_iter().zip(self.slopes(function, [a, b], own)) {
                    self.add(operand, slope, by);
                }
            }
            Instruction::Own(function, arguments) => {
                for (k, &argument) in function.of(&arguments).iter().enumerate() {
                    let by = self.pass.own_slope(function, &arguments, k);
                    self.add(argument, slope, plain(by));
                }
            }
        }
    }

    /// The derivatives of a function of two numbers by the one and the other.
    fn slopes(&mut self, function: BinaryFunction, operands: [Operand<S>; 2], own: Operand<S>) -> [Tangent<S>; 2] {
        let [a, b] = operands.map(|operand| self.pass.here(operand));
        let writer = &mut *self.pass.writer;
        let values = match function {
            // Of atan2(y, x), x and −y over x² + y².
            BinaryFunction::Atan2 => {
                let square = writer.multiplied(a, a);
                let square = writer.push(Instruction::MultiplyAdd(b, b, square));
                let reciprocal = writer.reciprocal(square);
                [writer.multiplied(b, reciprocal), writer.multiplied(a, reciprocal)]
            }
            BinaryFunction::Powf => {
                let less = writer.push(Instruction::Subtract(b, Operand::Number(Rational::one())));
                let power = writer.push(Instruction::Binary(BinaryFunction::Powf, a, less));
                // Of 0 the power is 0, which the logarithm must not spoil.
                let tiny = writer.least();
                let least = writer.push(Instruction::Binary(BinaryFunction::Max, a, tiny));
                let logarithm = writer.push(Instruction::Call(Function::Ln, least));
                [writer.multiplied(b, power), writer.multiplied(own, logarithm)]
            }
            BinaryFunction::Min | BinaryFunction::Max => self.pass.shares(function, a, b),
        };
        let [by_first, by_second] = values.map(|value| Tangent { negative: false, value });
        let turns = function == BinaryFunction::Atan2;
        [by_first, if turns { by_second.negated() } else { by_second }]
    }

    fn product(&mut self, [a, b]: [Operand<S>; 2], slope: Rate<S>) {
        let [first, second] = [a, b].map(|operand| Tangent { negative: false, value: self.pass.here(operand) });
        self.add(a, slope, second);
        self.add(b, slope, first);
    }
}

/// A derivative with the sign of what it is multiplied by.
pub(crate) fn signed<S>(slope: Rate<S>, by: Tangent<S>) -> Rate<S> {
    if by.negative { slope.map(Tangent::negated) } else { slope }
}
