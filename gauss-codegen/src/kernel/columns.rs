//! Derivatives that are the solutions of one linear system, `x = A⁻¹ right` for every direction: what comes before is a
//! program, the substitution a loop over columns, which compilers carry out several at a time. Written out, it would be
//! most of the code of a tree with many joints.

use std::ops::Range;

use crate::algebra::{Expr, FactoredColumns, Map, Number, Rational};

use super::hoist::Hoister;
use super::write::{Operand, Program};

/// Columns that are carried through a substitution together: two or four registers.
pub const TOGETHER: usize = 8;

/// Products below which a substitution is written out: a loop would not be shorter than what it replaces.
const FEW: usize = 400;

/// Outputs whose derivatives are in part solutions of a linear system.
pub struct Columns<'g> {
    /// Outputs of the program: values; of every direction what is known or added to the solution; L below its diagonal;
    /// D⁻¹; the right-hand sides of the directions that have some.
    before: Vec<Expr<'g>>,
    shape: ColumnLayout,
}

/// Layout of the outputs.
#[derive(Clone)]
pub struct ColumnLayout {
    /// Numbers of all outputs, and of those at the beginning that are no solutions.
    pub height: usize,
    pub known: usize,
    pub directions: usize,
    /// The unknowns in the order of elimination.
    pub order: Vec<usize>,
    /// Rows below each pivot that are not zero.
    pub below: Vec<Vec<usize>>,
    /// Directions with right-hand sides.
    pub solved: Vec<usize>,
}

/// The same with a program.
pub struct LoweredColumns<'g> {
    /// Outputs as in [`Columns::before`].
    pub program: Program<'g>,
    pub shape: ColumnLayout,
}

impl<'g> Columns<'g> {
    /// Columns of which `added` has, for each direction, the derivatives of the known outputs, then what is added to
    /// the solution.
    pub fn new(
        values: Vec<Expr<'g>>,
        added: Vec<Expr<'g>>,
        known: usize,
        factors: FactoredColumns<'g>,
        rights: Vec<Vec<Expr<'g>>>,
    ) -> Self {
        let FactoredColumns { order, below, pivots } = factors;
        let there: Vec<usize> = (0..rights.len()).filter(|&d| rights[d].iter().any(|e| !e.is_zero())).collect();
        // Those that begin alike stand together: what is zero in all of them is left out.
        let first = |d: &usize| order.iter().position(|&i| !rights[*d][i].is_zero());
        let mut solved = there;
        solved.sort_by_key(first);
        let height = values.len();
        let directions = rights.len();
        let entries = below.iter().zip(&pivots).flat_map(|(column, pivot)| column.iter().map(|(_, e)| *e * *pivot));
        let entries: Vec<Expr<'g>> = entries.collect();
        let rights = solved.iter().flat_map(|&d| order.iter().map(|&i| rights[d][i]).collect::<Vec<_>>());
        let before = values.into_iter().chain(added).chain(entries).chain(pivots).chain(rights).collect();
        let below = below.iter().map(|column| column.iter().map(|(row, _)| *row).collect()).collect();
        Self { before, shape: ColumnLayout { height, known, directions, order, below, solved } }
    }

    /// None where the substitution is short.
    pub(super) fn lower(&self, hoister: &mut Hoister<'_, 'g>) -> Option<LoweredColumns<'g>> {
        let entries: usize = self.shape.below.iter().map(Vec::len).sum();
        if 2 * entries * self.shape.solved.len() < FEW {
            return None;
        }
        let program = Program::lower(&hoister.hoist(&self.before)).with_signs_led_back().carried_out();
        Some(LoweredColumns { program, shape: self.shape.clone() })
    }
}

/// The outputs of the program, part by part.
pub struct OutputParts<T> {
    pub values: Vec<T>,
    /// Derivatives of the known outputs, then what is added to the solution, of every direction.
    pub added: Vec<Vec<T>>,
    pub below: Vec<T>,
    pub pivots: Vec<T>,
    /// In the order of elimination, of every direction that is solved for.
    pub rights: Vec<Vec<T>>,
}

impl ColumnLayout {
    pub fn parts<T: Clone>(&self, outputs: &[T]) -> OutputParts<T> {
        let (values, rest) = outputs.split_at(self.height);
        let (added, rest) = rest.split_at(self.height * self.directions);
        let (below, rest) = rest.split_at(self.below.iter().map(Vec::len).sum());
        let (pivots, rights) = rest.split_at(self.order.len());
        let columns = |part: &[T], height: usize| part.chunks(height).map(<[T]>::to_vec).collect();
        OutputParts {
            values: values.to_vec(),
            added: columns(added, self.height),
            below: below.to_vec(),
            pivots: pivots.to_vec(),
            rights: columns(rights, self.order.len()),
        }
    }
}

impl ColumnLayout {
    /// Unknowns in a row that are eliminated together: what is below each of them are the rest of them and what is
    /// below the last. Nothing else leads into the middle.
    pub fn groups(&self) -> Vec<Range<usize>> {
        let count = self.order.len();
        let leading = |k: usize| self.below.iter().filter(|rows| rows.first() == Some(&k)).count();
        let goes_on = |k: usize| self.below[k].first() == Some(&(k + 1)) && self.below[k][1..] == self.below[k + 1];
        let ends = (0..count).filter(|&k| k + 1 == count || !goes_on(k) || leading(k + 1) > 1).map(|k| k + 1);
        ends.scan(0, |start, end| Some(std::mem::replace(start, end)..end)).collect()
    }
}

impl<'g> LoweredColumns<'g> {
    /// Tells for each bundle of columns and each group of unknowns whether its elimination would add nothing but zeros.
    pub fn idle(&self) -> Vec<Vec<bool>> {
        let zero = Operand::Number(Rational::zero());
        let rights = self.shape.parts(&self.program.outputs).rights;
        let groups = self.shape.groups();
        let bundle = |columns: &[Vec<Operand<'g>>]| {
            let mut idle: Vec<bool> =
                (0..self.shape.order.len()).map(|k| columns.iter().all(|column| column[k] == zero)).collect();
            for k in 0..idle.len() {
                if !idle[k] {
                    self.shape.below[k].iter().for_each(|&row| idle[row] = false);
                }
            }
            groups.iter().map(|group| idle[group.clone()].iter().all(|&idle| idle)).collect()
        };
        rights.chunks(TOGETHER).map(bundle).collect()
    }

    /// As the written code computes it: values, then derivatives, direction by direction.
    pub fn run<N: Number>(&self, symbols: &Map<u32, N>) -> Vec<N> {
        let ColumnLayout { known, order, below, solved, .. } = &self.shape;
        let OutputParts { mut values, mut added, below: multiples, pivots, rights } =
            self.shape.parts(&self.program.run(symbols));
        let starts: Vec<usize> =
            below.iter().scan(0, |sum, rows| Some(std::mem::replace(sum, *sum + rows.len()))).collect();
        for (mut x, &direction) in rights.into_iter().zip(solved) {
            for k in 0..x.len() {
                for (&row, multiple) in below[k].iter().zip(&multiples[starts[k]..]) {
                    x[row] = x[row] - *multiple * x[k];
                }
            }
            for k in (0..x.len()).rev() {
                x[k] = x[k] * pivots[k];
                for (&row, multiple) in below[k].iter().zip(&multiples[starts[k]..]) {
                    x[k] = x[k] - *multiple * x[row];
                }
            }
            for (&unknown, x) in order.iter().zip(x) {
                added[direction][known + unknown] = added[direction][known + unknown] + x;
            }
        }
        values.extend(added.into_iter().flatten());
        values
    }
}
