//! Least squares with weights that differ by many powers of ten.

use crate::algebra::expressions::graph::Expr;

/// `½ Σ_i w_i (Σ_j B_ij x_j + a_i)² + g_i Σ_j B_ij x_j − f·x` with positive weights, to be minimised without ever
/// forming `Bᵀ W B`: modified Gram–Schmidt on the columns, those with the fewest entries first, which for trees fills
/// nothing.
///
/// Once a column with a large entry in a heavy row is taken out of another column, the remainder in that row is small,
/// as it should be, and light rows keep their digits; in a sum over all rows these digits are lost (Björck, Numerical
/// Methods for Least Squares Problems, 1996, 4.4). Forces g on rows are compared with w a of the same row for the same
/// reason: in a heavy row their difference is small.
pub struct LeastSquares<'g> {
    rows: Vec<Vec<Expr<'g>>>,
    steps: Vec<OrthogonalColumn<'g>>,
}

/// One column, orthogonal to those before it.
struct OrthogonalColumn<'g> {
    column: usize,
    entries: Vec<Expr<'g>>,
    /// Times the weights.
    weighted: Vec<Expr<'g>>,
    weights: Vec<Expr<'g>>,
    /// Inverse of its square.
    inverse: Expr<'g>,
    /// Shares of it in later columns.
    shares: Vec<(usize, Expr<'g>)>,
}

