//! Code of which some is packed: how a pack is added, in which order all is then done.

use super::graph::{Id, InstructionGraph, NOTHING};
use super::kinds::{InputPlace, LANES, Operation, PackedStep};

/// A pack, in numbers.
#[derive(Clone, Copy)]
pub(super) struct Lanes {
    pub operation: Operation,
    count: usize,
    lanes: [usize; LANES],
    arity: usize,
    operands: [[Id; LANES]; 3],
}

impl Lanes {
    pub fn lanes(&self) -> &[usize] {
        &self.lanes[..self.count]
    }

    pub fn operands(&self) -> impl Iterator<Item = &[Id]> {
        self.operands[..self.arity].iter().map(|vector| &vector[..self.count])
    }
}

/// Code and its packs.
#[derive(Clone)]
pub(super) struct Partition<'c> {
    pub graph: &'c InstructionGraph,
    /// Packs; those that were taken into longer ones are gone.
    pub packs: Vec<Option<Lanes>>,
    /// The pack of an instruction, and its lane.
    pub of: Vec<Option<(usize, usize)>>,
    /// Cost of the code: see `cost`.
    pub cost: u32,
}

impl<'c> Partition<'c> {
    /// Without packs.
    pub fn new(graph: &'c InstructionGraph) -> Self {
        let mut partition = Self { graph, packs: Vec::new(), of: vec![None; graph.nodes.len()], cost: 0 };
        partition.cost = partition.counted().unwrap_or(u32::MAX);
        partition
    }

    /// Makes these instructions one pack; packs that lie within are taken into it. Nothing where they are not alike,
    /// one is in another pack, or they wait for one another.
    pub fn with(&self, lanes: &[usize]) -> Option<Self> {
        if !(2..=LANES).contains(&lanes.len()) || (1..lanes.len()).any(|k| lanes[..k].contains(&lanes[k])) {
            return None;
        }
        let operation = self.graph.nodes[lanes[0]].operation?;
        let may_join = |&k: &usize| {
            let free = self.pack_of(k).is_none_or(|(pack, _)| {
                let inner = pack.lanes();
                inner.len() < lanes.len() && inner.iter().all(|lane| lanes.contains(lane))
            });
            free && self.graph.nodes[k].operation == Some(operation)
        };
        if !lanes.iter().all(may_join) {
            return None;
        }
        let mut next = self.clone();
        let index = next.packs.len();
        let operands = self.side_by_side(operation, lanes);
        for (lane, &k) in lanes.iter().enumerate() {
            if let Some((inner, _)) = next.of[k].replace((index, lane))
                && inner != index
            {
                next.packs[inner] = None;
            }
        }
        let mut all = [0; LANES];
        all[..lanes.len()].copy_from_slice(lanes);
        let arity = self.graph.nodes[lanes[0]].arity;
        next.packs.push(Some(Lanes { operation, count: lanes.len(), lanes: all, arity, operands }));
        next.cost = next.counted()?;
        Some(next)
    }

    /// The pack of an instruction, and its lane.
    pub fn pack_of(&self, id: Id) -> Option<(&Lanes, usize)> {
        let (pack, lane) = (*self.of.get(id)?)?;
        Some((self.packs[pack].as_ref()?, lane))
    }

    /// Operand by operand those of the lanes. Where two may change places, what is alike comes side by side.
    fn side_by_side(&self, operation: Operation, lanes: &[usize]) -> [[Id; LANES]; 3] {
        let mut vectors = [[0; LANES]; 3];
        let mut first = [0; 3];
        for (lane, &k) in lanes.iter().enumerate() {
            let mut own = self.graph.nodes[k].operands;
            if operation.commutes() {
                let changes = if lane == 0 {
                    self.kind(own[1]) < self.kind(own[0])
                } else {
                    let kept = self.likeness(first[0], own[0]) + self.likeness(first[1], own[1]);
                    self.likeness(first[0], own[1]) + self.likeness(first[1], own[0]) > kept
                };
                if changes {
                    own.swap(0, 1);
                }
            }
            if lane == 0 {
                first = own;
            }
            (0..3).for_each(|operand| vectors[operand][lane] = own[operand]);
        }
        vectors
    }

    fn kind(&self, id: Id) -> u32 {
        match self.graph.place(id) {
            Some(InputPlace::Constant) => 0,
            Some(InputPlace::Argument { .. }) => 1,
            Some(InputPlace::Variable) => 3,
            None => 2,
        }
    }

    fn likeness(&self, a: Id, b: Id) -> u32 {
        if self.kind(a) != self.kind(b) {
            return 0;
        }
        let alike = match (self.graph.place(a), self.graph.place(b)) {
            (Some(InputPlace::Argument { array, .. }), Some(InputPlace::Argument { array: other, .. })) => {
                u32::from(array == other)
            }
            (None, None) => {
                let packed = matches!((self.of[a], self.of[b]), (Some((p, _)), Some((q, _))) if p == q);
                8 * u32::from(packed) + u32::from(self.graph.nodes[a].operation == self.graph.nodes[b].operation)
            }
            _ => 1,
        };
        2 + alike + 2 * u32::from(a == b)
    }

    /// Order of the steps; nothing where packs wait for one another in a circle.
    pub fn steps(&self) -> Option<Vec<PackedStep>> {
        let count = self.graph.nodes.len();
        let mut visit = Visit { steps: Vec::with_capacity(count), state: vec![VisitState::New; count] };
        (0..count).try_for_each(|k| self.visit(k, &mut visit))?;
        Some(visit.steps)
    }

    /// Visits what it waits for, then itself. Most of a search is spent here, unoptimised in macros: no calls for what
    /// is done.
    fn visit(&self, k: usize, visit: &mut Visit) -> Option<()> {
        match visit.state[k] {
            VisitState::Done => return Some(()),
            VisitState::Begun => return None,
            VisitState::New => {}
        }
        let (mut own, mut count) = ([k; 8], 1);
        let step = match (self.of[k], self.graph.nodes[k].row) {
            (Some((index, _)), _) => {
                let pack = self.packs[index].as_ref()?;
                count = pack.count;
                own[..count].copy_from_slice(pack.lanes());
                PackedStep::Pack(index)
            }
            (_, Some((first, length))) => {
                count = length.min(own.len());
                (0..count).for_each(|k| own[k] = first + k);
                PackedStep::Angles(first, count)
            }
            _ => PackedStep::Instruction(k),
        };
        for &k in &own[..count] {
            visit.state[k] = VisitState::Begun;
        }
        for &k in &own[..count] {
            self.visit_operands(k, visit)?;
        }
        for &k in &own[..count] {
            visit.state[k] = VisitState::Done;
        }
        visit.steps.push(step);
        Some(())
    }

    fn visit_operands(&self, k: usize, visit: &mut Visit) -> Option<()> {
        let node = &self.graph.nodes[k];
        let mut operand = 0;
        while operand < node.arity {
            let before = self.graph.waits[node.operands[operand]];
            if before != NOTHING && visit.state[before] != VisitState::Done {
                self.visit(before, visit)?;
            }
            operand += 1;
        }
        Some(())
    }
}

#[derive(Clone, Copy, PartialEq)]
enum VisitState {
    New,
    Begun,
    Done,
}

struct Visit {
    steps: Vec<PackedStep>,
    state: Vec<VisitState>,
}
