//! Size and depth of expressions, and their parts in order: parts before what is made of them.

use std::cell::RefCell;

use crate::algebra::expressions::graph::{Expr, Graph};
use crate::algebra::expressions::node::Id;
use crate::algebra::map::Set;

/// Levels that recursions go down at once.
const BAND: u32 = 400;

impl Graph {
    /// Lets code of so many operations be derived.
    pub fn allow(&self, operations: usize) {
        self.budget.allow(operations);
    }

    /// Takes work that makes no nodes: as much as they would be.
    pub fn spend(&self, work: usize) {
        self.budget.count(work);
    }

    /// Lets no more than so many nodes and edges be made.
    #[cfg(test)]
    pub fn restrict(&self, size: usize) {
        self.budget.restrict(size);
    }

    /// True once there is more than a derivation may have; everything that is made afterwards is zero, so that whatever
    /// is going on soon ends, and every result is meaningless.
    pub fn is_exhausted(&self) -> bool {
        self.budget.is_exhausted()
    }

    /// All that expressions are made of, they too; parts come before what is made of them.
    pub(in crate::algebra) fn reached(&self, roots: &[Id], parts: impl Fn(&Self, Id) -> Vec<Id>) -> Vec<Id> {
        let (mut seen, mut found, mut open) = (Set::default(), Vec::new(), roots.to_vec());
        while let Some(id) = open.pop() {
            if seen.insert(id) {
                found.push(id);
                open.extend(parts(self, id));
            }
        }
        found.sort_unstable();
        found
    }

    /// About how many operations expressions take together, each part computed once.
    pub fn operations(&self, outputs: &[Expr<'_>]) -> usize {
        let roots: Vec<Id> = outputs.iter().map(|e| e.id).collect();
        let children = |graph: &Self, id: Id| graph.node(id).children();
        self.reached(&roots, children).into_iter().map(|id| children(self, id).len()).sum()
    }

    /// The parts of a deep expression that a recursion visits first, inner parts before outer ones, so that it never
    /// goes down more than some levels at once and overflows the stack. `known` parts are left out. Empty for an
    /// expression that is not deep.
    fn stages(&self, root: Id, known: impl Fn(Id) -> bool) -> Vec<Id> {
        let band = |id: Id| self.depth(id) / BAND;
        if band(root) == 0 || known(root) {
            return Vec::new();
        }
        let stages = RefCell::new(Vec::new());
        self.reached(&[root], |graph, id| {
            if known(id) {
                return Vec::new();
            }
            let parts = graph.node(id).children();
            stages.borrow_mut().extend(parts.iter().filter(|&&part| band(part) < band(id) && !known(part)));
            parts
        });
        let mut stages = stages.into_inner();
        stages.sort_unstable();
        stages.dedup();
        stages
    }
}

impl<'g> Expr<'g> {
    /// Deep parts of it that are not `known`, for recursions to visit first.
    pub fn stages(self, known: impl Fn(u32) -> bool) -> Vec<Self> {
        self.graph.stages(self.id, known).into_iter().map(|id| self.graph.expr(id)).collect()
    }
}