impl<'g> OrthogonalColumn<'g> {
    fn share_in(&self, other: &[Expr<'g>]) -> Expr<'g> {
        (weighted_sum(&self.weighted, other) * self.inverse).group()
    }

    /// The same of offsets with forces on their rows.
    fn share_in_offsets(&self, offsets: &[Expr<'g>], acting: &[Expr<'g>]) -> Expr<'g> {
        let zero = self.inverse.graph().zero();
        let along = (0..offsets.len()).fold(zero, |sum, i| {
            sum + match acting[i].is_zero() {
                true => self.weighted[i] * offsets[i],
                false => self.entries[i] * (self.weights[i] * offsets[i] + acting[i]).group(),
            }
        });
        (along.group() * self.inverse).group()
    }

    fn taken_from(&self, other: &mut [Expr<'g>], share: Expr<'g>) {
        other.iter_mut().zip(&self.entries).for_each(|(c, b)| *c = (*c - share * *b).group());
    }
}

fn weighted_sum<'g>(weighted: &[Expr<'g>], other: &[Expr<'g>]) -> Expr<'g> {
    let zero = weighted[0].graph().zero();
    weighted.iter().zip(other).fold(zero, |sum, (b, c)| sum + *b * *c).group()
}

impl<'g> LeastSquares<'g> {
    /// Factors rows with their weights.
    pub fn new(rows: Vec<Vec<Expr<'g>>>, weights: &[Expr<'g>]) -> Self {
        let n = rows.first().map_or(0, Vec::len);
        let mut columns: Vec<Vec<Expr<'g>>> = (0..n).map(|j| rows.iter().map(|row| row[j].group()).collect()).collect();
        let mut left: Vec<usize> = (0..n).collect();
        let mut steps = Vec::with_capacity(n);
        let entries = |column: &[Expr<'g>]| column.iter().filter(|e| !e.is_zero()).count();
        // The last of those with as few: links come after their parents.
        while let Some(column) = left.iter().rev().copied().min_by_key(|&k| entries(&columns[k])) {
            left.retain(|&j| j != column);
            let entries = columns[column].clone();
            let weighted: Vec<Expr<'g>> = entries.iter().zip(weights).map(|(b, w)| (*b * *w).group()).collect();
            let inverse = weighted_sum(&weighted, &entries).recip().group();
            let mut step =
                OrthogonalColumn { column, entries, weighted, weights: weights.to_vec(), inverse, shares: Vec::new() };
            for &j in &left {
                let share = step.share_in(&columns[j]);
                if !share.is_zero() {
                    step.taken_from(&mut columns[j], share);
                    step.shares.push((j, share));
                }
            }
            steps.push(step);
        }
        Self { rows, steps }
    }

    /// x where it is least.
    pub fn solve(&self, offsets: &[Expr<'g>], acting: &[Expr<'g>], forces: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let (mut offsets, mut forces) = (offsets.to_vec(), forces.to_vec());
        let mut solution = Vec::with_capacity(forces.len());
        for step in &self.steps {
            let share = step.share_in_offsets(&offsets, acting);
            step.taken_from(&mut offsets, share);
            let force = forces[step.column];
            solution.push((step.column, (force * step.inverse - share).group()));
            step.shares.iter().for_each(|(j, share)| forces[*j] = (forces[*j] - *share * force).group());
        }
        let mut x = forces;
        for (step, (column, value)) in self.steps.iter().zip(solution).rev() {
            x[column] = step.shares.iter().fold(value, |sum, (j, share)| sum - *share * x[*j]).group();
        }
        x
    }

    /// x once more from what is left of the rows: where these nearly vanish with large offsets, as accelerations of a
    /// heavy load do at the end of light links, their digits are in what is left.
    pub fn refined(&self, offsets: &[Expr<'g>], acting: &[Expr<'g>], forces: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let first = self.solve(offsets, acting, forces);
        let left = self
            .rows
            .iter()
            .zip(offsets)
            .map(|(row, offset)| row.iter().zip(&first).fold(*offset, |sum, (b, x)| sum + *b * *x).group());
        let second = self.solve(&left.collect::<Vec<_>>(), acting, forces);
        first.iter().zip(second).map(|(x, more)| (*x + more).group()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::LeastSquares;
    use crate::algebra::{Evaluation, Expr, Graph, Map, Number, Precise, Scalar, solve_symmetric};

    /// Links in a plane that hang on one another, by absolute angles: velocities of their centres of mass, and their
    /// rates.
    struct Chain<'g> {
        rows: Vec<Vec<Expr<'g>>>,
        weights: Vec<Expr<'g>>,
        offsets: Vec<Expr<'g>>,
        values: Map<u32, f64>,
    }

    impl<'g> Chain<'g> {
        fn new(graph: &'g Graph, masses: &[f64], angles: &[f64]) -> Self {
            let (zero, one) = (graph.zero(), graph.one());
            let mut chain = Self { rows: vec![], weights: vec![], offsets: vec![], values: Map::default() };
            let mut symbol = |name: &str, k: usize, value: f64| {
                let symbol = graph.symbol(format!("{name}{k}"), "", false);
                chain.values.insert(symbol.key(), value);
                symbol
            };
            // The joint in terms of the rates, and its acceleration.
            let (mut joint, mut a) =
                ([vec![zero; masses.len()], vec![zero; masses.len()]], [zero, symbol("g", 0, 9.81)]);
            for (k, (&m, &angle)) in masses.iter().zip(angles).enumerate() {
                let (mass, inertia) = (symbol("m", k, m), symbol("I", k, 0.1 * m));
                let direction = [symbol("s", k, angle.sin()), symbol("c", k, angle.cos())];
                let (near, length) = (symbol("n", k, 0.6), symbol("l", k, 1.3));
                let across = [-direction[1], direction[0]];
                for axis in 0..2 {
                    let mut row = joint[axis].clone();
                    row[k] = near * across[axis];
                    chain.rows.push(row);
                    chain.weights.push(mass);
                    chain.offsets.push(a[axis] - near * direction[axis]);
                    joint[axis][k] = length * across[axis];
                    a[axis] = a[axis] - length * direction[axis];
                }
                chain.rows.push((0..masses.len()).map(|j| if j == k { one } else { zero }).collect());
                chain.weights.push(inertia);
                chain.offsets.push(zero);
            }
            chain
        }

        fn values<N: Number>(&self, of: &[Expr<'g>], change: impl Fn(u32, N) -> N) -> Vec<N> {
            let values: Map<u32, N> = self.values.iter().map(|(&key, &x)| (key, change(key, N::number(x)))).collect();
            let mut evaluation = Evaluation::new(&values);
            of.iter().map(|e| evaluation.value(*e)).collect()
        }

        /// The largest error in units of what one rounding of every number changes.
        fn loss(&self, x: &[Expr<'g>]) -> f64 {
            let exact = self.values::<Precise>(x, |_, value| value);
            let mut excused: Vec<f64> = exact.iter().map(|e| e.to_f64().abs() * f64::EPSILON).collect();
            let more = Precise::number(1.0) + Precise::number(f64::EPSILON);
            for moved in self.values.keys() {
                let other = self.values::<Precise>(x, |key, value| if key == *moved { value * more } else { value });
                let changes = other.iter().zip(&exact).map(|(a, b)| (*a - *b).to_f64().abs());
                excused.iter_mut().zip(changes).for_each(|(sum, change)| *sum += change);
            }
            let found = self.values::<f64>(x, |_, value| value).into_iter().map(Precise::number);
            let errors = found.zip(&exact).map(|(a, b)| (a - *b).to_f64().abs());
            errors.zip(excused).map(|(error, excused)| error / excused).fold(0.0, f64::max)
        }
    }

    /// `Bᵀ W B x = f − Bᵀ W a`.
    fn by_normal_equations<'g>(chain: &Chain<'g>, zero: Expr<'g>) -> Vec<Expr<'g>> {
        let n = chain.rows[0].len();
        let sum = |a: &dyn Fn(usize) -> Expr<'g>, b: &dyn Fn(usize) -> Expr<'g>| {
            let terms = (0..chain.rows.len()).map(|i| chain.weights[i] * a(i) * b(i));
            terms.fold(zero, |sum, e| sum + e).group()
        };
        let entry = |j: usize, k: usize| sum(&|i| chain.rows[i][j], &|i| chain.rows[i][k]);
        let matrix: Vec<Vec<Expr<'g>>> = (0..n).map(|j| (0..n).map(|k| entry(j, k)).collect()).collect();
        let right: Vec<Expr<'g>> = (0..n).map(|j| -sum(&|i| chain.rows[i][j], &|i| chain.offsets[i])).collect();
        solve_symmetric(&matrix, &right)
    }

    #[test]
    fn light_links_keep_their_digits_beside_heavy_ones() {
        let mut lost = 0.0_f64;
        for masses in [[1e-6, 1.0, 1e6], [1e6, 1.0, 1e-6], [1.0, 1e-6, 1e6], [1e-6, 1e6, 1.0], [1e6, 1e-6, 1.0]] {
            for angles in [[0.3, -1.1, 0.7], [0.3, 1.2, -0.2], [0.2, 0.2001, 0.2003], [-2.0, 0.4, 1.9]] {
                let graph = Graph::new();
                let chain = Chain::new(&graph, &masses, &angles);
                let forces = vec![graph.zero(); 3];
                let nothing = vec![graph.zero(); chain.rows.len()];
                let squares = LeastSquares::new(chain.rows.clone(), &chain.weights);
                // A few roundings of each of some ten terms, in units of one rounding of each of the twenty numbers.
                let loss = chain.loss(&squares.refined(&chain.offsets, &nothing, &forces));
                assert!(loss < 30.0, "{masses:?} {angles:?}: {loss:e}");
                lost = lost.max(chain.loss(&by_normal_equations(&chain, graph.zero())));
            }
        }
        // What this is for.
        assert!(lost > 1e5, "{lost:e}");
    }
}
