//! Properties of code that power series of the outputs need: what moves, what is added up within another sum, what it
//! costs.

use crate::algebra::{BinaryFunction, Function};

use super::code::Code;
use super::instruction::{Instruction, Operand};

/// Cost of a product of series in one order, where a sum costs 1: a lane of multiply-adds over the lower orders and two
/// more.
const PRODUCT: u32 = 5;

impl<S: Copy> Code<S> {
    /// Which instructions compute something that changes, when the inputs change that are not `constant`.
    pub fn moving(&self, constant: impl Fn(S) -> bool) -> Vec<bool> {
        let mut moving: Vec<bool> = Vec::with_capacity(self.instructions.len());
        for instruction in &self.instructions {
            let moves = instruction.operands().any(|operand| operand.moves(&moving, &constant));
            moving.push(moves);
        }
        moving
    }

    /// Which instructions add up or multiply something that one other instruction adds to something else, and nobody
    /// else reads.
    pub fn added_once(&self) -> Vec<bool> {
        let mut uses = vec![0_usize; self.instructions.len()];
        let mut added = vec![false; self.instructions.len()];
        for operand in self.operands() {
            if let Operand::Value(k) = operand {
                uses[k] += 1;
            }
        }
        for instruction in &self.instructions {
            let addends = match instruction {
                Instruction::Add(a, b) | Instruction::Subtract(a, b) => [Some(a), Some(b)],
                Instruction::MultiplyAdd(_, _, c) | Instruction::MultiplySubtract(_, _, c) | Instruction::Negate(c) => {
                    [Some(c), None]
                }
                _ => [None, None],
            };
            for addend in addends.into_iter().flatten() {
                if let Operand::Value(k) = addend {
                    added[*k] = true;
                }
            }
        }
        let adds = |instruction: &Instruction<S>| {
            matches!(
                instruction,
                Instruction::Add(..)
                    | Instruction::Subtract(..)
                    | Instruction::Negate(_)
                    | Instruction::Multiply(..)
                    | Instruction::MultiplyAdd(..)
                    | Instruction::MultiplySubtract(..)
            )
        };
        (0..added.len()).map(|k| added[k] && uses[k] == 1 && adds(&self.instructions[k])).collect()
    }

    /// The approximate cost of one order of the power series of the outputs: a product of two values that vary is a sum
    /// over all lower orders.
    pub fn series_cost(&self, constant: impl Fn(S) -> bool) -> u32 {
        let moving = self.moving(&constant);
        let cost = |(instruction, &moves): (&Instruction<S>, &bool)| {
            let both = |a: &Operand<S>, b: &Operand<S>| a.moves(&moving, &constant) && b.moves(&moving, &constant);
            match instruction {
                _ if !moves => 0,
                Instruction::Multiply(a, b)
                | Instruction::MultiplyAdd(a, b, _)
                | Instruction::MultiplySubtract(a, b, _)
                    if both(a, b) =>
                {
                    PRODUCT
                }
                Instruction::Divide(_, b) if b.moves(&moving, &constant) => PRODUCT,
                Instruction::Call(..) | Instruction::Own(..) => PRODUCT,
                Instruction::SineCosine(_) => 2 * PRODUCT,
                Instruction::Binary(..) => 4 * PRODUCT,
                _ => 1,
            }
        };
        self.instructions.iter().zip(&moving).map(cost).sum()
    }

    /// A function without a power series that the code calls, as users write it.
    pub fn function_without_series(&self) -> Option<&'static str> {
        self.instructions.iter().find_map(|instruction| match instruction {
            Instruction::Call(function @ (Function::Abs | Function::Signum), _) => Some(function.name()),
            Instruction::Own(..) => Some("a function of your own"),
            Instruction::Binary(function @ (BinaryFunction::Min | BinaryFunction::Max), ..) => Some(function.name()),
            _ => None,
        })
    }
}
