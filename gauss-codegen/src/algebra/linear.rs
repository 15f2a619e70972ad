//! Small linear systems with symbolic entries.

use crate::algebra::expressions::graph::{Expr, NodeView};
use crate::algebra::map::Map;

/// Terms that an entry may have while a determinant is brought to normal form.
const LIMIT: usize = 400;
/// Nodes and terms up to which it is looked for whether a product is left of two pivots.
const SHORT: usize = 32;

/// A linear system whose elimination has been worked out, to be solved for several right-hand sides.
///
/// Rows with one unknown left are solved at once, again and again; what remains is solved block by block with cofactors
/// in normal form, so that determinants such as `sin²θ·… + cos²θ·…` collapse before they are divided by.
pub struct Solver<'g> {
    matrix: Vec<Vec<Expr<'g>>>,
    steps: Vec<BlockPivot<'g>>,
}

/// Rows and unknowns that are solved together, and the inverse of their block.
struct BlockPivot<'g> {
    rows: Vec<usize>,
    unknowns: Vec<usize>,
    inverse: Vec<Vec<Expr<'g>>>,
}

impl<'g> Solver<'g> {
    /// `None` when the matrix is singular.
    pub fn new(matrix: Vec<Vec<Expr<'g>>>) -> Option<Self> {
        let whole = matrix.len();
        Self::with_blocks_up_to(matrix, whole)
    }

    /// `None` also when more unknowns than so many have to be solved for together.
    pub fn with_blocks_up_to(matrix: Vec<Vec<Expr<'g>>>, most: usize) -> Option<Self> {
        let mut rows: Vec<usize> = (0..matrix.len()).collect();
        let mut solved: Vec<usize> = Vec::new();
        let mut steps = Vec::new();
        while !rows.is_empty() {
            let unknowns = |row: usize| -> Vec<usize> {
                (0..matrix.len()).filter(|j| !solved.contains(j) && !matrix[row][*j].is_zero()).collect()
            };
            let (block_rows, block_unknowns) = match rows.iter().find(|&&row| unknowns(row).len() == 1) {
                Some(&row) => (vec![row], unknowns(row)),
                None => smallest_block(&rows, unknowns)?,
            };
            let block: Vec<Vec<Expr<'g>>> =
                block_rows.iter().map(|&i| block_unknowns.iter().map(|&j| matrix[i][j]).collect()).collect();
            if block_rows.len() > most {
                return None;
            }
            rows.retain(|row| !block_rows.contains(row));
            solved.extend(&block_unknowns);
            steps.push(BlockPivot {
                rows: block_rows,
                unknowns: block_unknowns,
                inverse: inverse_by_cofactors(&block)?,
            });
        }
        Some(Self { matrix, steps })
    }

    /// x with `Σ_j matrix[i][j] x_j = right[i]`.
    pub fn solve(&self, right: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let n = right.len();
        let mut solution: Vec<Option<Expr<'g>>> = vec![None; n];
        for step in &self.steps {
            // What is known so far goes to the right.
            let reduced = |row: usize| -> Expr<'g> {
                let known = (0..n).filter_map(|j| solution[j].map(|x| self.matrix[row][j] * x));
                known.fold(right[row], |sum, e| sum - e)
            };
            let reduced: Vec<Expr<'g>> = step.rows.iter().map(|&row| reduced(row)).collect();
            for (row, &unknown) in step.inverse.iter().zip(&step.unknowns) {
                let value: Expr<'g> = row.iter().zip(&reduced).map(|(m, r)| *m * *r).sum();
                solution[unknown] = Some(if step.rows.len() > 1 { value.group() } else { value });
            }
        }
        solution.into_iter().flatten().collect()
    }
}

/// The smallest set of rows that holds as many unknowns as it has rows, grown greedily from each row.
fn smallest_block(rows: &[usize], unknowns: impl Fn(usize) -> Vec<usize>) -> Option<(Vec<usize>, Vec<usize>)> {
    let mut best: Option<(Vec<usize>, Vec<usize>)> = None;
    for &start in rows {
        let mut taken = vec![start];
        let mut found = unknowns(start);
        while taken.len() < found.len() {
            let fresh = |row: usize| unknowns(row).iter().filter(|j| !found.contains(j)).count();
            let next = rows
                .iter()
                .copied()
                .filter(|r| !taken.contains(r) && !unknowns(*r).is_empty())
                .min_by_key(|&r| fresh(r))?;
            for j in unknowns(next) {
                if !found.contains(&j) {
                    found.push(j);
                }
            }
            taken.push(next);
        }
        if found.len() == taken.len() && best.as_ref().is_none_or(|(rows, _)| taken.len() < rows.len()) {
            best = Some((taken, found));
        }
    }
    best
}

