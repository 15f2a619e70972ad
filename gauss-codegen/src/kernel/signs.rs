//! Negations: −(a b − c) is written c − a b, so that no instruction is spent on a sign.
//!
//! The addend of a multiply-add, and what is added or subtracted, take a sign for nothing; a result does not. A sign is therefore led
//! from a result to what it was computed of, as far as nobody else reads that. Results stay the same to the last bit, but for the sign of
//! a zero.

use super::program::{Operand, Operation, Program};

/// A program whose signs are being moved.
struct Signs<'g> {
    instructions: Vec<Operation<'g>>,
    uses: Vec<usize>,
    /// Whose addend is to be taken with the other sign.
    negated_addend: Vec<bool>,
    /// Negations that were led away: what stands for them.
    replaced: Vec<Option<usize>>,
}

impl<'g> Program<'g> {
    /// The same with as few negations of results as can be.
    pub fn with_signs_led_back(self) -> Self {
        let count = self.instructions.len();
        let mut uses = vec![0; count];
        for operand in self.operands() {
            if let Operand::Value(k) | Operand::Sine(k) | Operand::Cosine(k) = operand {
                uses[k] += 1;
            }
        }
        let mut signs = Signs {
            instructions: self.instructions,
            uses,
            negated_addend: vec![false; count],
            replaced: vec![None; count],
        };
        for k in 0..count {
            if let Operation::Negate(Operand::Value(negated)) = signs.instructions[k]
                && signs.flip(negated)
            {
                signs.replaced[k] = Some(negated);
            }
        }
        signs.write(&self.outputs)
    }
}

impl<'g> Signs<'g> {
    /// Makes an instruction that is read once compute the negative, if that costs nothing.
    fn flip(&mut self, k: usize) -> bool {
        if self.uses[k] != 1 {
            return false;
        }
        let instruction = self.instructions[k];
        let flipped = match instruction {
            Operation::Subtract(a, b) => Operation::Subtract(b, a),
            Operation::Add(a, b) if self.flip_operand(a) => Operation::Subtract(a, b),
            Operation::Add(a, b) if self.flip_operand(b) => Operation::Subtract(b, a),
            Operation::MultiplyAdd(a, b, c) => {
                self.negated_addend[k] ^= !self.flip_operand(c);
                Operation::MultiplySubtract(a, b, c)
            }
            Operation::MultiplySubtract(a, b, c) => {
                self.negated_addend[k] ^= !self.flip_operand(c);
                Operation::MultiplyAdd(a, b, c)
            }
            Operation::Multiply(a, b) if self.flip_operand(a) || self.flip_operand(b) => Operation::Multiply(a, b),
            Operation::Divide(a, b) if self.flip_operand(a) || self.flip_operand(b) => Operation::Divide(a, b),
            Operation::Multiply(Operand::Number(n), b) => Operation::Multiply(Operand::Number(-n), b),
            Operation::Divide(Operand::Number(n), b) => Operation::Divide(Operand::Number(-n), b),
            _ => return false,
        };
        self.instructions[k] = flipped;
        true
    }

    fn flip_operand(&mut self, operand: Operand<'g>) -> bool {
        match operand {
            Operand::Value(k) => self.flip(k),
            _ => false,
        }
    }

    /// The instructions in their order, without those that nobody needs any more.
    fn write(self, outputs: &[Operand<'g>]) -> Program<'g> {
        let mut place: Vec<usize> = Vec::with_capacity(self.instructions.len());
        let mut instructions = Vec::with_capacity(self.instructions.len());
        let moved = |operand: Operand<'g>, place: &[usize]| match operand {
            Operand::Value(k) => Operand::Value(place[k]),
            Operand::Sine(k) => Operand::Sine(place[k]),
            Operand::Cosine(k) => Operand::Cosine(place[k]),
            other => other,
        };
        for (k, instruction) in self.instructions.iter().enumerate() {
            if let Some(other) = self.replaced[k] {
                place.push(place[other]);
                continue;
            }
            let mut instruction = instruction.map(|operand| moved(operand, &place));
            if self.negated_addend[k]
                && let Operation::MultiplyAdd(_, _, c) | Operation::MultiplySubtract(_, _, c) = &mut instruction
            {
                *c = match *c {
                    Operand::Number(n) => Operand::Number(-n),
                    other => {
                        instructions.push(Operation::Negate(other));
                        Operand::Value(instructions.len() - 1)
                    }
                };
            }
            instructions.push(instruction);
            place.push(instructions.len() - 1);
        }
        let outputs = outputs.iter().map(|&operand| moved(operand, &place)).collect();
        Program { instructions, outputs }
    }
}
