//! Forward differentiation, instruction by instruction: the chain rule is one rule a step, and what a step costs its
//! derivative costs two or three times.

use crate::algebra::{BinaryFunction, Function, Key, MOST_VARIABLES, Map, OwnFunction, Rational};
use crate::program::{Code, Instruction, Operand};

use super::writer::{InstructionWriter, Rate, Tangent, moved};

/// The derivatives of one program along one direction.
pub(crate) struct TangentPass<'a, S> {
    pub(crate) writer: &'a mut InstructionWriter<S>,
    pub(crate) program: &'a Code<S>,
    symbols: &'a Map<S, Operand<S>>,
    pub(crate) places: &'a [usize],
    /// Rates of symbols that move.
    pub(crate) rates: Map<S, Rate<S>>,
}

impl<'a, S: Copy + Key> TangentPass<'a, S> {
    pub(crate) fn new(
        writer: &'a mut InstructionWriter<S>,
        program: &'a Code<S>,
        symbols: &'a Map<S, Operand<S>>,
        places: &'a [usize],
    ) -> Self {
        Self { writer, program, symbols, places, rates: Map::default() }
    }

    /// Derivatives of the outputs, as operands.
    pub(crate) fn outputs(mut self) -> Vec<Operand<S>> {
        let rates = self.rates_of_outputs();
        let written = |rate: Rate<S>| match rate {
            None => Operand::Number(Rational::zero()),
            Some(tangent) => self.writer.written(tangent),
        };
        rates.into_iter().map(written).collect()
    }

    /// Derivatives of the outputs, with signs.
    pub(crate) fn tangents(mut self) -> Vec<Rate<S>> {
        self.rates_of_outputs()
    }

    fn rates_of_outputs(&mut self) -> Vec<Rate<S>> {
        // Of sines and cosines that of the angle.
        let mut tangents: Vec<Rate<S>> = Vec::with_capacity(self.program.instructions.len());
        for k in 0..self.program.instructions.len() {
            let tangent = self.instruction(k, &tangents);
            tangents.push(tangent);
        }
        let program = self.program;
        program.outputs.iter().map(|operand| self.rate(*operand, &tangents)).collect()
    }

    /// An operand of the program, as it is read now.
    pub(crate) fn here(&self, operand: Operand<S>) -> Operand<S> {
        moved(operand, self.places, self.symbols)
    }

    fn rate(&mut self, operand: Operand<S>, tangents: &[Rate<S>]) -> Rate<S> {
        match operand {
            Operand::Number(_) => None,
            Operand::Input(e) => self.rates.get(&e).copied().flatten(),
            Operand::Value(k) => tangents[k],
            Operand::Sine(k) => self.writer.times(tangents[k], Operand::Cosine(self.places[k])),
            Operand::Cosine(k) => self.writer.times(tangents[k], Operand::Sine(self.places[k])).map(Tangent::negated),
        }
    }

    fn instruction(&mut self, k: usize, tangents: &[Rate<S>]) -> Rate<S> {
        let own = Operand::Value(self.places[k]);
        let minus = |rate: Rate<S>| rate.map(Tangent::negated);
        match self.program.instructions[k] {
            Instruction::Add(a, b) => {
                let (da, db) = (self.rate(a, tangents), self.rate(b, tangents));
                self.writer.plus(da, db)
            }
            Instruction::Subtract(a, b) => {
                let (da, db) = (self.rate(a, tangents), self.rate(b, tangents));
                self.writer.plus(da, minus(db))
            }
            Instruction::Multiply(a, b) => {
                let (da, db) = (self.rate(a, tangents), self.rate(b, tangents));
                let (a, b) = (self.here(a), self.here(b));
                let first = self.writer.times(da, b);
                self.writer.times_plus(db, a, first)
            }
            Instruction::MultiplyAdd(a, b, c) | Instruction::MultiplySubtract(a, b, c) => {
                let subtracts = matches!(self.program.instructions[k], Instruction::MultiplySubtract(..));
                let sign = |rate: Rate<S>| if subtracts { minus(rate) } else { rate };
                let dc = self.rate(c, tangents);
                let (da, db) = (sign(self.rate(a, tangents)), sign(self.rate(b, tangents)));
                let (a, b) = (self.here(a), self.here(b));
                let first = self.writer.times_plus(da, b, dc);
                self.writer.times_plus(db, a, first)
            }
            Instruction::Divide(a, b) => self.quotient([a, b], own, tangents),
            Instruction::Negate(a) => minus(self.rate(a, tangents)),
            Instruction::SineCosine(a) => self.rate(a, tangents),
            Instruction::Call(function, a) => {
                let da = self.rate(a, tangents);
                da?;
                let slope = self.slope(function, a, own)?;
                self.writer.times(da, slope)
            }
            Instruction::Binary(BinaryFunction::Atan2, y, x) => self.angle([y, x], tangents),
            Instruction::Binary(BinaryFunction::Powf, base, exponent) => self.power([base, exponent], own, tangents),
            Instruction::Binary(function @ (BinaryFunction::Min | BinaryFunction::Max), a, b) => {
                self.selected(function, [a, b], tangents)
            }
            Instruction::Own(function, arguments) => {
                let mut sum = None;
                for (k, &argument) in function.of(&arguments).iter().enumerate() {
                    if let Some(rate) = self.rate(argument, tangents) {
                        let slope = self.own_slope(function, &arguments, k);
                        sum = self.writer.times_plus(Some(rate), slope, sum);
                    }
                }
                sum
            }
        }
    }

