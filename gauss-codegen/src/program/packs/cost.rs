//! Cost of packed code, in sixteenths of an addition: what processors start, and a little for the longest chain.
//!
//! Fog, Instruction tables; checked by `cargo bench -p gauss-benches --bench packs`.

use super::graph::{Id, NOTHING};
use super::kinds::{InputPlace, LANES, Operation, PackedStep};
use super::partition::Partition;

/// An addition or a product, of vectors.
const ARITHMETIC: u32 = 16;
/// Lanes of a vector brought to other places, or lanes of two into one.
const SHUFFLE: u32 = 16;
/// A number from memory in all lanes.
const SPREAD: u32 = 4;
/// A number out of another lane than the first.
const EXTRACT: u32 = 12;
/// The same, stored.
const STORE: u32 = 8;
/// A cycle of the longest chain: calls overlap, but for what waits for them.
const CYCLE: u32 = 4;
/// Cycles that a load waits longer where it reads together what was just stored in pieces, as states are.
const FORWARDED_CYCLES: u32 = 16;
/// Cycles of a shuffle across a vector.
const SHUFFLE_CYCLES: u32 = 3;

/// Cost of having an operand in a vector.
#[derive(Clone, Copy)]
struct OperandCost {
    cost: u32,
    cycles: u32,
}

const FREE: OperandCost = OperandCost { cost: 0, cycles: 0 };

impl Partition<'_> {
    /// Cost of the code; nothing where packs wait for one another in a circle.
    pub fn counted(&self) -> Option<u32> {
        let steps = self.steps()?;
        let mut ready = vec![0_u32; self.of.len()];
        let mut taken_out = vec![false; self.of.len()];
        let mut made: Vec<[Id; LANES]> = Vec::new();
        let mut cost = 0;
        for step in steps {
            match step {
                PackedStep::Instruction(k) => cost += self.single(k, &mut ready, &mut taken_out),
                PackedStep::Angles(first, count) => {
                    cost += (first..first + count).map(|k| self.single(k, &mut ready, &mut taken_out)).sum::<u32>();
                }
                PackedStep::Pack(pack) => cost += self.packed(pack, &mut ready, &mut made),
            }
        }
        let chain = self.graph.outputs.iter().map(|&output| self.ready(output, &ready)).max().unwrap_or(0);
        let taken_out = taken_out.into_iter().filter(|&out| out).count() as u32;
        Some(cost + EXTRACT * taken_out + self.handed_over() + CYCLE * chain)
    }

    fn ready(&self, id: Id, ready: &[u32]) -> u32 {
        match self.graph.waits[id] {
            NOTHING => 0,
            k => ready[k],
        }
    }

    fn single(&self, k: usize, ready: &mut [u32], taken_out: &mut [bool]) -> u32 {
        let node = &self.graph.nodes[k];
        let (mut start, mut operand) = (0, 0);
        while operand < node.arity {
            let id = node.operands[operand];
            let mut there = self.ready(id, ready);
            if id < self.of.len() && matches!(self.of[id], Some((_, 1..))) {
                taken_out[id] = true;
                there += SHUFFLE_CYCLES;
            }
            if there > start {
                start = there;
            }
            operand += 1;
        }
        ready[k] = start + node.cycles;
        node.cost
    }

    /// `made` has the vectors that are there already.
    fn packed(&self, pack: usize, ready: &mut [u32], made: &mut Vec<[Id; LANES]>) -> u32 {
        let Some(pack) = &self.packs[pack] else { return 0 };
        let mut cost = if pack.operation == Operation::Negate { 0 } else { ARITHMETIC };
        let mut start = 0;
        for vector in pack.operands() {
            let source = self.source(vector);
            if source.cost > 0 {
                let mut padded = [usize::MAX; LANES];
                padded[..vector.len()].copy_from_slice(vector);
                if !made.contains(&padded) {
                    made.push(padded);
                    cost += source.cost;
                }
            }
            let last = vector.iter().map(|&operand| self.ready(operand, ready)).max().unwrap_or(0);
            start = start.max(last + source.cycles);
        }
        pack.lanes().iter().for_each(|&k| ready[k] = start + self.graph.nodes[k].cycles);
        cost
    }

    /// Outputs: vectors that are a row of them are stored at once.
    fn handed_over(&self) -> u32 {
        let outputs = &self.graph.outputs;
        let (mut at, mut cost) = (0, 0);
        while at < outputs.len() {
            let is_row = |lanes: &[usize]| outputs[at..].starts_with(lanes);
            match self.pack_of(outputs[at]) {
                Some((pack, 0)) if is_row(pack.lanes()) => at += pack.lanes().len(),
                of => {
                    cost += if of.is_some() { STORE } else { 0 };
                    at += 1;
                }
            }
        }
        cost
    }

    fn source(&self, vector: &[Id]) -> OperandCost {
        let shuffle = OperandCost { cost: SHUFFLE, cycles: SHUFFLE_CYCLES };
        if vector.iter().all(|&id| id == vector[0]) {
            let is_loaded =
                matches!(self.graph.place(vector[0]), Some(InputPlace::Constant | InputPlace::Argument { .. }));
            return if is_loaded { OperandCost { cost: SPREAD, cycles: 0 } } else { shuffle };
        }
        if vector.iter().all(|&id| self.graph.place(id) == Some(InputPlace::Constant)) {
            return FREE;
        }
        self.neighbours(vector).unwrap_or_else(|| self.gathered(vector))
    }

    /// Elements of one array that lie side by side.
    fn neighbours(&self, vector: &[Id]) -> Option<OperandCost> {
        let mut places = [(0, 0); LANES];
        for (place, &id) in places.iter_mut().zip(vector) {
            *place = match self.graph.place(id)? {
                InputPlace::Argument { array, index } => (array, index),
                _ => return None,
            };
        }
        let places = &places[..vector.len()];
        let indices = || places.iter().map(|place| place.1);
        let is_close = indices().max()? < indices().min()? + LANES && places.iter().all(|place| place.0 == places[0].0);
        let in_order = places.windows(2).all(|pair| pair[0].1 + 1 == pair[1].1);
        is_close.then_some(OperandCost { cost: if in_order { 0 } else { SHUFFLE }, cycles: FORWARDED_CYCLES })
    }

    /// Lanes of other vectors, and numbers.
    fn gathered(&self, vector: &[Id]) -> OperandCost {
        let (mut shuffles, mut parts) = (0, 0);
        for (lane, &id) in vector.iter().enumerate() {
            let Some((pack, at)) = self.of.get(id).copied().flatten() else {
                parts += u32::from(!vector[..lane].contains(&id));
                continue;
            };
            let same = |&other: &Id| self.of.get(other).copied().flatten().filter(|(of, _)| *of == pack);
            if vector[..lane].iter().any(|other| same(other).is_some()) {
                continue;
            }
            parts += 1;
            let moved = |(lane, other): (usize, &Id)| same(other).is_some_and(|(_, at)| at != lane);
            shuffles += u32::from(at != lane || vector.iter().enumerate().any(moved));
        }
        let blends = parts - 1;
        OperandCost { cost: SHUFFLE * (shuffles + blends), cycles: SHUFFLE_CYCLES * (shuffles.min(1) + blends.min(2)) }
    }
}
