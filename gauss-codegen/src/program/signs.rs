//! Negations: −(a b − c) is written c − a b, so that no instruction is spent on a sign.
//!
//! The addend of a multiply-add, and what is added or subtracted, take a sign for nothing; a result does not. A sign is
//! therefore led from a result to what it was computed of, as far as nobody else reads that. Results stay the same to
//! the last bit, but for the sign of a zero.

use super::code::Code;
use super::instruction::{Instruction, Operand};

/// Instructions, each the operand of the next, that a sign is led back through.
const LEVELS: usize = 500;

/// A program whose signs are being moved.
struct Signs<S> {
    instructions: Vec<Instruction<S>>,
    uses: Vec<usize>,
    /// Whose addend is to be taken with the other sign.
    negated_addend: Vec<bool>,
    /// Negations that were led away: what stands for them.
    replaced: Vec<Option<usize>>,
}

impl<S: Copy> Code<S> {
    /// The same with as few negations of results as can be.
    pub fn with_signs_led_back(self) -> Self {
        let count = self.instructions.len();
        let uses = self.uses();
        let mut signs = Signs {
            instructions: self.instructions,
            uses,
            negated_addend: vec![false; count],
            replaced: vec![None; count],
        };
        for k in 0..count {
            if let Instruction::Negate(Operand::Value(negated)) = signs.instructions[k]
                && signs.flip(negated, LEVELS)
            {
                signs.replaced[k] = Some(negated);
            }
        }
        signs.write(&self.outputs)
    }
}

impl<S: Copy> Signs<S> {
    /// Makes an instruction that is read once compute the negative, if that costs nothing.
    fn flip(&mut self, k: usize, levels: usize) -> bool {
        if self.uses[k] != 1 || levels == 0 {
            return false;
        }
        let levels = levels - 1;
        let instruction = self.instructions[k];
        let flipped = match instruction {
            Instruction::Subtract(a, b) => Instruction::Subtract(b, a),
            Instruction::Add(a, b) if self.flip_operand(a, levels) => Instruction::Subtract(a, b),
            Instruction::Add(a, b) if self.flip_operand(b, levels) => Instruction::Subtract(b, a),
            Instruction::MultiplyAdd(a, b, c) => {
                self.negated_addend[k] ^= !self.flip_operand(c, levels);
                Instruction::MultiplySubtract(a, b, c)
            }
            Instruction::MultiplySubtract(a, b, c) => {
                self.negated_addend[k] ^= !self.flip_operand(c, levels);
                Instruction::MultiplyAdd(a, b, c)
            }
            Instruction::Multiply(a, b) if self.flip_operand(a, levels) || self.flip_operand(b, levels) => {
                Instruction::Multiply(a, b)
            }
            Instruction::Divide(a, b) if self.flip_operand(a, levels) || self.flip_operand(b, levels) => {
                Instruction::Divide(a, b)
            }
            Instruction::Multiply(Operand::Number(n), b) => Instruction::Multiply(Operand::Number(-n), b),
            Instruction::Divide(Operand::Number(n), b) => Instruction::Divide(Operand::Number(-n), b),
            _ => return false,
        };
        self.instructions[k] = flipped;
        true
    }

    fn flip_operand(&mut self, operand: Operand<S>, levels: usize) -> bool {
        match operand {
            Operand::Value(k) => self.flip(k, levels),
            _ => false,
        }
    }

    /// The instructions in their order, without those that nobody needs any more.
    fn write(self, outputs: &[Operand<S>]) -> Code<S> {
        let mut place: Vec<usize> = Vec::with_capacity(self.instructions.len());
        let mut instructions = Vec::with_capacity(self.instructions.len());
        let moved = |operand: Operand<S>, place: &[usize]| operand.moved(|k| place[k]);
        for (k, instruction) in self.instructions.iter().enumerate() {
            if let Some(other) = self.replaced[k] {
                place.push(place[other]);
                continue;
            }
            let mut instruction = instruction.map(|operand| moved(operand, &place));
            if self.negated_addend[k]
                && let Instruction::MultiplyAdd(_, _, c) | Instruction::MultiplySubtract(_, _, c) = &mut instruction
            {
                *c = match *c {
                    Operand::Number(n) => Operand::Number(-n),
                    other => {
                        instructions.push(Instruction::Negate(other));
                        Operand::Value(instructions.len() - 1)
                    }
                };
            }
            instructions.push(instruction);
            place.push(instructions.len() - 1);
        }
        let outputs = outputs.iter().map(|&operand| moved(operand, &place)).collect();
        Code { instructions, outputs }.verified()
    }
}
