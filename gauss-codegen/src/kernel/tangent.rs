//! Derivatives of programs: forward differentiation, instruction by instruction, along many directions at once.
//!
//! A program is a list of elementary steps, so the chain rule is one rule a step, and what a step costs its derivative
//! costs two or three times. Products with 0 and 1 are never written, equal instructions are written once, and what no
//! output needs is left out: outputs that cannot change along a direction are the number 0.

use crate::algebra::{BinaryFunction, Expr, Function, MOST_VARIABLES, Map, OwnFunction, Rational};
use crate::derivatives::Direction;

use super::write::{Operand, Operation, Program};

/// The outputs of `program`, and then, direction by direction, the derivatives of them all. `bound` are symbols that
/// are outputs of the other program: what reads them reads these.
pub fn with_tangents<'g>(
    program: &Program<'g>,
    bound: (&[Expr<'g>], &Program<'g>),
    directions: &[Direction<'g>],
) -> Program<'g> {
    let (writer, values, tangents) = differentiated(program, bound, directions);
    writer.finish([values, tangents].concat())
}

/// The derivatives alone, and what they need.
pub fn tangents_alone<'g>(
    program: &Program<'g>,
    bound: (&[Expr<'g>], &Program<'g>),
    directions: &[Direction<'g>],
) -> Program<'g> {
    let (writer, _, tangents) = differentiated(program, bound, directions);
    writer.finish(tangents)
}

/// Other outputs of the same instructions, and only the instructions that they need.
pub fn with_outputs<'g>(program: &Program<'g>, outputs: Vec<Operand<'g>>) -> Program<'g> {
    InstructionWriter { instructions: program.instructions.clone(), known: Map::default() }.finish(outputs)
}

/// Two programs as one: the outputs of the first, then those of the second.
pub fn joined<'g>(first: &Program<'g>, second: &Program<'g>) -> Program<'g> {
    let mut writer = InstructionWriter::default();
    let none = Map::default();
    let (_, mut outputs) = writer.copy(first, &none);
    outputs.extend(writer.copy(second, &none).1);
    writer.finish(outputs)
}

/// Functions of which one is given as the root of another: x with `residual(x) = 0`, solved by `root`.
pub struct Implicit<'a, 'g> {
    pub root: &'a Program<'g>,
    pub residual: &'a Program<'g>,
    /// x in the residual, in the order of the outputs of both.
    pub unknowns: &'a [Expr<'g>],
    /// Affine in `loads`, with the inverse of ∂residual/∂x as the coefficients.
    pub solution: &'a Program<'g>,
    pub loads: &'a [Expr<'g>],
}

/// The derivatives of the outputs of a program, and then of the root, direction by direction:
/// `−(∂residual/∂x)⁻¹ ∂residual`. What the solution divides by is worked out once for all directions.
pub fn implicit_tangents<'g>(
    explicit: &Program<'g>,
    implicit: &Implicit<'_, 'g>,
    directions: &[Direction<'g>],
) -> Program<'g> {
    let mut writer = InstructionWriter::default();
    let none = Map::default();
    let (_, root) = writer.copy(implicit.root, &none);
    let unknowns: Map<u32, Operand<'g>> = implicit.unknowns.iter().map(|symbol| symbol.key()).zip(root).collect();
    let (explicit_places, _) = writer.copy(explicit, &none);
    let (residual_places, _) = writer.copy(implicit.residual, &unknowns);
    let (solution_places, _) = writer.copy(implicit.solution, &none);
    let mut outputs = Vec::new();
    for direction in directions {
        let mut pass = TangentPass::new(&mut writer, explicit, &none, &explicit_places);
        pass.set_out(direction);
        outputs.extend(pass.outputs());
        let mut pass = TangentPass::new(&mut writer, implicit.residual, &unknowns, &residual_places);
        pass.set_out(direction);
        let changes = pass.tangents();
        let mut pass = TangentPass::new(&mut writer, implicit.solution, &none, &solution_places);
        let loads = implicit.loads.iter().zip(changes);
        pass.rates = loads.map(|(symbol, rate)| (symbol.key(), rate.map(Tangent::negated))).collect();
        outputs.extend(pass.outputs());
    }
    writer.finish(outputs)
}

