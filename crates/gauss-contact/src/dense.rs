//! Small dense systems of linear equations, which may be singular.

use alloc::vec;
use alloc::vec::Vec;

use gauss_runtime::real::Real;

/// A square matrix, row by row.
#[derive(Clone, Debug)]
pub(crate) struct Matrix {
    size: usize,
    entries: Vec<f64>,
}

impl Matrix {
    pub(crate) fn from_fn(size: usize, entry: impl Fn(usize, usize) -> f64) -> Self {
        let entries = (0..size * size).map(|n| entry(n / size, n % size)).collect();
        Self { size, entries }
    }

    pub(crate) fn at(&self, i: usize, j: usize) -> f64 {
        self.entries[i * self.size + j]
    }

    pub(crate) fn row(&self, i: usize) -> &[f64] {
        &self.entries[i * self.size..(i + 1) * self.size]
    }
}

/// The complete orthogonal decomposition of a matrix whose rows and columns were scaled to a diagonal of 1.
///
/// Rows of Delassus' matrix are scalar products in the metric of A⁻¹: scaled, they are cosines. What is left of
/// a column, after those of larger remainders are taken out, is rounding where it is below 64 n roundings of the
/// largest: n terms of products that the matrix was made of, with a factor for the steps before them. Directions nearer
/// to one another than √(64 n ε), 10⁻⁷ rad and some, are therefore dependent: their products do not tell them apart.
#[derive(Debug)]
pub(crate) struct Decomposition {
    scale: Vec<f64>,
    /// Orthonormal columns, and the rows of their products with the columns of the matrix.
    columns: Vec<Vec<f64>>,
    rows: Vec<Vec<f64>>,
    /// The order in which columns were taken.
    order: Vec<usize>,
}

impl Decomposition {
    /// `diagonal`: that of Delassus' matrix at these rows.
    pub(crate) fn new(matrix: &Matrix, diagonal: impl Fn(usize) -> f64) -> Self {
        let n = matrix.size;
        let scale: Vec<f64> = (0..n).map(|i| reciprocal_root(diagonal(i))).collect();
        let scaled = |i: usize, j: usize| matrix.at(i, j) * scale[i] * scale[j];
        let mut rest: Vec<Vec<f64>> = (0..n).map(|j| (0..n).map(|i| scaled(i, j)).collect()).collect();
        let (mut columns, mut rows, mut order) = (Vec::<Vec<f64>>::new(), Vec::<Vec<f64>>::new(), Vec::new());
        let mut largest = 0.0_f64;
        while order.len() < n {
            let left = (0..n).filter(|j| !order.contains(j));
            let Some((next, size)) = left
                .map(|j| (j, norm(&rest[j])))
                .max_by(|a, b| a.1.partial_cmp(&b.1).unwrap_or(core::cmp::Ordering::Equal))
            else {
                break;
            };
            largest = largest.max(size);
            if size <= 64.0 * n as f64 * f64::EPSILON * largest || size.is_nan() {
                break;
            }
            let mut column = rest[next].clone();
            // Twice is enough (Kahan).
            for (q, row) in columns.iter().zip(&mut rows) {
                let part = dot(q, &column);
                row[next] += part;
                add(&mut column, -part, q);
            }
            let size = norm(&column);
            column.iter_mut().for_each(|x| *x /= size);
            let mut row = vec![0.0; n];
            row[next] = size;
            order.push(next);
            for j in (0..n).filter(|j| !order.contains(j)) {
                row[j] = dot(&column, &rest[j]);
                add(&mut rest[j], -row[j], &column);
            }
            columns.push(column);
            rows.push(row);
        }
        Self { scale, columns, rows, order }
    }

    /// The number of independent columns.
    pub(crate) fn rank(&self) -> usize {
        self.order.len()
    }

    /// The x that solves `M x = b` best, and of these the one of least norm in scaled unknowns: Σ D_ii x_i².
    pub(crate) fn solve(&self, b: &[f64]) -> Vec<f64> {
        let mut rest: Vec<f64> = b.iter().zip(&self.scale).map(|(b, scale)| b * scale).collect();
        let mut parts: Vec<f64> = Vec::with_capacity(self.rank());
        for column in &self.columns {
            let part = dot(column, &rest);
            add(&mut rest, -part, column);
            parts.push(part);
        }
        let mut x = if self.rank() == b.len() { self.back(&parts) } else { self.least(&parts) };
        x.iter_mut().zip(&self.scale).for_each(|(x, scale)| *x *= scale);
        x
    }

    /// All columns are independent.
    fn back(&self, parts: &[f64]) -> Vec<f64> {
        let mut x = vec![0.0; parts.len()];
        for k in (0..parts.len()).rev() {
            let known: f64 = self.order[k + 1..].iter().map(|&j| self.rows[k][j] * x[j]).sum();
            x[self.order[k]] = (parts[k] - known) / self.rows[k][self.order[k]];
        }
        x
    }

    /// A combination of the rows.
    fn least(&self, parts: &[f64]) -> Vec<f64> {
        let n = self.scale.len();
        let (mut basis, mut weights) = (Vec::<Vec<f64>>::new(), Vec::<f64>::new());
        let mut x = vec![0.0; n];
        for (row, part) in self.rows.iter().zip(parts) {
            let (mut direction, mut known) = (row.clone(), 0.0);
            for _ in 0..2 {
                for (q, weight) in basis.iter().zip(&weights) {
                    let product = dot(q, &direction);
                    known += product * weight;
                    add(&mut direction, -product, q);
                }
            }
            let size = norm(&direction);
            direction.iter_mut().for_each(|d| *d /= size);
            let weight = (part - known) / size;
            add(&mut x, weight, &direction);
            basis.push(direction);
            weights.push(weight);
        }
        x
    }
}

fn reciprocal_root(diagonal: f64) -> f64 {
    if diagonal > 0.0 { Real::sqrt(diagonal).recip() } else { 1.0 }
}

pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

pub(crate) fn norm(a: &[f64]) -> f64 {
    Real::sqrt(dot(a, a))
}

fn add(a: &mut [f64], factor: f64, b: &[f64]) {
    a.iter_mut().zip(b).for_each(|(a, b)| *a += factor * b);
}

#[cfg(test)]
#[path = "dense_tests.rs"]
mod tests;
