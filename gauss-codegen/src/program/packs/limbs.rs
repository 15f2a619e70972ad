//! Packs of long code: what is alike in limbs that are alike.
//!
//! Inputs say which limb they belong to, and to what they are alike in the other limbs. An instruction belongs to the
//! limb that its operands belong to; those of several limbs belong to none. Two instructions are alike where they do
//! the same with operands that are alike, or that are the same and belong to no limb. So lanes are known, and packs
//! need not be searched for: one pass finds them, as many as there are instructions in a limb.

use std::collections::HashMap;

use crate::algebra::{Key, joined};

use super::super::code::Code;
use super::super::instruction::Operand;
use super::super::order::order_of;
use super::kinds::{Operation, PackedStep};
use super::{Pack, PackedCode};

/// Relation of an input to a limb.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Leaf {
    /// Class that is the same for inputs that are alike.
    pub class: u64,
    pub limb: usize,
    /// The lane of the limb, and how many limbs are alike.
    pub lane: usize,
    pub lanes: usize,
}

/// Leaf that an operand is alike to, if it belongs to one limb.
pub(crate) type Likeness = Option<Leaf>;

/// Number of rounds in which packs that do not pay are dropped: each that is makes those beside it dearer.
const ROUNDS: usize = 8;

impl<S: Copy + Key> Code<S> {
    /// Likeness of each output.
    pub(crate) fn likeness_of_outputs(&self, leaf: impl Fn(S) -> Likeness) -> Vec<Likeness> {
        let tags = self.likeness(&leaf);
        self.outputs.iter().map(|&output| of_operand(output, &tags, &leaf)).collect()
    }

    /// Likeness of each instruction.
    fn likeness(&self, leaf: &impl Fn(S) -> Likeness) -> Vec<Likeness> {
        let mut tags: Vec<Likeness> = Vec::with_capacity(self.instructions.len());
        for instruction in &self.instructions {
            let mut own: Likeness = None;
            let mut several = false;
            let mut words = [0; 8];
            let mut count = 0;
            for operand in instruction.operands() {
                let tag = of_operand(operand, &tags, leaf);
                several |= matches!((own, tag), (Some(a), Some(b)) if a.limb != b.limb);
                own = own.or(tag);
                words[count] = word_of(operand, tag);
                count += 1;
            }
            if Operation::of(instruction).is_some_and(Operation::commutes) && words[1] < words[0] {
                words.swap(0, 1);
            }
            let kind = instruction.map(|_| Operand::<S>::Value(0)).word();
            let class = words[..count].iter().fold(kind, |class, &word| joined(class, word));
            tags.push(own.filter(|_| !several).map(|own| Leaf { class, ..own }));
        }
        tags
    }

    /// Packs instructions that are alike in limbs; `rows` of sines and cosines, each its first instruction and how many
    /// there are, stay together. Nothing where they take away less than a tenth of all steps.
    pub(crate) fn with_limbs_together(
        &self,
        leaf: impl Fn(S) -> Likeness,
        rows: &[(usize, usize)],
    ) -> Option<PackedCode<S>> {
        let tags = self.likeness(&leaf);
        let mut packs = self.alike(&tags);
        packs.iter_mut().for_each(|pack| self.bring_side_by_side(pack, &tags, &leaf));
        self.keep_those_that_pay(&mut packs);
        if packs.is_empty() {
            return None;
        }
        let steps = self.steps_of(&packs, rows)?;
        let packed = PackedCode { steps, packs };
        let pays = packed.steps.len() * 10 <= self.instructions.len() * 9;
        (pays && packed.computes(self)).then_some(packed)
    }

    /// Instructions that are alike, one of each limb.
    fn alike(&self, tags: &[Likeness]) -> Vec<Pack<S>> {
        let mut places: HashMap<u64, usize> = HashMap::new();
        let mut classes: Vec<Vec<Vec<usize>>> = Vec::new();
        for (k, instruction) in self.instructions.iter().enumerate() {
            let (Some(tag), Some(_)) = (tags[k], Operation::of(instruction)) else { continue };
            let place = *places.entry(tag.class).or_insert_with(|| {
                classes.push(vec![Vec::new(); tag.lanes]);
                classes.len() - 1
            });
            if let Some(lane) = classes[place].get_mut(tag.lane) {
                lane.push(k);
            }
        }
        let mut packs = Vec::new();
        for lanes in classes {
            let whole = lanes.iter().map(Vec::len).min().unwrap_or(0);
            for k in 0..whole {
                let lanes: Vec<usize> = lanes.iter().map(|lane| lane[k]).collect();
                let operation = Operation::of(&self.instructions[lanes[0]]);
                packs.extend(operation.map(|operation| Pack { operation, lanes, operands: Vec::new() }));
            }
        }
        packs
    }

