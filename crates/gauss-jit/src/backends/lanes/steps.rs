//! Steps for each of which vectors have an instruction, or which call a function lane by lane.

use std::collections::HashMap;

use gauss_codegen::program::{BinaryFunction, Function, OwnFunction};

/// A vector that a step reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LaneOperand {
    /// The result of a step.
    Value(usize),
    /// A number of each row.
    Input(usize),
    /// A number of the first argument, which all rows share.
    Constant(usize),
    /// A number of the code.
    Number(usize),
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Operation {
    Add,
    Subtract,
    Multiply,
    Divide,
    /// a·b + c, rounded once.
    MultiplyAdd,
    /// c − a·b, rounded once.
    MultiplySubtract,
    Root,
    And,
    Or,
    Xor,
    /// Difference of whole numbers of 64 bits.
    SubtractBits,
    ShiftLeft(u8),
    ShiftRight(u8),
    Call(Callee),
}

/// A function that is called lane by lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Callee {
    Unary(Function),
    Binary(BinaryFunction),
    Table(OwnFunction),
}

/// An operation on up to three vectors.
#[derive(Clone, Debug)]
pub struct Step {
    pub operation: Operation,
    places: [LaneOperand; 3],
    count: usize,
}

impl Step {
    pub fn places(&self) -> &[LaneOperand] {
        &self.places[..self.count]
    }
}

/// Code for lanes before it has registers.
#[derive(Debug, Default)]
pub struct Steps {
    pub steps: Vec<Step>,
    pub outputs: Vec<LaneOperand>,
    /// Bits of the numbers of the code.
    pub numbers: Vec<u64>,
    /// Not zero in lanes that must be computed by themselves; none where that never is.
    pub exceptions: Option<LaneOperand>,
    known_numbers: HashMap<u64, usize>,
}

impl Steps {
    /// The result of one more step.
    pub fn step(&mut self, operation: Operation, operands: &[LaneOperand]) -> LaneOperand {
        let mut places = [LaneOperand::Number(0); 3];
        let count = operands.len().min(places.len());
        places[..count].copy_from_slice(&operands[..count]);
        self.steps.push(Step { operation, places, count });
        LaneOperand::Value(self.steps.len() - 1)
    }

    /// A number by its bits.
    pub fn bits(&mut self, bits: u64) -> LaneOperand {
        let next = self.numbers.len();
        let place = *self.known_numbers.entry(bits).or_insert(next);
        if place == next {
            self.numbers.push(bits);
        }
        LaneOperand::Number(place)
    }

    pub fn number(&mut self, value: f64) -> LaneOperand {
        self.bits(value.to_bits())
    }
}
