//! Which packs are made: they begin with outputs, and grow along what is read as long as the whole costs less.

use std::collections::HashSet;

use super::graph::{Id, InstructionGraph};
use super::kinds::LANES;
use super::partition::Partition;

/// The best that was found; nothing unless a tenth is gained, more than the cost is known to.
pub(super) fn best(graph: &InstructionGraph) -> Option<Partition<'_>> {
    let single = Partition::new(graph);
    let mut best = [3, 4].map(|width| begun(&single, width)).into_iter().min_by_key(|partition| partition.cost)?;
    let mut tried = HashSet::new();
    while let Some(better) = further(&best, &mut tried, patience(graph)) {
        best = better;
    }
    (best.cost * 10 < single.cost * 9).then_some(best)
}

/// Packs that are tried after one that was taken. What is alike grows with the code; with two and a half times its
/// length in place of three a vehicle of 236 instructions loses a tenth, with twice its length one of 176 as well.
fn patience(graph: &InstructionGraph) -> usize {
    graph.nodes.len() * 3
}

/// Packs that begin with outputs, so many in a row, or fewer.
fn begun<'c>(single: &Partition<'c>, width: usize) -> Partition<'c> {
    let mut partition = single.clone();
    let outputs = &single.graph.outputs;
    let mut at = 0;
    while at < outputs.len() {
        let widths = (2..=width.min(outputs.len() - at)).rev();
        let better = widths.filter_map(|width| Some((width, better(&partition, &outputs[at..at + width])?))).next();
        let (width, next) = better.map_or((1, None), |(width, next)| (width, Some(next)));
        partition = next.unwrap_or(partition);
        at += width;
    }
    partition
}

/// Adds one more pack, of those that were not `tried`.
fn further<'c>(partition: &Partition<'c>, tried: &mut HashSet<Vec<Id>>, patience: usize) -> Option<Partition<'c>> {
    let new = gathered(partition).chain(joined(partition)).filter(|ids| !tried.contains(ids));
    let new: Vec<_> = new.take(patience).collect();
    new.into_iter().find_map(|ids| {
        let better = better(partition, &ids);
        tried.insert(ids);
        better
    })
}

/// Adds a pack of these, and what grows from it, if that costs less.
fn better<'c>(partition: &Partition<'c>, ids: &[Id]) -> Option<Partition<'c>> {
    let is_instruction = |&id: &Id| id < partition.graph.nodes.len();
    if !ids.iter().all(is_instruction) {
        return None;
    }
    let mut grown = partition.with(ids)?;
    let pack = (*grown.packs.last()?)?;
    for vector in pack.operands() {
        grown = better(&grown, &distinct(vector)).unwrap_or(grown);
    }
    (grown.cost < partition.cost).then_some(grown)
}

fn distinct(vector: &[Id]) -> Vec<Id> {
    let mut ids = Vec::with_capacity(LANES);
    for &id in vector {
        if !ids.contains(&id) {
            ids.push(id);
        }
    }
    ids
}

/// Instructions that vectors are gathered from, with the packs that some of them are in already.
fn gathered(partition: &Partition<'_>) -> impl Iterator<Item = Vec<Id>> {
    let vectors = partition.packs.iter().flatten().flat_map(|pack| pack.operands());
    let with_packs = |vector: &[Id]| {
        let mut ids = Vec::with_capacity(LANES);
        for id in vector.iter().filter(|id| **id < partition.graph.nodes.len()) {
            ids.extend_from_slice(partition.pack_of(*id).map_or(&[*id], |(pack, _)| pack.lanes()));
        }
        distinct(&ids)
    };
    vectors.map(with_packs).filter(|ids| (2..=LANES).contains(&ids.len()))
}

/// Instructions that packs read one by one, by twos, and with shorter packs.
fn joined(partition: &Partition<'_>) -> impl Iterator<Item = Vec<Id>> {
    let count = partition.graph.nodes.len();
    let mut read = vec![false; count];
    let packs = || partition.packs.iter().flatten();
    packs().flat_map(|pack| pack.operands()).flatten().filter(|id| **id < count).for_each(|&id| read[id] = true);
    let single: Vec<Id> = (0..count).filter(|&id| read[id] && partition.of[id].is_none()).collect();
    let longer = packs().map(|pack| pack.lanes().to_vec()).filter(|lanes| lanes.len() < LANES);
    let begun: Vec<Vec<Id>> = longer.chain(single.iter().map(|&id| vec![id])).collect();
    begun.into_iter().flat_map(move |begun| {
        let alike = |id: &Id| {
            let other = begun[begun.len() - 1];
            (begun.len() > 1 || *id > other)
                && partition.graph.nodes[*id].operation == partition.graph.nodes[other].operation
        };
        let others: Vec<Id> = single.iter().copied().filter(alike).collect();
        others.into_iter().map(move |id| [begun.as_slice(), &[id]].concat())
    })
}