/// Writes the instructions of the outputs and their derivatives, and tells where these are.
fn differentiated<'g>(
    program: &Program<'g>,
    bound: (&[Expr<'g>], &Program<'g>),
    directions: &[Direction<'g>],
) -> (InstructionWriter<'g>, Vec<Operand<'g>>, Vec<Operand<'g>>) {
    let mut writer = InstructionWriter::default();
    let none = Map::default();
    let (_, values) = writer.copy(bound.1, &none);
    let symbols: Map<u32, Operand<'g>> = bound.0.iter().map(|symbol| symbol.key()).zip(values).collect();
    let (places, outputs) = writer.copy(program, &symbols);
    let mut tangents = Vec::new();
    for direction in directions {
        let mut pass = TangentPass::new(&mut writer, program, &symbols, &places);
        pass.set_out(direction);
        tangents.extend(pass.outputs());
    }
    (writer, outputs, tangents)
}

/// A derivative that is not 0: ± a value.
#[derive(Clone, Copy)]
pub(super) struct Tangent<'g> {
    pub(super) negative: bool,
    pub(super) value: Operand<'g>,
}

impl<'g> Tangent<'g> {
    pub(super) fn negated(self) -> Self {
        Self { negative: !self.negative, ..self }
    }
}

/// A derivative; `None` is 0.
pub(super) type Rate<'g> = Option<Tangent<'g>>;

/// Writes instructions, equal ones once.
#[derive(Default)]
pub(super) struct InstructionWriter<'g> {
    instructions: Vec<Operation<'g>>,
    known: Map<Operation<'g>, usize>,
}

impl<'g> InstructionWriter<'g> {
    pub(super) fn place(&mut self, operation: Operation<'g>) -> usize {
        let next = self.instructions.len();
        let place = *self.known.or_insert_with(operation, || next);
        if place == next {
            self.instructions.push(operation);
        }
        place
    }

    pub(super) fn push(&mut self, operation: Operation<'g>) -> Operand<'g> {
        Operand::Value(self.place(operation))
    }

    /// Copies a program, with some of its symbols replaced: where its instructions are now, and its outputs.
    pub(super) fn copy(
        &mut self,
        program: &Program<'g>,
        symbols: &Map<u32, Operand<'g>>,
    ) -> (Vec<usize>, Vec<Operand<'g>>) {
        let mut places = Vec::with_capacity(program.instructions.len());
        for instruction in &program.instructions {
            let moved = instruction.map(|operand| moved(operand, &places, symbols));
            places.push(self.place(moved));
        }
        let outputs = program.outputs.iter().map(|&operand| moved(operand, &places, symbols)).collect();
        (places, outputs)
    }

    /// As a program, without what no output needs.
    pub(super) fn finish(self, outputs: Vec<Operand<'g>>) -> Program<'g> {
        Program { instructions: self.instructions, outputs }.without_idle().verified()
    }

    pub(super) fn written(&mut self, tangent: Tangent<'g>) -> Operand<'g> {
        match (tangent.negative, tangent.value) {
            (false, value) => value,
            (true, Operand::Number(n)) => Operand::Number(-n),
            (true, value) => self.push(Operation::Negate(value)),
        }
    }

    /// a b of values that are not derivatives.
    pub(super) fn multiplied(&mut self, a: Operand<'g>, b: Operand<'g>) -> Operand<'g> {
        match (a, b) {
            (Operand::Number(n), other) | (other, Operand::Number(n)) if n.is_one() => other,
            (Operand::Number(n), Operand::Number(m)) => Operand::Number(n * m),
            _ => self.push(Operation::Multiply(a, b)),
        }
    }

    /// A number that is nearly the smallest.
    pub(super) fn least(&mut self) -> Operand<'g> {
        let tiny = Operand::Number(Rational::new(1, 1 << 62));
        self.push(Operation::Multiply(tiny, tiny))
    }

    pub(super) fn reciprocal(&mut self, a: Operand<'g>) -> Operand<'g> {
        match a {
            Operand::Number(n) => Operand::Number(n.recip()),
            _ => self.push(Operation::Divide(Operand::Number(Rational::one()), a)),
        }
    }

    /// `rate · factor`.
    pub(super) fn times(&mut self, rate: Rate<'g>, factor: Operand<'g>) -> Rate<'g> {
        let tangent = rate?;
        let (negative, factor) = match factor {
            Operand::Number(n) if n.is_zero() => return None,
            Operand::Number(n) if n.is_negative() => (!tangent.negative, Operand::Number(-n)),
            _ => (tangent.negative, factor),
        };
        Some(Tangent { negative, value: self.multiplied(tangent.value, factor) })
    }

    pub(super) fn plus(&mut self, a: Rate<'g>, b: Rate<'g>) -> Rate<'g> {
        let (Some(a), Some(b)) = (a, b) else { return a.or(b) };
        if a.value == b.value && a.negative != b.negative {
            return None;
        }
        if let (Operand::Number(n), Operand::Number(m)) = (a.value, b.value) {
            let sum = if a.negative == b.negative { n.plus(m) } else { n - m };
            let value = Operand::Number(sum.abs());
            return (!sum.is_zero()).then_some(Tangent { negative: a.negative != sum.is_negative(), value });
        }
        Some(match (a.negative, b.negative) {
            (negative, other) if negative == other => {
                Tangent { negative, value: self.push(Operation::Add(a.value, b.value)) }
            }
            (false, _) => Tangent { negative: false, value: self.push(Operation::Subtract(a.value, b.value)) },
            (true, _) => Tangent { negative: false, value: self.push(Operation::Subtract(b.value, a.value)) },
        })
    }

