//! Saddle-point systems whose constraints may depend on one another: rows of J without an independent part have
//! multipliers too, those of least norm.
//!
//! `S = J A⁻¹Jᵀ` is positive semidefinite. Its LDLᵀ has a pivot of zero for each row that depends on those before it,
//! and such a pivot has no reciprocal: 0 stands in its place, by arithmetic alone, so that the result stays
//! a straight line that can be differentiated.

use crate::algebra::expressions::function::{BinaryFunction, Function};
use crate::algebra::expressions::graph::Expr;
use crate::algebra::linear::solve_symmetric;
use crate::algebra::rational::Rational;

/// The part of S_kk below which a pivot is zero. Rows of J carry some roundings of their own and those of the A⁻¹Jᵀ
/// that they are multiplied with, ε = 2⁻⁵² each; a pivot is S_kk less a sum of k squares that together are no larger
/// than S_kk, so that what rounding leaves of zero is some (k + 10) ε S_kk. 2⁻⁴² = 1024 ε is above that for rows by the
/// hundred. A pivot is the square of a sine: rows at less than 2⁻²¹ = 4.8e-7 to the span of those before them are
/// dependent, whatever the units.
fn negligible() -> Rational {
    Rational::new(1, 1 << 42)
}

/// A positive semidefinite matrix as L D Lᵀ, with what D has of reciprocals.
struct Semidefinite<'g> {
    lower: Vec<Vec<Expr<'g>>>,
    reciprocals: Vec<Expr<'g>>,
    /// 1 for a row that is independent of those before it, else 0.
    kept: Vec<Expr<'g>>,
}

impl<'g> Semidefinite<'g> {
    fn new(matrix: &[Vec<Expr<'g>>]) -> Self {
        let n = matrix.len();
        let mut factors = Self { lower: Vec::new(), reciprocals: Vec::new(), kept: Vec::new() };
        let mut columns: Vec<Vec<Expr<'g>>> = Vec::new();
        for i in 0..n {
            let (mut column, mut lower): (Vec<Expr<'g>>, Vec<Expr<'g>>) = (Vec::new(), Vec::new());
            for j in 0..=i {
                let known = (0..j).map(|l| lower[l] * if i == j { column[l] } else { columns[j][l] });
                let left = known.fold(matrix[i][j], |sum, e| sum - e).group();
                column.push(left);
                if j < i {
                    lower.push((left * factors.reciprocals[j]).group());
                }
            }
            let (kept, reciprocal) = guarded(column[i], matrix[i][i]);
            factors.kept.push(kept);
            factors.reciprocals.push(reciprocal);
            factors.lower.push(lower);
            columns.push(column);
        }
        factors
    }

    /// A solution, with 0 in the places of dependent rows.
    fn solve(&self, right: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let mut x: Vec<Expr<'g>> = right.to_vec();
        for i in 0..x.len() {
            x[i] = (0..i).fold(x[i], |sum, j| sum - self.lower[i][j] * x[j]).group();
        }
        let scaled = x.iter().zip(&self.reciprocals).map(|(x, r)| *x * *r).collect();
        self.substitute_back(scaled)
    }

    /// Vectors that the matrix makes zero, one for each dependent row; zero for the others.
    fn null_space(&self) -> Vec<Vec<Expr<'g>>> {
        let (n, graph) = (self.kept.len(), self.kept[0].graph());
        let unit = |k: usize| {
            (0..n).map(|i| if i == k { graph.one() - self.kept[k] } else { graph.zero() }).collect::<Vec<_>>()
        };
        (0..n).map(|k| self.substitute_back(unit(k))).collect()
    }

    /// x with `Lᵀ x = right`.
    fn substitute_back(&self, mut x: Vec<Expr<'g>>) -> Vec<Expr<'g>> {
        for i in (0..x.len()).rev() {
            x[i] = (i + 1..x.len()).fold(x[i], |sum, j| sum - self.lower[j][i] * x[j]).group();
        }
        x
    }
}

/// 1 and the reciprocal of a pivot, or 0 and 0 where it is a negligible part of `whole`.
fn guarded<'g>(pivot: Expr<'g>, whole: Expr<'g>) -> (Expr<'g>, Expr<'g>) {
    let graph = pivot.graph();
    let beyond = (pivot.abs() - whole.abs().scale(negligible())).group();
    // Of zero it is −1 or 0, whatever the sign of zero.
    let sign = -graph.call(Function::Signum, -beyond);
    let kept = sign.binary(BinaryFunction::Max, graph.zero()).group();
    (kept, kept * (kept * pivot + (graph.one() - kept)).group().recip())
}

