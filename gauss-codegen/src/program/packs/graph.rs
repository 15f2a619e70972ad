//! Code as a table of numbers.

use super::super::code::Code;
use super::super::instruction::{Instruction, Operand};
use super::kinds::{Operation, Place};

/// What an instruction works on: an earlier instruction by its index, or a leaf, counted on from the last instruction.
pub(super) type Id = usize;

/// An instruction.
pub(super) struct Node {
    /// What it does to vectors, if it can be packed.
    pub operation: Option<Operation>,
    /// The first so many of these.
    pub operands: [Id; 3],
    pub arity: usize,
    pub cycles: u32,
    /// By itself, as `cost` counts.
    pub cost: u32,
    /// Sines and cosines that are computed together: the first, and how many.
    pub row: Option<(usize, usize)>,
}

impl Node {
    pub fn operands(&self) -> &[Id] {
        &self.operands[..self.arity]
    }
}

/// What is no instruction.
pub(super) struct Leaf {
    pub place: Place,
    /// The sine and cosine that it is a part of.
    pub waits: Option<usize>,
}

/// Instructions, what they read, and outputs.
pub(super) struct Graph {
    pub nodes: Vec<Node>,
    pub leaves: Vec<Leaf>,
    pub outputs: Vec<Id>,
}

impl Graph {
    /// The table, and what its leaves are.
    pub fn of<S: Copy + PartialEq>(
        code: &Code<S>,
        place: impl Fn(S) -> Place,
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
        let mut nodes: Vec<Node> = Vec::with_capacity(count);
        for (k, instruction) in code.instructions.iter().enumerate() {
            let (mut operands, mut arity) = ([0; 3], 0);
            for operand in instruction.operands() {
                operands[arity] = id(operand);
                arity += 1;
            }
            let row = rows.iter().copied().find(|&(first, length)| (first..first + length).contains(&k));
            let (operation, cycles, cost) = (Operation::of(instruction), instruction.cycles(), alone(instruction));
            nodes.push(Node { operation, operands, arity, cycles, cost, row });
        }
        let outputs = code.outputs.iter().map(|&output| id(output)).collect();
        let leaf = |operand: &Operand<S>| match *operand {
            Operand::Input(input) => Leaf { place: place(input), waits: None },
            Operand::Number(_) => Leaf { place: Place::Constant, waits: None },
            part => Leaf { place: Place::Variable, waits: part.instruction() },
        };
        (Self { nodes, leaves: leaves.iter().map(leaf).collect(), outputs }, leaves)
    }

    /// Where a leaf is found.
    pub fn place(&self, id: Id) -> Option<Place> {
        Some(self.leaves.get(id.checked_sub(self.nodes.len())?)?.place)
    }

    /// The instruction that it is a result of.
    pub fn instruction(&self, id: Id) -> Option<usize> {
        id.checked_sub(self.nodes.len()).map_or(Some(id), |leaf| self.leaves[leaf].waits)
    }
}

/// What an instruction costs by itself, in sixteenths of an addition.
fn alone<S>(instruction: &Instruction<S>) -> u32 {
    match instruction {
        // Products are fused with either sign.
        Instruction::Negate(_) => 0,
        Instruction::Divide(..) => 16 * 4,
        Instruction::SineCosine(_) => 16 * 10,
        Instruction::Call(..) | Instruction::Binary(..) => 16 * 4,
        _ => 16,
    }
}
