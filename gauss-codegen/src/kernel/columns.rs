//! Derivatives that are the solutions of one linear system, `x = A⁻¹ right` for every direction: what comes before is a
//! program, the substitution a loop over columns, which compilers carry out several at a time. Written out, it would be
//! most of the code of a tree with many joints.

use crate::algebra::{Map, Number, Rational};
use crate::derivatives::{ColumnLayout, Columns, OutputParts};

use super::hoist::Hoister;
use super::write::{Operand, Program};

/// Columns that are carried through a substitution together: two or four registers.
pub const TOGETHER: usize = 8;

/// Products below which a substitution is written out: a loop would not be shorter than what it replaces.
const FEW: usize = 400;

/// Columns with the program of what comes before the substitution.
pub struct LoweredColumns<'g> {
    /// Outputs as in [`Columns::before`].
    pub program: Program<'g>,
    pub shape: ColumnLayout,
}

impl<'g> Columns<'g> {
    /// None where the substitution is short.
    pub(super) fn lower(&self, hoister: &mut Hoister<'_, 'g>) -> Option<LoweredColumns<'g>> {
        let entries: usize = self.shape.below.iter().map(Vec::len).sum();
        if 2 * entries * self.shape.solved.len() < FEW {
            return None;
        }
        let program = hoister.program(&self.before).signed(hoister.passes).carried_out(hoister.passes);
        Some(LoweredColumns { program, shape: self.shape.clone() })
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