    /// Operand by operand those of the lanes: what is alike side by side.
    fn bring_side_by_side(&self, pack: &mut Pack<S>, tags: &[Likeness], leaf: &impl Fn(S) -> Likeness) {
        let own = |k: usize| self.instructions[k].operands().collect::<Vec<_>>();
        let words = |operands: &[Operand<S>]| {
            operands.iter().map(|&operand| word_of(operand, of_operand(operand, tags, leaf))).collect::<Vec<_>>()
        };
        let first = words(&own(pack.lanes[0]));
        let mut operands = vec![Vec::with_capacity(pack.lanes.len()); first.len()];
        for &k in &pack.lanes {
            let mut own = own(k);
            if pack.operation.commutes() && words(&own) != first {
                own.swap(0, 1);
            }
            operands.iter_mut().zip(own).for_each(|(vector, operand)| vector.push(operand));
        }
        pack.operands = operands;
    }

    /// Packs that cost less than their instructions, with what it takes to bring operands into vectors and to take
    /// lanes apart.
    fn keep_those_that_pay(&self, packs: &mut Vec<Pack<S>>) {
        for _ in 0..ROUNDS {
            let of = places(packs, self.instructions.len());
            let mut apart = vec![false; packs.len()];
            let mut note = |operand: Operand<S>| {
                if let Some((pack, _)) = operand.instruction().and_then(|k| of[k]) {
                    apart[pack] = true;
                }
            };
            let single = self.instructions.iter().enumerate().filter(|(k, _)| of[*k].is_none());
            single.flat_map(|(_, instruction)| instruction.operands()).for_each(&mut note);
            let vectors = || packs.iter().flat_map(|pack| &pack.operands);
            vectors().filter(|vector| !is_free(vector, &of)).flatten().copied().for_each(&mut note);
            // What is dropped would be gathered for whoever reads it as it is.
            let mut awaited = vec![false; packs.len()];
            vectors().filter_map(|vector| in_place(vector, &of)).for_each(|pack| awaited[pack] = true);
            let hashed = |vector: &[Operand<S>]| vector.iter().fold(0, |word, operand| joined(word, operand.word()));
            let mut shared: HashMap<u64, u32> = HashMap::new();
            vectors().for_each(|vector| *shared.entry(hashed(vector)).or_default() += 1);
            let pays = |(p, pack): (usize, &Pack<S>)| {
                let less = 16 * (pack.lanes.len() as u32 - 1);
                let gathered = |vector: &Vec<Operand<S>>| {
                    let each = if vector.iter().all(|operand| *operand == vector[0]) { 16 } else { less };
                    if is_free(vector, &of) { 0 } else { each / shared[&hashed(vector)].max(1) }
                };
                let cost: u32 = pack.operands.iter().map(gathered).sum();
                // Without it, what it reads as it is would be taken apart.
                let whole = |vector: &&Vec<Operand<S>>| in_place(vector, &of).is_some_and(|pack| !apart[pack]);
                let saved = 1 + u32::from(awaited[p]) + pack.operands.iter().filter(whole).count() as u32;
                less * saved >= cost + less * u32::from(apart[p])
            };
            let keep: Vec<bool> = packs.iter().enumerate().map(pays).collect();
            if keep.iter().all(|keep| *keep) {
                return;
            }
            let mut keep = keep.into_iter();
            packs.retain(|_| keep.next().unwrap_or(false));
        }
    }

