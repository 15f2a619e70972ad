//! Limits of one graph: memory and time are bounded by counts, so that builds repeat.

use std::cell::Cell;

/// Nodes and edges that a derivation may have for each operation that its code may have, many times as many as any
/// scene that is known needs; and at least, where a `limit` is small. What is made of more would take gigabytes and
/// minutes.
const SIZE: [usize; 2] = [60, 600_000];
/// Before a number of operations is allowed: those of the usual limit.
const USUAL: usize = 3_000_000;

/// Products of terms that may be formed while a derivation multiplies out: three times as many as any scene that is
/// known needs; and as many rewritings of them. What would take more stays as it is.
const TERMS: u64 = 1_000_000;

/// Counts that are left.
#[derive(Clone)]
pub(in crate::algebra) struct Budget {
    /// Nodes and edges, and how many there may be.
    size: Cell<usize>,
    most: Cell<usize>,
    terms: Cell<u64>,
    rewritings: Cell<u64>,
}

impl Default for Budget {
    fn default() -> Self {
        let [terms, rewritings] = [TERMS; 2].map(Cell::new);
        Self { size: Cell::new(0), most: Cell::new(USUAL), terms, rewritings }
    }
}

impl Budget {
    /// Lets code of so many operations be derived.
    pub(super) fn allow(&self, operations: usize) {
        self.most.set(SIZE[1].max(operations.saturating_mul(SIZE[0])));
    }

    /// Lets no more than so many nodes and edges be made.
    #[cfg(test)]
    pub(super) fn restrict(&self, size: usize) {
        self.most.set(size);
    }

    /// Gives back what was taken since; what ran out in between is meaningless, and stays run out.
    pub(super) fn restore(&self, earlier: &Self) {
        if !self.is_exhausted() {
            self.size.set(earlier.size.get());
        }
        self.terms.set(earlier.terms.get());
        self.rewritings.set(earlier.rewritings.get());
    }

    pub(super) fn is_exhausted(&self) -> bool {
        self.size.get() >= self.most.get()
    }

    /// Takes a node with its edges.
    pub(super) fn count(&self, size: usize) {
        self.size.set(self.size.get().saturating_add(size));
    }

    /// Takes the work of multiplying terms; false when nothing is left.
    pub(in crate::algebra) fn may_multiply(&self, work: u64) -> bool {
        spend(&self.terms, work)
    }

    /// Takes the work of rewriting a term; false when nothing is left.
    pub(in crate::algebra) fn may_rewrite(&self, work: u64) -> bool {
        spend(&self.rewritings, work)
    }
}

fn spend(budget: &Cell<u64>, work: u64) -> bool {
    let left = budget.get();
    budget.set(left.saturating_sub(work));
    left > work
}