    /// `rate · factor + onto`, in one instruction where both are there.
    pub(super) fn times_plus(&mut self, rate: Rate<'g>, factor: Operand<'g>, onto: Rate<'g>) -> Rate<'g> {
        let plain = |operand: Operand<'g>| matches!(operand, Operand::Number(_));
        match (rate, onto) {
            (Some(tangent), Some(sum)) if !plain(tangent.value) && !plain(factor) => {
                let (a, b, c) = (tangent.value, factor, sum.value);
                let same = tangent.negative == sum.negative;
                let operation =
                    if same { Operation::MultiplyAdd(a, b, c) } else { Operation::MultiplySubtract(a, b, c) };
                Some(Tangent { negative: sum.negative, value: self.push(operation) })
            }
            _ => {
                let product = self.times(rate, factor);
                self.plus(product, onto)
            }
        }
    }
}

/// An operand where its instruction is now.
pub(super) fn moved<'g>(operand: Operand<'g>, places: &[usize], symbols: &Map<u32, Operand<'g>>) -> Operand<'g> {
    match operand {
        Operand::Input(e) => symbols.get(&e.key()).copied().unwrap_or(operand),
        _ => operand.moved(|k| places[k]),
    }
}

/// The derivatives of one program along one direction.
pub(super) struct TangentPass<'a, 'g> {
    pub(super) writer: &'a mut InstructionWriter<'g>,
    pub(super) program: &'a Program<'g>,
    symbols: &'a Map<u32, Operand<'g>>,
    pub(super) places: &'a [usize],
    /// Rates of symbols that move.
    pub(super) rates: Map<u32, Rate<'g>>,
}

impl<'a, 'g> TangentPass<'a, 'g> {
    pub(super) fn new(
        writer: &'a mut InstructionWriter<'g>,
        program: &'a Program<'g>,
        symbols: &'a Map<u32, Operand<'g>>,
        places: &'a [usize],
    ) -> Self {
        Self { writer, program, symbols, places, rates: Map::default() }
    }

    pub(super) fn set_out(&mut self, direction: &Direction<'g>) {
        for (symbol, rate) in direction {
            let rate = self.rate_of_symbol(*rate);
            self.rates.insert(symbol.key(), rate);
        }
    }

    pub(super) fn rate_of_symbol(&self, rate: Expr<'g>) -> Rate<'g> {
        if rate.is_zero() {
            return None;
        }
        let (c, rest) = rate.split_coefficient();
        let value = if rest.as_number().is_some() { Operand::Number(c.abs()) } else { self.here(Operand::Input(rest)) };
        let tangent = Tangent { negative: false, value };
        Some(if c.is_negative() { tangent.negated() } else { tangent })
    }

    fn outputs(mut self) -> Vec<Operand<'g>> {
        let rates = self.rates_of_outputs();
        let written = |rate: Rate<'g>| match rate {
            None => Operand::Number(Rational::zero()),
            Some(tangent) => self.writer.written(tangent),
        };
        rates.into_iter().map(written).collect()
    }