    /// Order of the steps: packs, rows of angles and single instructions as a program of its own is ordered.
    fn steps_of(&self, packs: &[Pack<S>], rows: &[(usize, usize)]) -> Option<Vec<PackedStep>> {
        let count = self.instructions.len();
        let of = places(packs, count);
        let mut node_of = vec![usize::MAX; count];
        let mut steps: Vec<(PackedStep, Vec<usize>)> = Vec::new();
        for k in 0..count {
            if node_of[k] != usize::MAX {
                continue;
            }
            let row = rows.iter().find(|(first, length)| (*first..first + length).contains(&k));
            let (step, own) = match (of[k], row) {
                (Some((pack, _)), _) => (PackedStep::Pack(pack), packs[pack].lanes.clone()),
                (_, Some(&(first, length))) => (PackedStep::Angles(first, length), (first..first + length).collect()),
                _ => (PackedStep::Instruction(k), vec![k]),
            };
            own.iter().for_each(|&k| node_of[k] = steps.len());
            steps.push((step, own));
        }
        let reads = |own: &[usize]| {
            let operands = own.iter().flat_map(|&k| self.instructions[k].operands());
            let mut reads: Vec<usize> = operands.filter_map(Operand::instruction).map(|k| node_of[k]).collect();
            reads.sort_unstable();
            reads.dedup();
            reads
        };
        let reads: Vec<Vec<usize>> = steps.iter().map(|(_, own)| reads(own)).collect();
        let order = in_order(&reads)?;
        let mut places = vec![0; order.len()];
        order.iter().enumerate().for_each(|(place, &node)| places[node] = place);
        let moved = |node: &usize| {
            let mut own: Vec<usize> = reads[*node].iter().map(|&read| places[read]).collect();
            own.sort_unstable();
            own
        };
        let cycles = |node: &usize| steps[*node].1.iter().map(|&k| self.instructions[k].cycles()).max().unwrap_or(0);
        let scheduled = order_of(order.iter().map(moved).collect(), order.iter().map(cycles).collect());
        Some(scheduled.into_iter().map(|place| steps[order[place]].0).collect())
    }
}

impl<S> PackedCode<S> {
    /// The pack of each of so many instructions, and its lane.
    pub(crate) fn places(&self, count: usize) -> Vec<Option<(usize, usize)>> {
        places(&self.packs, count)
    }
}

/// An order in which each comes after what it reads; nothing where they wait for one another in a circle.
fn in_order(reads: &[Vec<usize>]) -> Option<Vec<usize>> {
    let mut readers = vec![Vec::new(); reads.len()];
    let mut open: Vec<usize> = reads.iter().map(Vec::len).collect();
    for (node, read) in reads.iter().enumerate() {
        read.iter().for_each(|&other| readers[other].push(node));
    }
    let mut order: Vec<usize> = (0..reads.len()).filter(|&node| open[node] == 0).collect();
    let mut next = 0;
    while next < order.len() {
        for &reader in &readers[order[next]] {
            open[reader] -= 1;
            if open[reader] == 0 {
                order.push(reader);
            }
        }
        next += 1;
    }
    (order.len() == reads.len()).then_some(order)
}

/// The pack of each instruction, and its lane.
fn places<S>(packs: &[Pack<S>], count: usize) -> Vec<Option<(usize, usize)>> {
    let mut of = vec![None; count];
    for (p, pack) in packs.iter().enumerate() {
        pack.lanes.iter().enumerate().for_each(|(lane, &k)| of[k] = Some((p, lane)));
    }
    of
}

/// The pack of which these are the lanes, in their order.
pub(crate) fn in_place<S: Copy>(vector: &[Operand<S>], of: &[Option<(usize, usize)>]) -> Option<usize> {
    let place = |operand: &Operand<S>| if let Operand::Value(k) = *operand { of[k] } else { None };
    let (pack, _) = place(&vector[0])?;
    (0..vector.len()).all(|lane| place(&vector[lane]) == Some((pack, lane))).then_some(pack)
}

/// Whether a vector is there, or is read from memory: lanes of one pack in their order, constants.
fn is_free<S: Copy + PartialEq>(vector: &[Operand<S>], of: &[Option<(usize, usize)>]) -> bool {
    in_place(vector, of).is_some()
        || vector.iter().all(|operand| matches!(operand, Operand::Input(_) | Operand::Number(_)))
}

fn of_operand<S: Copy>(operand: Operand<S>, tags: &[Likeness], leaf: &impl Fn(S) -> Likeness) -> Likeness {
    match operand {
        Operand::Input(input) => leaf(input),
        Operand::Number(_) => None,
        Operand::Value(k) | Operand::Sine(k) | Operand::Cosine(k) => tags[k],
    }
}

/// The same of operands that are alike.
fn word_of<S: Copy + Key>(operand: Operand<S>, tag: Likeness) -> u64 {
    let kind = match operand {
        Operand::Input(_) => 1,
        Operand::Number(_) => 2,
        Operand::Value(_) => 3,
        Operand::Sine(_) => 4,
        Operand::Cosine(_) => 5,
    };
    tag.map_or_else(|| joined(6, operand.word()), |tag| joined(kind, tag.class))
}
