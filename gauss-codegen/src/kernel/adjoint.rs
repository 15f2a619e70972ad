//! Gradients of programs with one output: backward differentiation, instruction by instruction. All derivatives of one
//! number cost a few times the number, however many there are; second derivatives are tangents of these.

use crate::algebra::{BinaryFunction, Function, Map, Rational};
use crate::derivatives::Direction;

use super::tangent::{InstructionWriter, Rate, Tangent, TangentPass};
use super::write::{Operand, Operation, Program};

/// The derivatives of the only output of a program along each of the directions, as a program that reads what that one
/// read, and the rates.
pub fn gradient<'g>(program: &Program<'g>, directions: &[Direction<'g>]) -> Program<'g> {
    let mut writer = InstructionWriter::default();
    let none = Map::default();
    let (places, _) = writer.copy(program, &none);
    let mut sweep = Sweep {
        pass: TangentPass::new(&mut writer, program, &none, &places),
        of_symbols: Map::default(),
        of_instructions: vec![None; program.instructions.len()],
    };
    sweep.run();
    let outputs = directions.iter().map(|direction| sweep.along(direction)).collect();
    writer.finish(outputs)
}

/// The derivatives of the output by all that it is made of, last instruction first.
struct Sweep<'a, 'g> {
    pass: TangentPass<'a, 'g>,
    of_symbols: Map<u32, Rate<'g>>,
    /// Derivatives by the instructions; of sines and cosines by the angle.
    of_instructions: Vec<Rate<'g>>,
}

impl<'g> Sweep<'_, 'g> {
    fn run(&mut self) {
        let program = self.pass.program;
        let one = Tangent { negative: false, value: Operand::Number(Rational::one()) };
        self.add(program.outputs[0], Some(one), one);
        for k in (0..program.instructions.len()).rev() {
            let own = self.of_instructions[k];
            if own.is_some() {
                self.instruction(k, own);
            }
        }
    }

    fn along(&mut self, direction: &Direction<'g>) -> Operand<'g> {
        let mut sum = None;
        for (symbol, rate) in direction {
            let slope = self.of_symbols.get(&symbol.key()).copied().flatten();
            if let Some(rate) = self.pass.rate_of_symbol(*rate) {
                sum = self.pass.writer.times_plus(signed(slope, rate), rate.value, sum);
            }
        }
        sum.map_or(Operand::Number(Rational::zero()), |sum| self.pass.writer.written(sum))
    }

    /// Adds a part of the derivative by an operand: the slope of its reader, times that of the reader by the operand.
    fn add(&mut self, operand: Operand<'g>, slope: Rate<'g>, by: Tangent<'g>) {
        let slope = signed(slope, by);
        match operand {
            Operand::Number(_) => {}
            Operand::Input(e) => {
                let sum = self.of_symbols.get(&e.key()).copied().flatten();
                let sum = self.pass.writer.times_plus(slope, by.value, sum);
                self.of_symbols.insert(e.key(), sum);
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

    fn instruction(&mut self, k: usize, slope: Rate<'g>) {
        let own = Operand::Value(self.pass.places[k]);
        let plain = |value: Operand<'g>| Tangent { negative: false, value };
        let one = plain(Operand::Number(Rational::one()));
        match self.pass.program.instructions[k] {
            Operation::Add(a, b) => {
                self.add(a, slope, one);
                self.add(b, slope, one);
            }
            Operation::Subtract(a, b) => {
                self.add(a, slope, one);
                self.add(b, slope, one.negated());
            }
            Operation::Multiply(a, b) => self.product([a, b], slope),
            Operation::MultiplyAdd(a, b, c) => {
                self.add(c, slope, one);
                self.product([a, b], slope);
            }
            Operation::MultiplySubtract(a, b, c) => {
                self.add(c, slope, one);
                self.product([a, b], slope.map(Tangent::negated));
            }
            // By b it is −(a/b)/b.
            Operation::Divide(a, b) => {
                let below = self.pass.here(b);
                let reciprocal = self.pass.writer.reciprocal(below);
                let slope = self.pass.writer.times(slope, reciprocal);
                self.add(a, slope, one);
                self.add(b, slope, plain(own).negated());
            }
            Operation::Negate(a) => self.add(a, slope, one.negated()),
            Operation::SineCosine(a) => self.add(a, slope, one),
            Operation::Call(function, a) => {
                if let Some(by) = self.pass.slope(function, a, own) {
                    self.add(a, slope, plain(by));
                }
            }
            Operation::Binary(function, a, b) => {
                for (operand, by) in [a, b].into_iter().zip(self.slopes(function, [a, b], own)) {
                    self.add(operand, slope, by);
                }
            }
            Operation::Own(function, arguments) => {
                for (k, &argument) in function.of(&arguments).iter().enumerate() {
                    let by = self.pass.own_slope(function, &arguments, k);
                    self.add(argument, slope, plain(by));
                }
            }
        }
    }

    /// The derivatives of a function of two numbers by the one and the other.
    fn slopes(&mut self, function: BinaryFunction, operands: [Operand<'g>; 2], own: Operand<'g>) -> [Tangent<'g>; 2] {
        let [a, b] = operands.map(|operand| self.pass.here(operand));
        let writer = &mut *self.pass.writer;
        let values = match function {
            // Of atan2(y, x), x and −y over x² + y².
            BinaryFunction::Atan2 => {
                let square = writer.multiplied(a, a);
                let square = writer.push(Operation::MultiplyAdd(b, b, square));
                let reciprocal = writer.reciprocal(square);
                [writer.multiplied(b, reciprocal), writer.multiplied(a, reciprocal)]
            }
            BinaryFunction::Powf => {
                let less = writer.push(Operation::Subtract(b, Operand::Number(Rational::one())));
                let power = writer.push(Operation::Binary(BinaryFunction::Powf, a, less));
                // Of 0 the power is 0, which the logarithm must not spoil.
                let tiny = writer.least();
                let least = writer.push(Operation::Binary(BinaryFunction::Max, a, tiny));
                let logarithm = writer.push(Operation::Call(Function::Ln, least));
                [writer.multiplied(b, power), writer.multiplied(own, logarithm)]
            }
            BinaryFunction::Min | BinaryFunction::Max => self.pass.shares(function, a, b),
        };
        let [by_first, by_second] = values.map(|value| Tangent { negative: false, value });
        let turns = function == BinaryFunction::Atan2;
        [by_first, if turns { by_second.negated() } else { by_second }]
    }

    fn product(&mut self, [a, b]: [Operand<'g>; 2], slope: Rate<'g>) {
        let [first, second] = [a, b].map(|operand| Tangent { negative: false, value: self.pass.here(operand) });
        self.add(a, slope, second);
        self.add(b, slope, first);
    }
}

/// A derivative with the sign of what it is multiplied by.
fn signed<'g>(slope: Rate<'g>, by: Tangent<'g>) -> Rate<'g> {
    if by.negative { slope.map(Tangent::negated) } else { slope }
}
