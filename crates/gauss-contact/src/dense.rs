//! Small dense systems of linear equations, which may be singular.

use alloc::vec;
use alloc::vec::Vec;

use gauss_runtime::real::{Real, largest_derivative};

/// The value of a number, by which decisions are made.
pub(crate) fn value<T: Real>(x: T) -> f64 {
    x.lane(0)
}

/// The rounding of values.
pub(crate) fn epsilon<T: Real>() -> f64 {
    T::EPSILON.max(f64::EPSILON)
}

/// A square matrix, row by row.
#[derive(Clone, Debug)]
pub(crate) struct Matrix<T = f64> {
    size: usize,
    entries: Vec<T>,
}

impl<T: Real> Matrix<T> {
    pub(crate) fn from_fn(size: usize, entry: impl Fn(usize, usize) -> T) -> Self {
        let entries = (0..size * size).map(|n| entry(n / size, n % size)).collect();
        Self { size, entries }
    }

    /// Number of rows.
    pub(crate) fn size(&self) -> usize {
        self.size
    }

    pub(crate) fn at(&self, i: usize, j: usize) -> T {
        self.entries[i * self.size + j]
    }

    pub(crate) fn row(&self, i: usize) -> &[T] {
        &self.entries[i * self.size..(i + 1) * self.size]
    }

    /// The same matrix in other numbers.
    pub(crate) fn in_numbers<U>(&self, number: impl Fn(T) -> U) -> Matrix<U> {
        Matrix { size: self.size, entries: self.entries.iter().copied().map(number).collect() }
    }
}

/// The complete orthogonal decomposition of a matrix whose rows and columns were scaled to a diagonal of 1.
///
/// Rows of Delassus' matrix are scalar products in the metric of A⁻¹: scaled, they are cosines. What is left of
/// a column, after those of larger remainders are taken out, is rounding where it is below 64 n roundings of the
/// largest: n terms of products that the matrix was made of, with a factor for the steps before them. Directions nearer
/// to one another than √(64 n ε), 10⁻⁷ rad and some, are therefore dependent: their products do not tell them apart.
///
/// Columns are chosen by values. Derivatives are right where dependent columns stay dependent nearby.
#[derive(Debug)]
pub(crate) struct Decomposition<T = f64> {
    scale: Vec<T>,
    /// Orthonormal columns, and the rows of their products with the columns of the matrix.
    columns: Vec<Vec<T>>,
    rows: Vec<Vec<T>>,
    /// The order in which columns were taken.
    order: Vec<usize>,
}

impl<T: Real> Decomposition<T> {
    /// `diagonal`: that of Delassus' matrix at these rows.
    pub(crate) fn new(matrix: &Matrix<T>, diagonal: impl Fn(usize) -> T) -> Self {
        Self::with_part(matrix, diagonal, 64.0 * matrix.size as f64 * epsilon::<T>())
    }

