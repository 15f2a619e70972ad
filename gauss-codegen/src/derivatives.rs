//! Derivatives as they are wanted: functions in equivalent arrangements, the directions along which they are
//! differentiated, and forms of the results that are known already.

use std::ops::Range;

use crate::algebra::{Expr, FactoredColumns};

/// The rates of the symbols that move, each a number, a symbol, or the negative of one. Others stand still.
pub type Direction<'g> = Vec<(Expr<'g>, Expr<'g>)>;

/// Functions and the directions along which their derivatives are wanted.
pub struct DirectionalDerivatives<'g> {
    /// The outputs, in equivalent arrangements.
    pub arrangements: Vec<Vec<Expr<'g>>>,
    /// Symbols that stand for expressions of the arguments, in the order of their definitions, and move by rates of
    /// their own.
    pub defined: Vec<Expr<'g>>,
    pub directions: Vec<Direction<'g>>,
    /// Forms of their own.
    pub derived: Vec<DerivativeForm<'g>>,
}

/// Outputs and their derivatives in a form of their own.
pub struct DerivativeForm<'g> {
    /// The outputs and then their derivatives, direction by direction.
    pub outputs: Vec<Expr<'g>>,
    /// The same, where the last step is a linear system with a right-hand side for each direction.
    pub columns: Option<Columns<'g>>,
}

/// A number and the directions along which its second derivatives are wanted: of i and j, j up to i, the mean of what
/// differentiating along i and then j gives, and along j and then i.
pub struct SecondDerivatives<'g> {
    /// The number, in equivalent arrangements.
    pub arrangements: Vec<Expr<'g>>,
    /// Symbols that stand for expressions of the arguments, in the order of their definitions, and move by rates of
    /// their own.
    pub defined: Vec<Expr<'g>>,
    pub directions: Vec<Direction<'g>>,
    /// Directions with the same number need not commute; those without one commute with all.
    pub groups: Vec<Option<usize>>,
    /// The second derivatives in forms of their own, in the order of [`Self::pairs`].
    pub derived: Vec<Vec<Expr<'g>>>,
}

impl<'g> SecondDerivatives<'g> {
    /// (i, j) of the outputs, j up to i.
    pub fn pairs(count: usize) -> impl Iterator<Item = (usize, usize)> {
        (0..count).flat_map(|i| (0..=i).map(move |j| (i, j)))
    }

    /// Whether differentiating along both gives the same in both orders.
    pub fn commute(&self, i: usize, j: usize) -> bool {
        i == j || self.groups[i].is_none() || self.groups[i] != self.groups[j]
    }
}

/// The derivatives of kinematics and then accelerations by parameters.
pub struct ParametricDerivatives<'g> {
    pub parameters: Vec<Expr<'g>>,
    /// The outputs of the kinematics in another order.
    pub order: Vec<usize>,
    /// Equation that the acceleration solves, where nothing else restricts it.
    pub equation: Option<Equation<'g>>,
    /// Derivatives of both in forms of their own, parameter by parameter.
    pub derived: Vec<Vec<Expr<'g>>>,
}

/// `gauss_residual = 0`, solved for the accelerations.
pub struct Equation<'g> {
    /// The accelerations in it.
    pub unknowns: Vec<Expr<'g>>,
    /// `velocity` is affine in these, with the inverse of the matrix of the residual.
    pub loads: Vec<Expr<'g>>,
}

/// Outputs whose derivatives are in part solutions of a linear system.
pub struct Columns<'g> {
    /// Outputs of the program: values; of every direction what is known or added to the solution; L below its diagonal;
    /// D⁻¹; the right-hand sides of the directions that have some.
    pub before: Vec<Expr<'g>>,
    pub shape: ColumnLayout,
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