/// Inverse by cofactors: each quotient of cofactor and determinant in normal form, where it may cancel.
fn inverse_by_cofactors<'g>(matrix: &[Vec<Expr<'g>>]) -> Option<Vec<Vec<Expr<'g>>>> {
    let n = matrix.len();
    let one = matrix[0][0].graph().one();
    let minor = |i: usize, j: usize| -> Vec<Vec<Expr<'g>>> {
        let row = |r: usize| (0..n).filter(|&c| c != j).map(|c| matrix[r][c]).collect();
        (0..n).filter(|&r| r != i).map(row).collect()
    };
    let inverse = match determinant(matrix, one).collected(LIMIT) {
        zero if zero.is_zero() => return None,
        determinant => determinant.recip(),
    };
    let entry = |i: usize, j: usize| {
        let cofactor = determinant(&minor(j, i), one);
        let signed = if (i + j).is_multiple_of(2) { cofactor } else { -cofactor };
        (signed * inverse).collected(LIMIT)
    };
    Some((0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect())
}

fn determinant<'g>(matrix: &[Vec<Expr<'g>>], one: Expr<'g>) -> Expr<'g> {
    let n = matrix.len();
    if n == 0 {
        return one;
    }
    (0..n)
        .map(|j| {
            let minor: Vec<Vec<Expr<'g>>> = matrix[1..]
                .iter()
                .map(|row| row.iter().enumerate().filter(|(c, _)| *c != j).map(|(_, e)| *e).collect())
                .collect();
            let term = if matrix[0][j].is_zero() { matrix[0][j] } else { matrix[0][j] * determinant(&minor, one) };
            if j.is_multiple_of(2) { term } else { -term }
        })
        .sum()
}

/// Inverse of a symmetric positive definite matrix of constants. Each block of coupled unknowns is inverted alone
/// (by LDLᵀ, unrolled); entries are opaque, because they are numbers once the parameters are known.
pub fn inverse_of_symmetric<'g>(matrix: &[Vec<Expr<'g>>]) -> Vec<Vec<Expr<'g>>> {
    let n = matrix.len();
    let mut inverse = vec![vec![matrix[0][0].graph().zero(); n]; n];
    for block in connected_blocks(matrix) {
        if let [k] = block[..] {
            // A single pivot stays visible: its reciprocal cancels against numerators in the normal form.
            inverse[k][k] = matrix[k][k].recip();
            continue;
        }
        let sub: Vec<Vec<Expr<'g>>> = block.iter().map(|&i| block.iter().map(|&j| matrix[i][j]).collect()).collect();
        let sub = inverse_by_ldlt(&sub);
        for (r, &i) in block.iter().enumerate() {
            for (c, &j) in block.iter().enumerate() {
                inverse[i][j] = sub[r.max(c)][r.min(c)].opaque();
            }
        }
    }
    inverse
}

/// x with A x = right for a symmetric positive definite A with varying entries: LDLᵀ, unrolled on the shared graph.
/// Each block of coupled unknowns is solved alone, the unknown with the fewest neighbours first, which for trees keeps
/// the sparsity of A; what is zero is never touched. The factors do not depend on the right-hand side, so several
/// solves on one graph share them.
pub fn solve_symmetric<'g>(matrix: &[Vec<Expr<'g>>], right: &[Expr<'g>]) -> Vec<Expr<'g>> {
    solve_by_blocks(matrix, right, matrix.len())
}

/// `a c − b²`, where it is a product, as the `sin²` that is left of `1 − cos²`: of the difference no digit is left near
/// zero. `None` also where that is long to find out.
fn product_of_pivots<'g>([a, b, c]: [Expr<'g>; 3]) -> Option<Expr<'g>> {
    let mut nodes = SHORT;
    if ![a, b, c].into_iter().all(|e| is_within(e, &mut nodes)) {
        return None;
    }
    let terms = (a * c - b.powi(2)).expand_around_sums(SHORT)?;
    (terms.len() == 1).then(|| terms.collect())
}

/// Whether an expression has no more nodes than are left.
fn is_within(e: Expr<'_>, left: &mut usize) -> bool {
    if *left == 0 {
        return false;
    }
    *left -= 1;
    match e.view() {
        NodeView::Sum(terms) => terms.into_iter().all(|(_, term)| is_within(term, left)),
        NodeView::Product(factors) => factors.into_iter().all(|(factor, _)| is_within(factor, left)),
        NodeView::Group(inner) => is_within(inner, left),
        _ => true,
    }
}

