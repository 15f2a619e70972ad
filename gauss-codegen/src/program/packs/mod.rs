//! Packs: instructions that are alike and wait for none of one another, done as one on vectors of four.
//!
//! After Larsen & Amarasinghe, Exploiting superword level parallelism with multimedia instruction sets (2000): from
//! outputs that stand side by side packs grow along operands, as long as the whole costs less (`cost`). What is
//! computed stays the same to the last bit: a lane of a vector is rounded as a number is, and what is fused stays so.
//!
//! | file | what it holds |
//! |---|---|
//! | `kinds` | what can be done to vectors, where operands are found |
//! | `graph` | code as a table of small numbers, which is quick to search |
//! | `partition` | code of which some is packed: how a pack is added, in which order all is then done |
//! | `cost` | what that costs |
//! | `limbs` | long code: packs of what is alike in limbs that are alike |
//! | `search` | which packs are made |

mod cost;
mod graph;
mod kinds;
mod limbs;
mod partition;
mod search;

use std::ops::Range;

use super::code::Code;
use super::instruction::Operand;
use graph::InstructionGraph;
pub(crate) use kinds::{InputPlace, LANES, Operation, PackedStep};
pub(crate) use limbs::{Leaf, in_place};

/// Instructions of code that is packed. A shorter one is all beginning and end; longer ones, chains of many joints,
/// have few sums in them that are alike term by term.
const LENGTHS: Range<usize> = 24..257;

/// Instructions that are one on vectors.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Pack<S> {
    pub operation: Operation,
    /// The instructions, two to four.
    pub lanes: Vec<usize>,
    /// Operand by operand those of the lanes.
    pub operands: Vec<Vec<Operand<S>>>,
}

/// Code of which some is packed.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PackedCode<S> {
    pub packs: Vec<Pack<S>>,
    pub steps: Vec<PackedStep>,
}

impl<S: Copy + PartialEq> Code<S> {
    /// Packs the code, where packs win. `place` gives the place of an input; `rows` of sines and cosines, each its
    /// first instruction and how many there are, stay together.
    pub(crate) fn packed(&self, place: impl Fn(S) -> InputPlace, rows: &[(usize, usize)]) -> Option<PackedCode<S>> {
        if !LENGTHS.contains(&self.instructions.len()) {
            return None;
        }
        let (graph, leaves) = InstructionGraph::of(self, place, rows);
        let best = search::best(&graph)?;
        let count = self.instructions.len();
        let operand = |&id: &usize| if id < count { Operand::Value(id) } else { leaves[id - count] };
        let mut places = Vec::new();
        let mut packs = Vec::new();
        for pack in &best.packs {
            places.push(packs.len());
            packs.extend(pack.as_ref().map(|pack| Pack {
                operation: pack.operation,
                lanes: pack.lanes().to_vec(),
                operands: pack.operands().map(|vector| vector.iter().map(operand).collect()).collect(),
            }));
        }
        let steps = best.steps()?.into_iter().map(|step| match step {
            PackedStep::Pack(pack) => PackedStep::Pack(places[pack]),
            other => other,
        });
        let packed = PackedCode { packs, steps: steps.collect() };
        debug_assert!(packed.computes(self), "packs that compute something else");
        Some(packed)
    }
}

impl<S: Copy + PartialEq> PackedCode<S> {
    /// Whether every instruction of the code is carried out once, on its own operands, after what it waits for.
    fn computes(&self, code: &Code<S>) -> bool {
        let mut done = vec![false; code.instructions.len()];
        let is_ready = |k: usize, done: &[bool]| {
            code.instructions[k].operands().filter_map(Operand::instruction).all(|operand| done[operand]) && !done[k]
        };
        for step in &self.steps {
            let lanes = match *step {
                PackedStep::Instruction(k) => vec![k],
                PackedStep::Angles(first, count) => (first..first + count).collect(),
                PackedStep::Pack(pack) => self.packs[pack].lanes.clone(),
            };
            if !lanes.iter().all(|&k| is_ready(k, &done)) {
                return false;
            }
            lanes.iter().for_each(|&k| done[k] = true);
        }
        let lane_is_right = |pack: &Pack<S>, lane: usize| {
            let instruction = &code.instructions[pack.lanes[lane]];
            let own: Vec<_> = instruction.operands().collect();
            let mut written: Vec<_> = pack.operands.iter().map(|vector| vector[lane]).collect();
            let same = written == own;
            if pack.operation.commutes() {
                written.swap(0, 1);
            }
            Operation::of(instruction) == Some(pack.operation) && (same || written == own)
        };
        let is_right = |pack: &Pack<S>| (0..pack.lanes.len()).all(|lane| lane_is_right(pack, lane));
        done.into_iter().all(|done| done) && self.packs.iter().all(is_right)
    }
}

#[cfg(test)]
pub(crate) mod tests;
