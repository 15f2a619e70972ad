//! Instructions of derivatives: equal ones are written once, products with 0 and 1 never.

use crate::algebra::{Key, Map, Rational};
use crate::program::{Code, Instruction, Operand};

/// A derivative that is not 0: ± a value.
#[derive(Clone, Copy)]
pub(crate) struct Tangent<S> {
    pub(crate) negative: bool,
    pub(crate) value: Operand<S>,
}

impl<S> Tangent<S> {
    /// A derivative with the sign of its value.
    pub(crate) fn plain(value: Operand<S>) -> Self {
        Self { negative: false, value }
    }

    pub(crate) fn negated(self) -> Self {
        Self { negative: !self.negative, ..self }
    }
}

/// A derivative; `None` is 0.
pub(crate) type Rate<S> = Option<Tangent<S>>;

/// Writes instructions, equal ones once.
pub(crate) struct InstructionWriter<S> {
    instructions: Vec<Instruction<S>>,
    known: Map<Instruction<S>, usize>,
}

impl<S> Default for InstructionWriter<S> {
    fn default() -> Self {
        Self { instructions: Vec::new(), known: Map::default() }
    }
}

impl<S: Copy + Key> InstructionWriter<S> {
    /// Begins with the instructions of a program, where they are.
    pub(crate) fn of(code: &Code<S>) -> Self {
        Self { instructions: code.instructions.clone(), known: Map::default() }
    }

    /// Begins with a copy of a program; where its instructions are now.
    pub(crate) fn copied(code: &Code<S>) -> (Self, Vec<usize>) {
        let mut writer = Self::default();
        let (places, _) = writer.copy(code, &Map::default());
        (writer, places)
    }

    pub(crate) fn place(&mut self, operation: Instruction<S>) -> usize {
        let next = self.instructions.len();
        let place = *self.known.or_insert_with(operation, || next);
        if place == next {
            self.instructions.push(operation);
        }
        place
    }

    pub(crate) fn push(&mut self, operation: Instruction<S>) -> Operand<S> {
        Operand::Value(self.place(operation))
    }

    /// Copies a program, with some of its symbols replaced: where its instructions are now, and its outputs.
    pub(crate) fn copy(&mut self, program: &Code<S>, symbols: &Map<S, Operand<S>>) -> (Vec<usize>, Vec<Operand<S>>) {
        let mut places = Vec::with_capacity(program.instructions.len());
        for instruction in &program.instructions {
            let moved = instruction.map(|operand| moved(operand, &places, symbols));
            places.push(self.place(moved));
        }
        let outputs = program.outputs.iter().map(|&operand| moved(operand, &places, symbols)).collect();
        (places, outputs)
    }

    /// As a program, without what no output needs.
    pub(crate) fn finish(self, outputs: Vec<Operand<S>>) -> Code<S> {
        Code { instructions: self.instructions, outputs }.without_idle().verified()
    }

    pub(crate) fn written(&mut self, tangent: Tangent<S>) -> Operand<S> {
        match (tangent.negative, tangent.value) {
            (false, value) => value,
            (true, Operand::Number(n)) => Operand::Number(-n),
            (true, value) => self.push(Instruction::Negate(value)),
        }
    }

    /// a b of values that are not derivatives.
    pub(crate) fn multiplied(&mut self, a: Operand<S>, b: Operand<S>) -> Operand<S> {
        match (a, b) {
            (Operand::Number(n), other) | (other, Operand::Number(n)) if n.is_one() => other,
            (Operand::Number(n), Operand::Number(m)) => Operand::Number(n * m),
            _ => self.push(Instruction::Multiply(a, b)),
        }
    }

    /// A number that is nearly the smallest.
    pub(crate) fn least(&mut self) -> Operand<S> {
        let tiny = Operand::Number(Rational::new(1, 1 << 62));
        self.push(Instruction::Multiply(tiny, tiny))
    }

    pub(crate) fn reciprocal(&mut self, a: Operand<S>) -> Operand<S> {
        match a {
            Operand::Number(n) => Operand::Number(n.recip()),
            _ => self.push(Instruction::Divide(Operand::Number(Rational::one()), a)),
        }
    }

    /// `rate · factor`.
    pub(crate) fn times(&mut self, rate: Rate<S>, factor: Operand<S>) -> Rate<S> {
        let tangent = rate?;
        let (negative, factor) = match factor {
            Operand::Number(n) if n.is_zero() => return None,
            Operand::Number(n) if n.is_negative() => (!tangent.negative, Operand::Number(-n)),
            _ => (tangent.negative, factor),
        };
        Some(Tangent { negative, value: self.multiplied(tangent.value, factor) })
    }

    pub(crate) fn plus(&mut self, a: Rate<S>, b: Rate<S>) -> Rate<S> {
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
                Tangent { negative, value: self.push(Instruction::Add(a.value, b.value)) }
            }
            (false, _) => Tangent { negative: false, value: self.push(Instruction::Subtract(a.value, b.value)) },
            (true, _) => Tangent { negative: false, value: self.push(Instruction::Subtract(b.value, a.value)) },
        })
    }

    /// `rate · factor + onto`, in one instruction where both are there.
    pub(crate) fn times_plus(&mut self, rate: Rate<S>, factor: Operand<S>, onto: Rate<S>) -> Rate<S> {
        let plain = |operand: Operand<S>| matches!(operand, Operand::Number(_));
        match (rate, onto) {
            (Some(tangent), Some(sum)) if !plain(tangent.value) && !plain(factor) => {
                let (a, b, c) = (tangent.value, factor, sum.value);
                let same = tangent.negative == sum.negative;
                let operation =
                    if same { Instruction::MultiplyAdd(a, b, c) } else { Instruction::MultiplySubtract(a, b, c) };
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
pub(crate) fn moved<S: Copy + Key>(operand: Operand<S>, places: &[usize], symbols: &Map<S, Operand<S>>) -> Operand<S> {
    match operand {
        Operand::Input(e) => symbols.get(&e).copied().unwrap_or(operand),
        _ => operand.moved(|k| places[k]),
    }
}
