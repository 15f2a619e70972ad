//! Small linear systems with symbolic entries.

use super::graph::Expr;
use super::map::Map;

/// Terms that an entry may have while a determinant is brought to normal form.
const LIMIT: usize = 400;

/// Solves `Σ_j matrix[i][j] x_j = right[i]`. Rows with one unknown left are solved at once, again and again; what
/// remains is solved block by block with cofactors in normal form, so that determinants such as `sin²θ·… + cos²θ·…`
/// collapse before they are divided by. Returns `None` when the matrix is structurally singular.
pub fn solve<'g>(matrix: &[Vec<Expr<'g>>], right: &[Expr<'g>]) -> Option<Vec<Expr<'g>>> {
    let n = right.len();
    let mut solution: Vec<Option<Expr<'g>>> = vec![None; n];
    let mut rows: Vec<usize> = (0..n).collect();
    while !rows.is_empty() {
        let unknowns = |row: usize, solution: &[Option<Expr<'g>>]| -> Vec<usize> {
            (0..n).filter(|&j| solution[j].is_none() && !matrix[row][j].is_zero()).collect()
        };
        // What is known so far goes to the right; terms stay a sum of their own so that they are computed once.
        let reduced = |row: usize, solution: &[Option<Expr<'g>>]| -> Expr<'g> {
            let known: Vec<Expr<'g>> =
                (0..n).filter_map(|j| solution[j].map(|x| -(matrix[row][j] * x))).filter(|e| !e.is_zero()).collect();
            known.into_iter().fold(right[row], |sum, e| sum + e)
        };
        if let Some(place) = rows.iter().position(|&row| unknowns(row, &solution).len() == 1) {
            let row = rows.remove(place);
            let j = unknowns(row, &solution)[0];
            solution[j] = Some(reduced(row, &solution) * matrix[row][j].recip());
            continue;
        }
        let block = smallest_block(&rows, |row| unknowns(row, &solution))?;
        let (block_rows, block_unknowns) = block;
        let sub: Vec<Vec<Expr<'g>>> =
            block_rows.iter().map(|&i| block_unknowns.iter().map(|&j| matrix[i][j]).collect()).collect();
        let sub_right: Vec<Expr<'g>> = block_rows.iter().map(|&i| reduced(i, &solution)).collect();
        for (j, x) in block_unknowns.iter().zip(cramer(&sub, &sub_right)?) {
            solution[*j] = Some(x);
        }
        rows.retain(|row| !block_rows.contains(row));
    }
    solution.into_iter().collect()
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

/// Solution by cofactors, every cofactor and the determinant in normal form.
fn cramer<'g>(matrix: &[Vec<Expr<'g>>], right: &[Expr<'g>]) -> Option<Vec<Expr<'g>>> {
    let n = right.len();
    let graph = right[0].graph();
    let minor = |i: usize, j: usize| -> Vec<Vec<Expr<'g>>> {
        (0..n).filter(|&r| r != i).map(|r| (0..n).filter(|&c| c != j).map(|c| matrix[r][c]).collect()).collect()
    };
    let det = determinant(matrix, graph.one()).collected(LIMIT);
    if det.is_zero() {
        return None;
    }
    let inverse = det.recip();
    Some(
        (0..n)
            .map(|j| {
                let terms = (0..n).map(|i| {
                    let cofactor = determinant(&minor(i, j), graph.one());
                    let signed = if (i + j) % 2 == 0 { cofactor } else { -cofactor };
                    // The quotient of cofactor and determinant may cancel; what does not stays a common factor.
                    (signed * inverse).collected(LIMIT) * right[i]
                });
                terms.sum::<Expr<'g>>().group()
            })
            .collect(),
    )
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
            if j % 2 == 0 { term } else { -term }
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
        blocks.entry(l).or_default().push(i);
    }
    let mut blocks: Vec<_> = blocks.into_values().collect();
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