    /// The derivative of a function of the user's own by its argument number `by`, at operands of the program.
    pub(crate) fn own_slope(
        &mut self,
        function: OwnFunction,
        arguments: &[Operand<S>; MOST_VARIABLES],
        by: usize,
    ) -> Operand<S> {
        let arguments = arguments.map(|argument| self.here(argument));
        self.writer.push(Instruction::Own(function.derivative(by), arguments))
    }

    /// The derivatives of two operands; `None` where both are 0.
    fn both(&mut self, operands: [Operand<S>; 2], tangents: &[Rate<S>]) -> Option<[Rate<S>; 2]> {
        let rates = operands.map(|operand| self.rate(operand, tangents));
        rates.iter().any(Option::is_some).then_some(rates)
    }

    /// (a/b)˙ = (ȧ − (a/b) ḃ)/b, where a/b is `own`.
    fn quotient(&mut self, [a, b]: [Operand<S>; 2], own: Operand<S>, tangents: &[Rate<S>]) -> Rate<S> {
        let [da, db] = self.both([a, b], tangents)?;
        let above = self.writer.times_plus(db.map(Tangent::negated), own, da);
        let b = self.here(b);
        let reciprocal = self.writer.reciprocal(b);
        self.writer.times(above, reciprocal)
    }

    /// atan2(y, x)˙ = (ẏ x − ẋ y)/(x² + y²).
    fn angle(&mut self, [y, x]: [Operand<S>; 2], tangents: &[Rate<S>]) -> Rate<S> {
        let [dy, dx] = self.both([y, x], tangents)?;
        let (y, x) = (self.here(y), self.here(x));
        let turned = self.writer.times(dy, x);
        let turned = self.writer.times_plus(dx.map(Tangent::negated), y, turned);
        let square = self.writer.multiplied(y, y);
        let square = self.writer.push(Instruction::MultiplyAdd(x, x, square));
        let reciprocal = self.writer.reciprocal(square);
        self.writer.times(turned, reciprocal)
    }

    /// (x^p)˙ = p x^(p − 1) ẋ + x^p ln x ṗ.
    fn power(&mut self, [base, exponent]: [Operand<S>; 2], own: Operand<S>, tangents: &[Rate<S>]) -> Rate<S> {
        let [of_base, of_exponent] = self.both([base, exponent], tangents)?;
        let (x, p) = (self.here(base), self.here(exponent));
        let by_base = of_base.and_then(|rate| {
            let less = self.writer.push(Instruction::Subtract(p, Operand::Number(Rational::one())));
            let power = self.writer.push(Instruction::Binary(BinaryFunction::Powf, x, less));
            let slope = self.writer.multiplied(p, power);
            self.writer.times(Some(rate), slope)
        });
        let by_exponent = of_exponent.and_then(|rate| {
            // Of 0 the power is 0, which the logarithm must not spoil.
            let tiny = self.writer.least();
            let least = self.writer.push(Instruction::Binary(BinaryFunction::Max, x, tiny));
            let logarithm = self.writer.push(Instruction::Call(Function::Ln, least));
            let slope = self.writer.multiplied(own, logarithm);
            self.writer.times(Some(rate), slope)
        });
        self.writer.plus(by_base, by_exponent)
    }

    /// Derivative of the smaller or larger of two numbers.
    fn selected(&mut self, function: BinaryFunction, [a, b]: [Operand<S>; 2], tangents: &[Rate<S>]) -> Rate<S> {
        let [da, db] = self.both([a, b], tangents)?;
        let (a, b) = (self.here(a), self.here(b));
        let [of_first, of_second] = self.shares(function, a, b);
        let first = self.writer.times(da, of_first);
        self.writer.times_plus(db, of_second, first)
    }

    /// f′ at the operand of the program `a`, where f is `own`; `None` is 0.
    pub(crate) fn slope(&mut self, function: Function, a: Operand<S>, own: Operand<S>) -> Option<Operand<S>> {
        let a = self.here(a);
        let number = |p: i64, q: i64| Operand::Number(Rational::new(p, q));
        Some(match function {
            Function::Exp => own,
            Function::Ln => self.writer.reciprocal(a),
            // At 0, where the slope is infinite, a huge number in its place: 0 stays 0 along directions in which the
            // radicand, such as the square of a velocity, does not change to first order. Two factors, because 2⁻¹²⁴ is
            // no fraction of 64-bit integers.
            Function::Sqrt => {
                let least = self.writer.least();
                let root = self.writer.push(Instruction::Binary(BinaryFunction::Max, own, least));
                self.writer.push(Instruction::Divide(number(1, 2), root))
            }
            Function::Abs => self.writer.push(Instruction::Call(Function::Signum, a)),
            Function::Signum => return None,
            Function::Tanh => {
                let one = Operand::Number(Rational::one());
                self.writer.push(Instruction::MultiplySubtract(own, own, one))
            }
            Function::Sin | Function::Cos => unreachable!("sines and cosines come in pairs"),
        })
    }

    /// Shares of both derivatives in that of the larger or smaller of two numbers: 1 and 0, or ½ and ½ where they are
    /// equal.
    pub(crate) fn shares(&mut self, function: BinaryFunction, a: Operand<S>, b: Operand<S>) -> [Operand<S>; 2] {
        let half = Operand::Number(Rational::new(1, 2));
        let (x, y) = if function == BinaryFunction::Max { (a, b) } else { (b, a) };
        let difference = self.writer.push(Instruction::Subtract(x, y));
        let side = self.writer.push(Instruction::Call(Function::Signum, difference));
        [
            self.writer.push(Instruction::MultiplyAdd(half, side, half)),
            self.writer.push(Instruction::MultiplySubtract(half, side, half)),
        ]
    }
}