    /// The same where columns depend on others when no more than this part of the largest is left of them.
    pub(crate) fn with_part(matrix: &Matrix<T>, diagonal: impl Fn(usize) -> T, part: f64) -> Self {
        let n = matrix.size;
        let scale: Vec<T> = (0..n).map(|i| reciprocal_root(diagonal(i))).collect();
        let scaled = |i: usize, j: usize| matrix.at(i, j) * scale[i] * scale[j];
        let mut rest: Vec<Vec<T>> = (0..n).map(|j| (0..n).map(|i| scaled(i, j)).collect()).collect();
        let (mut columns, mut rows, mut order) = (Vec::<Vec<T>>::new(), Vec::<Vec<T>>::new(), Vec::new());
        let mut largest = 0.0_f64;
        while order.len() < n {
            let left = (0..n).filter(|j| !order.contains(j));
            let Some((next, most)) = left
                .map(|j| (j, size(&rest[j])))
                .max_by(|a, b| a.1.partial_cmp(&b.1).unwrap_or(core::cmp::Ordering::Equal))
            else {
                break;
            };
            largest = largest.max(most);
            if most <= part * largest || most.is_nan() {
                break;
            }
            let mut column = rest[next].clone();
            // Twice is enough (Kahan).
            for (q, row) in columns.iter().zip(&mut rows) {
                let part = dot(q, &column);
                row[next] += part;
                add(&mut column, -part, q);
            }
            let length = norm(&column);
            column.iter_mut().for_each(|x| *x /= length);
            let mut row = vec![T::zero(); n];
            row[next] = length;
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
    pub(crate) fn solve(&self, b: &[T]) -> Vec<T> {
        let mut rest: Vec<T> = b.iter().zip(&self.scale).map(|(b, scale)| *b * *scale).collect();
        let mut parts: Vec<T> = Vec::with_capacity(self.rank());
        for column in &self.columns {
            let part = dot(column, &rest);
            add(&mut rest, -part, column);
            parts.push(part);
        }
        let mut x = if self.rank() == b.len() { self.back(&parts) } else { self.least(&parts) };
        x.iter_mut().zip(&self.scale).for_each(|(x, scale)| *x *= *scale);
        x
    }

    /// Whether all columns are independent.
    pub(crate) fn is_regular(&self) -> bool {
        self.rank() == self.scale.len()
    }

    /// Directions in which x may change without a change of `M x`, orthonormal in scaled unknowns.
    pub(crate) fn free(&self) -> Vec<Vec<T>> {
        let n = self.scale.len();
        let mut basis: Vec<Vec<T>> = Vec::new();
        let across = |basis: &[Vec<T>], direction: &mut Vec<T>| {
            for _ in 0..2 {
                for q in basis {
                    let part = dot(q, direction);
                    add(direction, -part, q);
                }
            }
        };
        let unit = |mut direction: Vec<T>| {
            let length = norm(&direction);
            direction.iter_mut().for_each(|x| *x /= length);
            direction
        };
        for row in &self.rows {
            let mut direction = row.clone();
            across(&basis, &mut direction);
            basis.push(unit(direction));
        }
        let axis = |k: usize| (0..n).map(|i| if i == k { T::one() } else { T::zero() }).collect();
        let mut left: Vec<Vec<T>> = (0..n).map(axis).collect();
        while basis.len() < n {
            left.iter_mut().for_each(|direction| across(&basis, direction));
            let longest = (0..left.len()).max_by(|&a, &b| size(&left[a]).total_cmp(&size(&left[b])));
            let Some(k) = longest else { break };
            basis.push(unit(left.swap_remove(k)));
        }
        let scaled = |direction: &Vec<T>| direction.iter().zip(&self.scale).map(|(x, scale)| *x * *scale).collect();
        basis.iter().skip(self.rank()).map(scaled).collect()
    }

    /// All columns are independent.
    fn back(&self, parts: &[T]) -> Vec<T> {
        let mut x = vec![T::zero(); parts.len()];
        for k in (0..parts.len()).rev() {
            let known = sum(self.order[k + 1..].iter().map(|&j| self.rows[k][j] * x[j]));
            x[self.order[k]] = (parts[k] - known) / self.rows[k][self.order[k]];
        }
        x
    }

    /// A combination of the rows.
    fn least(&self, parts: &[T]) -> Vec<T> {
        let n = self.scale.len();
        let (mut basis, mut weights) = (Vec::<Vec<T>>::new(), Vec::<T>::new());
        let mut x = vec![T::zero(); n];
        for (row, part) in self.rows.iter().zip(parts) {
            let (mut direction, mut known) = (row.clone(), T::zero());
            for _ in 0..2 {
                for (q, weight) in basis.iter().zip(&weights) {
                    let product = dot(q, &direction);
                    known += product * *weight;
                    add(&mut direction, -product, q);
                }
            }
            let length = norm(&direction);
            direction.iter_mut().for_each(|d| *d /= length);
            let weight = (*part - known) / length;
            add(&mut x, weight, &direction);
            basis.push(direction);
            weights.push(weight);
        }
        x
    }
}

fn reciprocal_root<T: Real>(diagonal: T) -> T {
    if value(diagonal) > 0.0 { diagonal.sqrt().recip() } else { T::one() }
}

pub(crate) fn sum<T: Real>(terms: impl Iterator<Item = T>) -> T {
    terms.fold(T::zero(), |sum, term| sum + term)
}

pub(crate) fn dot<T: Real>(a: &[T], b: &[T]) -> T {
    sum(a.iter().zip(b).map(|(a, b)| *a * *b))
}

/// Euclidean norm; of zeros without derivatives it is a zero without derivatives.
pub(crate) fn norm<T: Real>(a: &[T]) -> T {
    let zero = T::DERIVATIVES && a.iter().all(|x| value(*x) == 0.0 && largest_derivative(*x) == 0.0);
    if zero { T::zero() } else { dot(a, a).sqrt() }
}

/// The norm of the values: of what may vanish, where the norm has no derivative.
pub(crate) fn size<T: Real>(a: &[T]) -> f64 {
    Real::sqrt(sum(a.iter().map(|x| value(*x) * value(*x))))
}

fn add<T: Real>(a: &mut [T], factor: T, b: &[T]) {
    a.iter_mut().zip(b).for_each(|(a, b)| *a += factor * *b);
}

#[cfg(test)]
#[path = "dense_tests.rs"]
mod tests;
