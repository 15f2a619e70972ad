//! Operations on vectors, and places of operands.

use super::super::instruction::Instruction;

/// Lanes of a vector.
pub(crate) const LANES: usize = 4;

/// Place of an input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum InputPlace {
    /// Among constants, whose order can be chosen.
    Constant,
    /// In an array that is an argument.
    Argument { array: usize, index: usize },
    /// Anywhere.
    Variable,
}

/// Operations on vectors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Operation {
    Add,
    Subtract,
    Multiply,
    /// a b + c.
    MultiplyAdd,
    /// c − a b.
    MultiplySubtract,
    Negate,
}

impl Operation {
    /// Operation of an instruction that can be packed.
    pub fn of<S>(instruction: &Instruction<S>) -> Option<Self> {
        match instruction {
            Instruction::Add(..) => Some(Self::Add),
            Instruction::Subtract(..) => Some(Self::Subtract),
            Instruction::Multiply(..) => Some(Self::Multiply),
            Instruction::MultiplyAdd(..) => Some(Self::MultiplyAdd),
            Instruction::MultiplySubtract(..) => Some(Self::MultiplySubtract),
            Instruction::Negate(_) => Some(Self::Negate),
            _ => None,
        }
    }

    /// Whether its first two operands may change places.
    pub fn commutes(self) -> bool {
        !matches!(self, Self::Subtract | Self::Negate)
    }
}

/// Steps in which packed code is carried out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PackedStep {
    /// An instruction by itself.
    Instruction(usize),
    /// So many sines and cosines, from an instruction on.
    Angles(usize, usize),
    /// A pack, by its index.
    Pack(usize),
}