/// The same with blocks of two unknowns solved by Cramer's rule: one division instead of two that wait for one another.
/// For two unknowns, and not for more, the rule is as accurate as elimination (Higham, Accuracy and Stability of
/// Numerical Algorithms, 2002, 1.10.1). `None` when there is no such block.
pub fn solve_pairs<'g>(matrix: &[Vec<Expr<'g>>], right: &[Expr<'g>]) -> Option<Vec<Expr<'g>>> {
    let blocks = connected_blocks(matrix);
    let pairs: Vec<[usize; 2]> = blocks.into_iter().filter_map(|block| block.try_into().ok()).collect();
    if pairs.is_empty() {
        return None;
    }
    let mut solution = solve_symmetric(matrix, right);
    for [i, j] in pairs {
        let (a, b, c) = (matrix[i][i], matrix[i.min(j)][i.max(j)], matrix[j][j]);
        let (f, g) = (right[i].group(), right[j].group());
        let determinant = product_of_pivots([a, b, c]).unwrap_or(a.group() * c.group() - b.group().powi(2));
        let reciprocal = determinant.group().recip();
        solution[i] = (c.group() * f - b.group() * g).group() * reciprocal;
        solution[j] = (a.group() * g - b.group() * f).group() * reciprocal;
    }
    Some(solution)
}

/// (x, μ) with `A x + Jᵀ μ = right`, `J x = bias`, for a symmetric positive definite A and rows of J that are
/// independent: the same elimination of the whole, the multipliers last, so that the pivots are those of A and of −J
/// A⁻¹ Jᵀ.
pub fn solve_saddle<'g>(
    matrix: &[Vec<Expr<'g>>],
    jacobian: &[Vec<Expr<'g>>],
    right: &[Expr<'g>],
    bias: &[Expr<'g>],
) -> (Vec<Expr<'g>>, Vec<Expr<'g>>) {
    let n = matrix.len();
    let zero = right[0].graph().zero();
    let upper = matrix.iter().enumerate().map(|(i, row)| {
        let constraints = jacobian.iter().map(|constraint| constraint[i]);
        row.iter().copied().chain(constraints).collect()
    });
    let lower = jacobian.iter().map(|row| row.iter().copied().chain(jacobian.iter().map(|_| zero)).collect());
    let whole: Vec<Vec<Expr<'g>>> = upper.chain(lower).collect();
    let right: Vec<Expr<'g>> = right.iter().chain(bias).copied().collect();
    let mut solution = solve_by_blocks(&whole, &right, n);
    let multipliers = solution.split_off(n);
    (solution, multipliers)
}

/// Unknowns from `first_last` on are eliminated after those before it.
fn solve_by_blocks<'g>(matrix: &[Vec<Expr<'g>>], right: &[Expr<'g>], first_last: usize) -> Vec<Expr<'g>> {
    let mut solution = right.to_vec();
    for block in connected_blocks(matrix) {
        let order = elimination_order(matrix, &block, first_last);
        let mut x: Vec<Expr<'g>> = order.iter().map(|&i| right[i].group()).collect();
        let block = FactoredBlock::eliminating(matrix, order, &mut x);
        block.substitute_back(&mut x);
        block.put(x, &mut solution);
    }
    solution
}

/// A symmetric positive definite matrix as LDLᵀ, for many right-hand sides: [`solve_symmetric`] of each.
pub struct Factorisation<'g> {
    blocks: Vec<FactoredBlock<'g>>,
}

/// L and D of a factored matrix, all by the order of elimination.
pub struct FactoredColumns<'g> {
    pub order: Vec<usize>,
    /// Entries of each column below its pivot, with the rows.
    pub below: Vec<Vec<(usize, Expr<'g>)>>,
    /// Reciprocals.
    pub pivots: Vec<Expr<'g>>,
}

impl<'g> FactoredColumns<'g> {
    /// All entries: the pivots, then the columns.
    pub fn entries(&self) -> impl Iterator<Item = Expr<'g>> {
        self.pivots.iter().copied().chain(self.below.iter().flatten().map(|(_, entry)| *entry))
    }

    /// The same matrix with other entries, in that order.
    pub fn with_entries(&self, entries: impl IntoIterator<Item = Expr<'g>>) -> Self {
        let mut entries = entries.into_iter();
        let pivots = entries.by_ref().take(self.pivots.len()).collect();
        let column = |column: &Vec<(usize, Expr<'g>)>| column.iter().map(|(row, _)| *row).zip(&mut entries).collect();
        Self { order: self.order.clone(), pivots, below: self.below.iter().map(column).collect() }
    }

    /// L⁻ᵀD⁻¹ of what is half of a solution, in the order of elimination; in that of the unknowns.
    pub fn substitute_back(&self, halfway: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let mut x = halfway.to_vec();
        for k in (0..x.len()).rev() {
            let known = self.below[k].iter().map(|&(row, entry)| entry * x[row]);
            let numerator = known.fold(x[k], |sum, e| sum - e).group();
            x[k] = (numerator * self.pivots[k]).group();
        }
        let mut solution = x.clone();
        self.order.iter().zip(x).for_each(|(&unknown, value)| solution[unknown] = value);
        solution
    }
}

/// Unknowns that are coupled, in the order of elimination, and what is left of each column when its turn comes.
struct FactoredBlock<'g> {
    order: Vec<usize>,
    rest: Vec<Vec<Expr<'g>>>,
}

impl<'g> Factorisation<'g> {
    pub fn new(matrix: &[Vec<Expr<'g>>]) -> Self {
        let factored = |block: Vec<usize>| {
            let mut nothing = vec![matrix[0][0].graph().zero(); block.len()];
            let order = elimination_order(matrix, &block, matrix.len());
            FactoredBlock::eliminating(matrix, order, &mut nothing)
        };
        Self { blocks: connected_blocks(matrix).into_iter().map(factored).collect() }
    }

    /// From the order of elimination and, below the diagonal and on it, what is left of each column when its turn
    /// comes.
    pub fn of_columns(order: Vec<usize>, rest: Vec<Vec<Expr<'g>>>) -> Self {
        Self { blocks: vec![FactoredBlock { order, rest }] }
    }

    /// The factors as numbers, for solutions in loops.
    pub fn columns(&self) -> FactoredColumns<'g> {
        let mut columns = FactoredColumns { order: self.order(), below: Vec::new(), pivots: Vec::new() };
        for block in &self.blocks {
            let first = columns.below.len();
            let n = block.order.len();
            let entries = (0..n).map(|k| {
                let there = (k + 1..n).filter(|&i| !block.rest[i][k].is_zero());
                there.map(|i| (first + i, block.rest[i][k])).collect()
            });
            columns.below.extend(entries);
            columns.pivots.extend((0..n).map(|k| block.rest[k][k].group().recip()));
        }
        columns
    }

    /// The unknowns in the order of elimination.
    pub fn order(&self) -> Vec<usize> {
        self.blocks.iter().flat_map(|block| &block.order).copied().collect()
    }

    /// L⁻¹ of a right-hand side, in the order of elimination.
    pub fn halfway(&self, right: &[Expr<'g>]) -> Vec<Expr<'g>> {
        self.blocks.iter().flat_map(|block| block.halfway(right)).collect()
    }

    /// x with `matrix · x = right`.
    pub fn solve(&self, right: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let mut solution = right.to_vec();
        for block in &self.blocks {
            let mut x = block.halfway(right);
            block.substitute_back(&mut x);
            block.put(x, &mut solution);
        }
        solution
    }
}

impl<'g> FactoredBlock<'g> {
    /// Together with a right-hand side.
    fn eliminating(matrix: &[Vec<Expr<'g>>], order: Vec<usize>, x: &mut [Expr<'g>]) -> Self {
        let rest = order.iter().map(|&i| order.iter().map(|&j| matrix[i.min(j)][i.max(j)]).collect()).collect();
        let mut block = Self { order, rest };
        for k in 0..x.len() {
            let below = block.below(k);
            for &(i, factor) in &below {
                x[i] = (x[i] - factor * x[k]).group();
                for j in k + 1..=i {
                    if !block.rest[j][k].is_zero() {
                        let pivots = [block.rest[k][k], block.rest[i][k], block.rest[i][i]];
                        let product = if i == j { product_of_pivots(pivots) } else { None };
                        let left = match product {
                            Some(product) => product * block.rest[k][k].group().recip(),
                            None => block.rest[i][j] - factor * block.rest[j][k],
                        };
                        block.rest[i][j] = left.group();
                    }
                }
            }
        }
        block
    }

    /// Multiples by which a row is taken away from those after it.
    fn below(&self, k: usize) -> Vec<(usize, Expr<'g>)> {
        let pivot_inverse = self.rest[k][k].group().recip();
        let rows = (k + 1..self.order.len()).filter(|&i| !self.rest[i][k].is_zero());
        rows.map(|i| (i, self.rest[i][k] * pivot_inverse)).collect()
    }

    fn halfway(&self, right: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let mut x: Vec<Expr<'g>> = self.order.iter().map(|&i| right[i].group()).collect();
        (0..x.len()).for_each(|k| self.eliminate(k, &mut x));
        x
    }

    fn eliminate(&self, k: usize, x: &mut [Expr<'g>]) {
        for (i, factor) in self.below(k) {
            x[i] = (x[i] - factor * x[k]).group();
        }
    }

    fn substitute_back(&self, x: &mut [Expr<'g>]) {
        let (n, rest) = (x.len(), &self.rest);
        for k in (0..n).rev() {
            let known = (k + 1..n).filter(|&i| !rest[i][k].is_zero()).map(|i| rest[i][k] * x[i]);
            let numerator = known.fold(x[k], |sum, e| sum - e).group();
            x[k] = numerator * rest[k][k].group().recip();
        }
    }

    fn put(&self, x: Vec<Expr<'g>>, solution: &mut [Expr<'g>]) {
        self.order.iter().zip(x).for_each(|(&i, value)| solution[i] = value);
    }
}

/// The unknown with the fewest neighbours among those left, again and again; its neighbours then are neighbours of each
/// other. Unknowns from `first_last` on wait for the others.
fn elimination_order(matrix: &[Vec<Expr<'_>>], block: &[usize], first_last: usize) -> Vec<usize> {
    let mut neighbours: Vec<Vec<bool>> =
        block.iter().map(|&i| block.iter().map(|&j| i != j && !matrix[i][j].is_zero()).collect()).collect();
    let mut left: Vec<usize> = (0..block.len()).collect();
    let mut order = Vec::with_capacity(block.len());
    let degree =
        |neighbours: &[Vec<bool>], left: &[usize], i: usize| left.iter().filter(|&&j| neighbours[i][j]).count();
    while let Some(&next) = left.iter().min_by_key(|&&i| (block[i] >= first_last, degree(&neighbours, &left, i))) {
        left.retain(|&i| i != next);
        let around: Vec<usize> = left.iter().copied().filter(|&i| neighbours[next][i]).collect();
        for &i in &around {
            for &j in &around {
                neighbours[i][j] = i != j;
            }
        }
        order.push(block[next]);
    }
    order
}

/// The sets of unknowns that the matrix couples.
fn connected_blocks(matrix: &[Vec<Expr<'_>>]) -> Vec<Vec<usize>> {
    let n = matrix.len();
    let mut label: Vec<usize> = (0..n).collect();
    for i in 0..n {
        for j in 0..i {
            if !matrix[i][j].is_zero() {
                let (from, to) = (label[i], label[j]);
                label.iter_mut().filter(|l| **l == from).for_each(|l| *l = to);
            }
        }
    }
    let mut blocks: Map<usize, Vec<usize>> = Map::default();
    for (i, l) in label.into_iter().enumerate() {
        blocks.or_insert_with(l, Vec::new).push(i);
    }
    let mut blocks: Vec<_> = blocks.into_iter().map(|(_, rows)| rows).collect();
    blocks.sort();
    blocks
}

/// A⁻¹ = L⁻ᵀ D⁻¹ L⁻¹ from A = L D Lᵀ; stable without pivoting because A is positive definite (checked at run time).
fn inverse_by_ldlt<'g>(matrix: &[Vec<Expr<'g>>]) -> Vec<Vec<Expr<'g>>> {
    let n = matrix.len();
    let graph = matrix[0][0].graph();
    let mut lower = vec![vec![graph.zero(); n]; n];
    let mut pivot_inverse = Vec::with_capacity(n);
    let mut pivot = Vec::with_capacity(n);
    for j in 0..n {
        for i in j..n {
            let products = (0..j).map(|k| lower[i][k] * lower[j][k] * pivot[k]);
            let entry = products.fold(matrix[i][j], |sum, e| sum - e).group();
            if i == j {
                pivot.push(entry);
                pivot_inverse.push(entry.recip().opaque());
                lower[j][j] = graph.one();
            } else {
                lower[i][j] = (entry * pivot_inverse[j]).opaque();
            }
        }
    }
    // L⁻¹, column by column.
    let mut inverse_lower = vec![vec![graph.zero(); n]; n];
    for j in 0..n {
        inverse_lower[j][j] = graph.one();
        for i in j + 1..n {
            let sum = (j..i).map(|k| lower[i][k] * inverse_lower[k][j]).sum::<Expr<'g>>();
            inverse_lower[i][j] = (-sum).opaque();
        }
    }
    (0..n)
        .map(|i| {
            (0..n)
                .map(|j| {
                    (i.max(j)..n)
                        .map(|k| inverse_lower[k][i] * pivot_inverse[k] * inverse_lower[k][j])
                        .sum::<Expr<'g>>()
                })
                .collect()
        })
        .collect()
}