/// What constraints make of a system.
pub struct Dependent<'g> {
    /// x with `A x + Jᵀ μ = right` and `J x = bias`, and μ: of all that belong to x that of least `Σ S_kk μ_k²`, which
    /// no factor of a row of J changes.
    pub solution: Vec<Expr<'g>>,
    pub multipliers: Vec<Expr<'g>>,
    /// 1 for a row of J that is independent of those before it, else 0.
    pub kept: Vec<Expr<'g>>,
}

/// The solution of a saddle-point system for a symmetric positive definite A and any rows of J; `bias` must belong to
/// them: of rows that depend on others it is not looked at.
pub fn solve_dependent<'g>(
    matrix: &[Vec<Expr<'g>>],
    jacobian: &[Vec<Expr<'g>>],
    right: &[Expr<'g>],
    bias: &[Expr<'g>],
) -> Dependent<'g> {
    let free = solve_symmetric(matrix, right);
    let columns: Vec<Vec<Expr<'g>>> = jacobian.iter().map(|row| solve_symmetric(matrix, row)).collect();
    let n = jacobian.len();
    let entry = |i: usize, j: usize| product(&jacobian[i.max(j)], &columns[i.min(j)]).group();
    let schur: Vec<Vec<Expr<'g>>> = (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect();
    let factors = Semidefinite::new(&schur);
    let left: Vec<Expr<'g>> = jacobian.iter().zip(bias).map(|(row, b)| (product(row, &free) - *b).group()).collect();
    let basic = factors.solve(&left);
    let solution = (0..free.len()).map(|i| {
        let each = columns.iter().zip(&basic).map(|(column, mu)| column[i] * *mu);
        each.fold(free[i], |sum, e| sum - e)
    });
    let solution = solution.collect();
    let null_space = factors.null_space();
    let weighted = |v: &[Expr<'g>]| (0..n).map(|i| schur[i][i] * v[i]).collect::<Vec<_>>();
    let of_null: Vec<Vec<Expr<'g>>> = null_space.iter().map(|v| weighted(v)).collect();
    let gram = |i: usize, j: usize| product(&null_space[i.max(j)], &of_null[i.min(j)]).group();
    let gram: Vec<Vec<Expr<'g>>> = (0..n).map(|i| (0..n).map(|j| gram(i, j)).collect()).collect();
    let parts: Vec<Expr<'g>> = of_null.iter().map(|v| product(v, &basic).group()).collect();
    let parts = Semidefinite::new(&gram).solve(&parts);
    let least = |k: usize| null_space.iter().zip(&parts).fold(basic[k], |sum, (v, part)| sum - v[k] * *part);
    Dependent { solution, multipliers: (0..n).map(least).collect(), kept: factors.kept }
}

fn product<'g>(a: &[Expr<'g>], b: &[Expr<'g>]) -> Expr<'g> {
    a.iter().zip(b).map(|(a, b)| *a * *b).sum()
}

#[cfg(test)]
mod tests {
    use super::{product, solve_dependent};
    use crate::algebra::{Evaluation, Expr, Graph, Map, Number, Precise, Scalar, solve_saddle};

    /// Numbers that nothing relates, of sizes spread over six decimal places.
    fn number(seed: &mut u64) -> f64 {
        let mut next = || {
            *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (*seed >> 33) as f64 / f64::from(1 << 30) - 1.0
        };
        next() * 10.0_f64.powf(3.0 * next())
    }

    struct Numbers<'g> {
        graph: &'g Graph,
        values: Map<u32, f64>,
        seed: u64,
    }

    impl<'g> Numbers<'g> {
        fn symbol(&mut self) -> Expr<'g> {
            let name = format!("x{}", self.values.len());
            let symbol = self.graph.symbol(name, "", false);
            let value = number(&mut self.seed);
            self.values.insert(symbol.key(), value);
            symbol
        }

        fn list(&mut self, count: usize) -> Vec<Expr<'g>> {
            (0..count).map(|_| self.symbol()).collect()
        }

        fn f64(&self, of: &[Expr<'g>]) -> Vec<f64> {
            let mut evaluation = Evaluation::new(&self.values);
            of.iter().map(|e| evaluation.value(*e)).collect()
        }

        fn precise(&self, of: &[Expr<'g>]) -> Vec<Precise> {
            let values: Map<u32, Precise> = self.values.iter().map(|(&key, &x)| (key, Precise::number(x))).collect();
            let mut evaluation = Evaluation::new(&values);
            of.iter().map(|e| evaluation.value(*e)).collect()
        }
    }

    /// Four speeds, two rows that nothing relates, and three that are combinations of them, one of them zero.
    /// The motion is that of the two rows, the forces Jᵀμ are theirs, and μ is normal to every combination of rows that
    /// vanishes: of all multipliers with these forces the least.
    #[test]
    fn dependent_rows_leave_the_motion_and_share_the_forces() {
        for seed in 0..50 {
            let graph = Graph::new();
            let mut numbers = Numbers { graph: &graph, values: Map::default(), seed };
            let roots: Vec<Vec<Expr<'_>>> = (0..4).map(|_| numbers.list(4)).collect();
            let matrix: Vec<Vec<Expr<'_>>> =
                (0..4).map(|i| (0..4).map(|j| product(&roots[i], &roots[j])).collect()).collect();
            let (mut rows, mut bias): (Vec<_>, _) = ((0..2).map(|_| numbers.list(4)).collect(), numbers.list(2));
            let right = numbers.list(4);
            // Rows 2, 3 by factors of the first two; row 4 is zero.
            let factors = [numbers.list(2), numbers.list(2), vec![graph.zero(); 2]];
            for [a, b] in factors.iter().map(|f| [f[0], f[1]]) {
                let row = (0..4).map(|k| a * rows[0][k] + b * rows[1][k]).collect();
                rows.push(row);
                bias.push(a * bias[0] + b * bias[1]);
            }
            let found = solve_dependent(&matrix, &rows, &right, &bias);
            assert_eq!(numbers.f64(&found.kept), [1.0, 1.0, 0.0, 0.0, 0.0], "{seed}");
            let (expected, _) = solve_saddle(&matrix, &rows[..2], &right, &bias[..2]);
            let exact = numbers.precise(&expected);
            let far = |found: &[f64], exact: &[Precise]| {
                let size = exact.iter().fold(0.0_f64, |most, x| most.max(x.to_f64().abs()));
                let apart = found.iter().zip(exact).map(|(a, b)| (Precise::number(*a) - *b).to_f64().abs());
                apart.fold(0.0_f64, f64::max) / size
            };
            // What double precision loses of the independent rows alone is the measure of what it may lose here.
            let usual = far(&numbers.f64(&expected), &exact).max(f64::EPSILON);
            let error = far(&numbers.f64(&found.solution), &exact);
            assert!(error <= 1e3 * usual, "{seed}: {error:e} beside {usual:e}");
            // In many digits: the same motion, and weights μ across what vanishes.
            assert!(far(&numbers.f64(&expected), &numbers.precise(&found.solution)) <= 2.0 * usual);
            let weight = |k: usize| {
                let (column, _) = solve_saddle(&matrix, &[], &rows[k], &[]);
                product(&rows[k], &column)
            };
            for (k, f) in factors.iter().enumerate().take(2) {
                let vanishing = [(0, f[0]), (1, f[1]), (2 + k, -graph.one())];
                let terms: Vec<Expr<'_>> =
                    vanishing.iter().map(|&(row, part)| part * weight(row) * found.multipliers[row]).collect();
                let sizes: f64 = numbers.precise(&terms).iter().map(|x| x.to_f64().abs()).sum();
                let sum = numbers.precise(&[terms.iter().copied().sum()])[0].to_f64().abs();
                assert!(sum <= 1e-30 * sizes, "{seed}: {sum:e} of {sizes:e}");
            }
            assert_eq!(numbers.f64(&found.multipliers[4..]), [0.0]);
        }
    }
}
