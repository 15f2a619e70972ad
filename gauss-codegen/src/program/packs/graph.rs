//! Code as a table of numbers.

use super::super::code::Code;
use super::super::instruction::{Instruction, Operand};
use super::kinds::{InputPlace, Operation};

/// Operand of an instruction: an earlier instruction by its index, or a leaf, counted on from the last instruction.
pub(super) type Id = usize;

/// No instruction.
pub(super) const NOTHING: usize = usize::MAX;

/// An instruction.
pub(super) struct InstructionNode {
    /// Operation on vectors, if it can be packed.
    pub operation: Option<Operation>,
    /// The first so many of these.
    pub operands: [Id; 3],
    pub arity: usize,
    pub cycles: u32,
    /// Cost by itself, as `cost` counts.
    pub cost: u32,
    /// Sines and cosines that are computed together: the first, and how many.
    pub row: Option<(usize, usize)>,
}

/// Instructions, what they read, and outputs.
pub(super) struct InstructionGraph {
    pub nodes: Vec<InstructionNode>,
    pub leaves: Vec<InputPlace>,
    /// The instruction that each is a result of, or `NOTHING`.
    pub waits: Vec<usize>,
    pub outputs: Vec<Id>,
}

impl InstructionGraph {
    /// The table, and what its leaves are.
    pub fn of<S: Copy + PartialEq>(
        code: &Code<S>,
        place: impl Fn(S) -> InputPlace,
        rows: &[(usize, usize)],
    ) -> (Self, Vec<Operand<S>>) {
        let count = code.instructions.len();
        let mut leaves: Vec<Operand<S>> = Vec::new();
        let mut id = |operand: Operand<S>| match operand {
            Operand::Value(k) => k,
            leaf => {
                let known = leaves.iter().position(|other| *other == leaf);
                count
                    + known.unwrap_or_else(|| {
                        leaves.push(leaf);
                        leaves.len() - 1
                    })
            }
        };
        let mut nodes: Vec<InstructionNode> = Vec::with_capacity(count);
        for (k, instruction) in code.instructions.iter().enumerate() {
            let (mut operands, mut arity) = ([0; 3], 0);
            for operand in instruction.operands() {
                operands[arity] = id(operand);
                arity += 1;
            }
            let row = rows.iter().copied().find(|&(first, length)| (first..first + length).contains(&k));
            let (operation, cycles, cost) = (Operation::of(instruction), instruction.cycles(), alone(instruction));
            nodes.push(InstructionNode { operation, operands, arity, cycles, cost, row });
        }
        let outputs = code.outputs.iter().map(|&output| id(output)).collect();
        let place = |operand: &Operand<S>| match *operand {
            Operand::Input(input) => place(input),
            Operand::Number(_) => InputPlace::Constant,
            _ => InputPlace::Variable,
        };
        // Leaves may be parts of a sine and cosine.
        let waits = (0..count).chain(leaves.iter().map(|leaf| leaf.instruction().unwrap_or(NOTHING))).collect();
        (Self { nodes, leaves: leaves.iter().map(place).collect(), waits, outputs }, leaves)
    }

    /// Place of a leaf.
    pub fn place(&self, id: Id) -> Option<InputPlace> {
        self.leaves.get(id.checked_sub(self.nodes.len())?).copied()
    }
}

/// Cost of an instruction by itself, in sixteenths of an addition.
fn alone<S>(instruction: &Instruction<S>) -> u32 {
    match instruction {
        // Products are fused with either sign.
        Instruction::Negate(_) => 0,
        Instruction::Divide(..) => 16 * 4,
        Instruction::SineCosine(_) => 16 * 10,
        Instruction::Call(..) | Instruction::Binary(..) | Instruction::Own(..) => 16 * 4,
        _ => 16,
    }
}
