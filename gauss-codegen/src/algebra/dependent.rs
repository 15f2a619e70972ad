//! Saddle-point systems whose constraints may depend on one another: rows of J without an independent part have
//! multipliers too, those of least norm.
//!
//! Rows are made orthogonal one after another in the metric A⁻¹ (modified Gram–Schmidt): `J = L R`, `R A⁻¹ Rᵀ = D`.
//! A row that depends on those before it leaves zero, whose square has no reciprocal: 0 stands in its place, by
//! arithmetic alone, so that the result stays a straight line that can be differentiated. `S = J A⁻¹Jᵀ = L D Lᵀ` is not
//! formed: its pivots are squares of what is left of a row, and lose twice the digits.

use crate::algebra::expressions::function::{BinaryFunction, Function};
use crate::algebra::expressions::graph::Expr;
use crate::algebra::linear::solve_symmetric;
use crate::algebra::rational::Rational;

/// The part of its square below which a row has nothing left, a square of a sine. Rows that change with the state come
/// near to one another where they depend on one another, and a run meets such a state up to its tolerance: rows at less
/// than 2⁻²¹ = 4.8e-7 to the span of those before them are dependent, whatever the units. Rows of parameters alone
/// stay as they are: of them only rounding is nothing, 2⁻⁴² = 1024 ε for rows by the hundred with some roundings of
/// their own and of A⁻¹Jᵀ.
fn negligible(changes: bool) -> Rational {
    let root = Rational::new(1, if changes { 1 << 21 } else { 1 << 42 });
    root * root
}

/// Vectors made orthogonal in a metric: `vector[i] = Σ_j lower[i][j] own[j] + own[i]`.
struct Orthogonal<'g> {
    own: Vec<Vec<Expr<'g>>>,
    /// The same of what the metric makes of them.
    images: Vec<Vec<Expr<'g>>>,
    lower: Vec<Vec<Expr<'g>>>,
    /// Reciprocals of `own[i] · image[i]`.
    reciprocals: Vec<Expr<'g>>,
    /// 1 for a vector that is independent of those before it, else 0.
    kept: Vec<Expr<'g>>,
}

impl<'g> Orthogonal<'g> {
    fn new(vectors: &[Vec<Expr<'g>>], images: &[Vec<Expr<'g>>]) -> Self {
        let mut found =
            Self { own: Vec::new(), images: Vec::new(), lower: Vec::new(), reciprocals: Vec::new(), kept: Vec::new() };
        for (vector, image) in vectors.iter().zip(images) {
            // Of masses that no body has squares can be negative: formulas are compared at any.
            let whole = product(vector, image).group().abs();
            let (mut own, mut image, mut lower) = (vector.clone(), image.clone(), Vec::new());
            for j in 0..found.own.len() {
                let share = (product(&own, &found.images[j]) * found.reciprocals[j]).group();
                own = less(&own, share, &found.own[j]);
                image = less(&image, share, &found.images[j]);
                lower.push(share);
            }
            let changes = !vectors[..=found.own.len()].iter().flatten().all(|e| e.is_constant());
            let (kept, reciprocal) = guarded(product(&own, &image).group(), whole.scale(negligible(changes)), whole);
            found.own.push(own);
            found.images.push(image);
            found.lower.push(lower);
            found.kept.push(kept);
            found.reciprocals.push(reciprocal);
        }
        found
    }

    /// Combinations of the vectors that vanish, one for each dependent vector; zero for the others.
    fn null_space(&self) -> Vec<Vec<Expr<'g>>> {
        let unit = |k: usize| {
            let kept = self.kept[k];
            let entry = |i: usize| if i == k { kept.graph().one() - kept } else { kept.graph().zero() };
            (0..self.kept.len()).map(entry).collect::<Vec<_>>()
        };
        (0..self.kept.len()).map(|k| self.substitute_back(unit(k))).collect()
    }

    /// x with `Lᵀ x = right`.
    fn substitute_back(&self, mut x: Vec<Expr<'g>>) -> Vec<Expr<'g>> {
        for i in (0..x.len()).rev() {
            x[i] = (i + 1..x.len()).fold(x[i], |sum, j| sum - self.lower[j][i] * x[j]).group();
        }
        x
    }
}

/// 1 and the reciprocal of a square, or 0 and 0 where it is `negligible`, a part of the `whole`.
fn guarded<'g>(square: Expr<'g>, negligible: Expr<'g>, whole: Expr<'g>) -> (Expr<'g>, Expr<'g>) {
    let graph = square.graph();
    let beyond = (square.abs() - negligible).group();
    // Of zero it is −1 or 0, whatever the sign of zero.
    let sign = -graph.call(Function::Signum, -beyond);
    let kept = sign.binary(BinaryFunction::Max, graph.zero()).group();
    // What is kept stays as it is, however small; what is not kept has at least 1 in its place.
    let left_out = (graph.one() - kept).group();
    (kept, kept * (square + left_out * (graph.one() + whole).group()).group().recip())
}

/// Solution of a system with constraints.
pub struct ConstrainedSolution<'g> {
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
) -> ConstrainedSolution<'g> {
    let mut solution = solve_symmetric(matrix, right);
    let columns: Vec<Vec<Expr<'g>>> = jacobian.iter().map(|row| solve_symmetric(matrix, row)).collect();
    let rows = Orthogonal::new(jacobian, &columns);
    let (mut left, mut forces): (Vec<Expr<'g>>, Vec<Expr<'g>>) = (Vec::new(), Vec::new());
    for (k, own) in rows.own.iter().enumerate() {
        let given = (0..k).fold(bias[k], |sum, j| sum - rows.lower[k][j] * left[j]).group();
        let force = ((product(own, &solution) - given) * rows.reciprocals[k]).group();
        solution = less(&solution, force, &rows.images[k]);
        left.push(given);
        forces.push(force);
    }
    let mut multipliers = rows.substitute_back(forces);
    let null_space = rows.null_space();
    let weights: Vec<Expr<'g>> = jacobian.iter().zip(&columns).map(|(row, c)| product(row, c).group()).collect();
    let weighted = |v: &Vec<Expr<'g>>| v.iter().zip(&weights).map(|(v, w)| (*v * *w).group()).collect();
    let nothing = Orthogonal::new(&null_space, &null_space.iter().map(weighted).collect::<Vec<_>>());
    for (k, own) in nothing.own.iter().enumerate() {
        let part = (product(&nothing.images[k], &multipliers) * nothing.reciprocals[k]).group();
        multipliers = less(&multipliers, part, own);
    }
    ConstrainedSolution { solution, multipliers, kept: rows.kept }
}

/// `a − factor b`.
fn less<'g>(a: &[Expr<'g>], factor: Expr<'g>, b: &[Expr<'g>]) -> Vec<Expr<'g>> {
    a.iter().zip(b).map(|(a, b)| (*a - factor * *b).group()).collect()
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
