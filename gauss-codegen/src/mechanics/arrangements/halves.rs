//! Factors of the velocities of contact impulses, as numbers: A = LDLᵀ, eliminated joint by joint, and L⁻¹ of each row
//! of W.
//!
//! Of a tree a row of W has entries on the way from its link to the root, and so has L⁻¹ of it, where A⁻¹ fills all
//! limbs. D = W A⁻¹Wᵀ is a product of these halves (R. Featherstone 2010, "Exploiting sparsity in operational-space
//! dynamics"), and the velocities that impulses make are one substitution for all of them.

use crate::algebra::{Expr, FactoredColumns};

use crate::mechanics::arrangements::articulated::Articulated;
use crate::mechanics::links::tree::Tree;

/// The halves of A⁻¹Wᵀ, and symbols for all numbers in them.
pub struct Halves<'g> {
    factors: FactoredColumns<'g>,
    /// Entries of each row that are not zero, by the order of elimination.
    rows: Vec<Vec<(usize, Expr<'g>)>>,
    /// Symbols of the entries, and of an impulse for each row.
    pub symbols: Vec<Expr<'g>>,
    pub impulses: Vec<Expr<'g>>,
}

impl<'g> Halves<'g> {
    /// Halves of rows by the speeds of a tree; `None` where its joints are not moved by these.
    pub fn new(tree: &Tree<'g>, rows: &[Vec<Expr<'g>>]) -> Option<Self> {
        let joints = Articulated::eliminated(tree)?.joint_factors();
        let factors = joints.columns()?;
        let half = |row: &Vec<Expr<'g>>| {
            joints.halfway(row).into_iter().enumerate().filter(|(_, entry)| !entry.is_zero()).collect::<Vec<_>>()
        };
        let rows: Vec<_> = rows.iter().map(half).collect();
        let symbols = |letter: &str, count: usize| {
            let name = |k: usize| format!("{letter}{k}");
            (1..=count).map(|k| tree.graph.symbol(name(k), name(k), false)).collect::<Vec<_>>()
        };
        let count = factors.entries().count() + rows.iter().map(Vec::len).sum::<usize>();
        let (symbols, impulses) = (symbols("f", count), symbols("P", rows.len()));
        Some(Self { factors, rows, symbols, impulses })
    }

    /// Number of the entries of the factors: the pivots, one for each speed, then the entries below them.
    pub fn first_of_rows(&self) -> usize {
        self.factors.entries().count()
    }

    /// The numbers: of the factors, then of the rows.
    pub fn entries(&self) -> Vec<Expr<'g>> {
        let rows = self.rows.iter().flatten().map(|(_, entry)| *entry);
        self.factors.entries().chain(rows).collect()
    }

    /// D, row by row. It is symmetric: what is below its diagonal is not formed once more.
    pub fn delassus(&self) -> Vec<Expr<'g>> {
        let n = self.rows.len();
        let zero = self.symbols[0].graph().zero();
        let mut dense = vec![vec![[zero; 2]; self.factors.order.len()]; n];
        for (dense, row) in dense.iter_mut().zip(&self.rows) {
            row.iter().for_each(|&(k, entry)| dense[k] = [entry, (entry * self.factors.pivots[k]).group()]);
        }
        let entry = |i: usize, j: usize| dense[i].iter().zip(&dense[j]).map(|([x, _], [_, y])| *x * *y).sum();
        (0..n).flat_map(|i| (0..n).map(move |j| (i.min(j), i.max(j)))).map(|(i, j)| entry(i, j)).collect()
    }

    /// A⁻¹Wᵀ of impulses, from the numbers.
    pub fn velocities(&self, entries: &[Expr<'g>], impulses: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let (of_factors, of_rows) = entries.split_at(self.first_of_rows());
        let mut halfway = vec![self.symbols[0].graph().zero(); self.factors.order.len()];
        let rows =
            self.rows.iter().zip(impulses).flat_map(|(row, impulse)| row.iter().map(move |(k, _)| (*k, *impulse)));
        for ((k, impulse), entry) in rows.zip(of_rows) {
            halfway[k] = halfway[k] + *entry * impulse;
        }
        halfway.iter_mut().for_each(|e| *e = e.group());
        self.factors.with_entries(of_factors.iter().copied()).substitute_back(&halfway)
    }
}