    fn tangents(mut self) -> Vec<Rate<'g>> {
        self.rates_of_outputs()
    }

    fn rates_of_outputs(&mut self) -> Vec<Rate<'g>> {
        // Of sines and cosines that of the angle.
        let mut tangents: Vec<Rate<'g>> = Vec::with_capacity(self.program.instructions.len());
        for k in 0..self.program.instructions.len() {
            let tangent = self.instruction(k, &tangents);
            tangents.push(tangent);
        }
        let program = self.program;
        program.outputs.iter().map(|operand| self.rate(*operand, &tangents)).collect()
    }

    /// An operand of the program, as it is read now.
    pub(super) fn here(&self, operand: Operand<'g>) -> Operand<'g> {
        moved(operand, self.places, self.symbols)
    }

    fn rate(&mut self, operand: Operand<'g>, tangents: &[Rate<'g>]) -> Rate<'g> {
        match operand {
            Operand::Number(_) => None,
            Operand::Input(e) => self.rates.get(&e.key()).copied().flatten(),
            Operand::Value(k) => tangents[k],
            Operand::Sine(k) => self.writer.times(tangents[k], Operand::Cosine(self.places[k])),
            Operand::Cosine(k) => self.writer.times(tangents[k], Operand::Sine(self.places[k])).map(Tangent::negated),
        }
    }

    fn instruction(&mut self, k: usize, tangents: &[Rate<'g>]) -> Rate<'g> {
        let own = Operand::Value(self.places[k]);
        let minus = |rate: Rate<'g>| rate.map(Tangent::negated);
        match self.program.instructions[k] {
            Operation::Add(a, b) => {
                let (da, db) = (self.rate(a, tangents), self.rate(b, tangents));
                self.writer.plus(da, db)
            }
            Operation::Subtract(a, b) => {
                let (da, db) = (self.rate(a, tangents), self.rate(b, tangents));
                self.writer.plus(da, minus(db))
            }
            Operation::Multiply(a, b) => {
                let (da, db) = (self.rate(a, tangents), self.rate(b, tangents));
                let (a, b) = (self.here(a), self.here(b));
                let first = self.writer.times(da, b);
                self.writer.times_plus(db, a, first)
            }
            Operation::MultiplyAdd(a, b, c) | Operation::MultiplySubtract(a, b, c) => {
                let subtracts = matches!(self.program.instructions[k], Operation::MultiplySubtract(..));
                let sign = |rate: Rate<'g>| if subtracts { minus(rate) } else { rate };
                let dc = self.rate(c, tangents);
                let (da, db) = (sign(self.rate(a, tangents)), sign(self.rate(b, tangents)));
                let (a, b) = (self.here(a), self.here(b));
                let first = self.writer.times_plus(da, b, dc);
                self.writer.times_plus(db, a, first)
            }
            Operation::Divide(a, b) => self.quotient([a, b], own, tangents),
            Operation::Negate(a) => minus(self.rate(a, tangents)),
            Operation::SineCosine(a) => self.rate(a, tangents),
            Operation::Call(function, a) => {
                let da = self.rate(a, tangents);
                da?;
                let slope = self.slope(function, a, own)?;
                self.writer.times(da, slope)
            }
            Operation::Binary(BinaryFunction::Atan2, y, x) => self.angle([y, x], tangents),
            Operation::Binary(BinaryFunction::Powf, base, exponent) => self.power([base, exponent], own, tangents),
            Operation::Binary(function @ (BinaryFunction::Min | BinaryFunction::Max), a, b) => {
                self.selected(function, [a, b], tangents)
            }
            Operation::Own(function, arguments) => {
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
    pub(super) fn own_slope(
        &mut self,
        function: OwnFunction,
        arguments: &[Operand<'g>; MOST_VARIABLES],
        by: usize,
    ) -> Operand<'g> {
        let arguments = arguments.map(|argument| self.here(argument));
        self.writer.push(Operation::Own(function.derivative(by), arguments))
    }

    /// The derivatives of two operands; `None` where both are 0.
    fn both(&mut self, operands: [Operand<'g>; 2], tangents: &[Rate<'g>]) -> Option<[Rate<'g>; 2]> {
        let rates = operands.map(|operand| self.rate(operand, tangents));
        rates.iter().any(Option::is_some).then_some(rates)
    }

    /// (a/b)˙ = (ȧ − (a/b) ḃ)/b, where a/b is `own`.
    fn quotient(&mut self, [a, b]: [Operand<'g>; 2], own: Operand<'g>, tangents: &[Rate<'g>]) -> Rate<'g> {
        let [da, db] = self.both([a, b], tangents)?;
        let above = self.writer.times_plus(db.map(Tangent::negated), own, da);
        let b = self.here(b);
        let reciprocal = self.writer.reciprocal(b);
        self.writer.times(above, reciprocal)
    }

    /// atan2(y, x)˙ = (ẏ x − ẋ y)/(x² + y²).
    fn angle(&mut self, [y, x]: [Operand<'g>; 2], tangents: &[Rate<'g>]) -> Rate<'g> {
        let [dy, dx] = self.both([y, x], tangents)?;
        let (y, x) = (self.here(y), self.here(x));
        let turned = self.writer.times(dy, x);
        let turned = self.writer.times_plus(dx.map(Tangent::negated), y, turned);
        let square = self.writer.multiplied(y, y);
        let square = self.writer.push(Operation::MultiplyAdd(x, x, square));
        let reciprocal = self.writer.reciprocal(square);
        self.writer.times(turned, reciprocal)
    }

    /// (x^p)˙ = p x^(p − 1) ẋ + x^p ln x ṗ.
    fn power(&mut self, [base, exponent]: [Operand<'g>; 2], own: Operand<'g>, tangents: &[Rate<'g>]) -> Rate<'g> {
        let [of_base, of_exponent] = self.both([base, exponent], tangents)?;
        let (x, p) = (self.here(base), self.here(exponent));
        let by_base = of_base.and_then(|rate| {
            let less = self.writer.push(Operation::Subtract(p, Operand::Number(Rational::one())));
            let power = self.writer.push(Operation::Binary(BinaryFunction::Powf, x, less));
            let slope = self.writer.multiplied(p, power);
            self.writer.times(Some(rate), slope)
        });
        let by_exponent = of_exponent.and_then(|rate| {
            // Of 0 the power is 0, which the logarithm must not spoil.
            let tiny = self.writer.least();
            let least = self.writer.push(Operation::Binary(BinaryFunction::Max, x, tiny));
            let logarithm = self.writer.push(Operation::Call(Function::Ln, least));
            let slope = self.writer.multiplied(own, logarithm);
            self.writer.times(Some(rate), slope)
        });
        self.writer.plus(by_base, by_exponent)
    }

    /// Derivative of the smaller or larger of two numbers.
    fn selected(&mut self, function: BinaryFunction, [a, b]: [Operand<'g>; 2], tangents: &[Rate<'g>]) -> Rate<'g> {
        let [da, db] = self.both([a, b], tangents)?;
        let (a, b) = (self.here(a), self.here(b));
        let [of_first, of_second] = self.shares(function, a, b);
        let first = self.writer.times(da, of_first);
        self.writer.times_plus(db, of_second, first)
    }

    /// f′ at the operand of the program `a`, where f is `own`; `None` is 0.
    pub(super) fn slope(&mut self, function: Function, a: Operand<'g>, own: Operand<'g>) -> Option<Operand<'g>> {
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
                let root = self.writer.push(Operation::Binary(BinaryFunction::Max, own, least));
                self.writer.push(Operation::Divide(number(1, 2), root))
            }
            Function::Abs => self.writer.push(Operation::Call(Function::Signum, a)),
            Function::Signum => return None,
            Function::Tanh => {
                let one = Operand::Number(Rational::one());
                self.writer.push(Operation::MultiplySubtract(own, own, one))
            }
            Function::Sin | Function::Cos => unreachable!("sines and cosines come in pairs"),
        })
    }

    /// Shares of both derivatives in that of the larger or smaller of two numbers: 1 and 0, or ½ and ½ where they are
    /// equal.
    pub(super) fn shares(&mut self, function: BinaryFunction, a: Operand<'g>, b: Operand<'g>) -> [Operand<'g>; 2] {
        let half = Operand::Number(Rational::new(1, 2));
        let (x, y) = if function == BinaryFunction::Max { (a, b) } else { (b, a) };
        let difference = self.writer.push(Operation::Subtract(x, y));
        let side = self.writer.push(Operation::Call(Function::Signum, difference));
        [
            self.writer.push(Operation::MultiplyAdd(half, side, half)),
            self.writer.push(Operation::MultiplySubtract(half, side, half)),
        ]
    }
}
