//! Dense linear systems in memory that is given: factors by elimination, with row pivots where the matrix is not
//! symmetric.

use gauss_runtime::real::Real;

use crate::dense::value;

/// The place of a row. There are 256 at most; small numbers leave less to be zeroed in each step.
pub(crate) type Place = u16;

/// The scalar product, in four sums that do not wait for one another.
pub(crate) fn dot<T: Real>(a: &[T], b: &[T]) -> T {
    let mut sums = [T::zero(); 4];
    let (a, rest_a) = a.as_chunks::<4>();
    let (b, rest_b) = b.as_chunks::<4>();
    for (a, b) in a.iter().zip(b) {
        (0..4).for_each(|k| sums[k] += a[k] * b[k]);
    }
    let rest = rest_a.iter().zip(rest_b).fold(T::zero(), |sum, (a, b)| sum + *a * *b);
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

/// The scalar product, and the sum of the sizes of its terms.
pub(crate) fn dot_and_size(a: &[f64], b: &[f64]) -> (f64, f64) {
    let (mut sums, mut sizes) = ([0.0; 4], [0.0; 4]);
    let mut add = |k: usize, term: f64| {
        sums[k] += term;
        sizes[k] += term.abs();
    };
    let (a, rest_a) = a.as_chunks::<4>();
    let (b, rest_b) = b.as_chunks::<4>();
    for (a, b) in a.iter().zip(b) {
        (0..4).for_each(|k| add(k, a[k] * b[k]));
    }
    rest_a.iter().zip(rest_b).for_each(|(a, b)| add(0, a * b));
    let whole = |all: [f64; 4]| (all[0] + all[1]) + (all[2] + all[3]);
    (whole(sums), whole(sizes))
}

/// Replaces a matrix, row by row, by its factors; `order` takes the rows in the order of their pivots. Whether no pivot
/// is smaller than a part of the largest entry of its column.
pub(crate) fn factorise(matrix: &mut [f64], order: &mut [Place], part: f64) -> bool {
    let n = order.len();
    order.iter_mut().enumerate().for_each(|(i, row)| *row = i as Place);
    for k in 0..n {
        let size = |i: &usize| matrix[*i * n + k].abs();
        // Of the factors above and of what is left: an entry of the column to begin with is not far from these.
        let column = (0..n).map(|i| size(&i)).fold(0.0, f64::max);
        let Some(pivot) = (k..n).max_by(|a, b| size(a).total_cmp(&size(b))) else { return true };
        if pivot != k {
            (0..n).for_each(|j| matrix.swap(pivot * n + j, k * n + j));
            order.swap(pivot, k);
        }
        let (above, below) = matrix.split_at_mut((k + 1) * n);
        let first = &above[k * n..];
        let diagonal = first[k];
        if diagonal.abs() <= part * column || !diagonal.is_finite() {
            return false;
        }
        // Of contacts in a row, as in a stack, most of it is zero.
        let end = first[..n].iter().rposition(|x| *x != 0.0).unwrap_or(k) + 1;
        for row in below.chunks_exact_mut(n) {
            let factor = row[k] / diagonal;
            row[k] = factor;
            if factor != 0.0 {
                row[k + 1..end].iter_mut().zip(&first[k + 1..end]).for_each(|(x, y)| *x -= factor * y);
            }
        }
    }
    true
}

/// Solves for a right side that is given in the order of the rows before elimination.
pub(crate) fn solve(factors: &[f64], order: &[Place], right: &[f64], x: &mut [f64]) {
    let n = order.len();
    for k in 0..n {
        let row = &factors[k * n..k * n + k];
        x[k] = right[usize::from(order[k])] - dot(row, &x[..k]);
    }
    for k in (0..n).rev() {
        let row = &factors[k * n + k + 1..(k + 1) * n];
        x[k] = (x[k] - dot(row, &x[k + 1..n])) / factors[k * n + k];
    }
}

/// Replaces the upper triangle of a symmetric positive semidefinite matrix, row by row, by its factors: of `RᵀD⁻¹R`
/// the rows of R, with D⁻¹ on the diagonal. Whether no pivot is smaller than a part of the diagonal entry that it was
/// to begin with: of these matrices no other entry of a column is larger in its own scale.
pub(crate) fn factorise_symmetric<T: Real>(matrix: &mut [T], n: usize, part: f64) -> bool {
    for k in 0..n {
        let (above, below) = matrix.split_at_mut((k + 1) * n);
        let first = &mut above[k * n + k..];
        // The diagonal as it was is kept below it, in the column of the first unknown.
        let diagonal = first[0];
        let before = if k == 0 { diagonal } else { above[k * n] };
        let (size, before) = (value(diagonal), value(before));
        if !(size > part * before && size > 0.0 && size.is_finite()) {
            return false;
        }
        let first = &mut above[k * n + k..];
        let inverse = T::one() / diagonal;
        first[0] = inverse;
        for (i, row) in (1..).zip(below.chunks_exact_mut(n)) {
            if k == 0 {
                row[0] = row[i];
            }
            let factor = first[i] * inverse;
            // What is zero may have a derivative.
            if T::DERIVATIVES || value(factor) != 0.0 {
                row[k + i..].iter_mut().zip(&first[i..]).for_each(|(x, y)| *x -= factor * *y);
            }
        }
    }
    true
}

/// Solves by the factors of a symmetric matrix.
pub(crate) fn solve_symmetric<T: Real>(factors: &[T], right: &[T], x: &mut [T]) {
    let n = right.len();
    x.copy_from_slice(right);
    for k in 0..n {
        let (row, inverse) = (&factors[k * n + k + 1..(k + 1) * n], factors[k * n + k]);
        let factor = x[k] * inverse;
        x[k + 1..].iter_mut().zip(row).for_each(|(x, y)| *x -= factor * *y);
    }
    for k in (0..n).rev() {
        let (row, inverse) = (&factors[k * n + k + 1..(k + 1) * n], factors[k * n + k]);
        x[k] = (x[k] - dot(row, &x[k + 1..])) * inverse;
    }
}

#[cfg(test)]
mod tests {
    use alloc::vec::Vec;

    use super::{factorise, factorise_symmetric, solve, solve_symmetric};

    #[test]
    fn symmetric_systems_are_solved() {
        // Pivots 4, 9, 1 by an integer triangle.
        let matrix = [4.0, 2.0, -4.0, 2.0, 10.0, 4.0, -4.0, 4.0, 9.0];
        let x = [3.0, -1.0, 2.0];
        let right: Vec<f64> = matrix.chunks(3).map(|row| row.iter().zip(&x).map(|(a, x)| a * x).sum()).collect();
        let (mut factors, mut found) = (matrix, [0.0; 3]);
        assert!(factorise_symmetric(&mut factors, 3, 1e-11));
        solve_symmetric(&factors, &right, &mut found);
        // The inverse has entries up to 3, right sides up to 22, three products each.
        found.iter().zip(&x).for_each(|(a, b)| assert!((a - b).abs() <= 3.0 * 66.0 * f64::EPSILON, "{a} {b}"));
        assert!(!factorise_symmetric(&mut [1.0, 2.0, 2.0, 4.0], 2, 1e-11));
        assert!(!factorise_symmetric(&mut [f64::NAN], 1, 0.0));
    }

    #[test]
    fn systems_are_solved_with_pivots() {
        // The first pivot is zero; an integer solution, which elimination finds to rounding.
        let matrix = [0.0, 2.0, 1.0, 4.0, -2.0, 0.0, 1.0, 1.0, 3.0];
        let x = [3.0, -1.0, 2.0];
        let right: Vec<f64> = matrix.chunks(3).map(|row| row.iter().zip(&x).map(|(a, x)| a * x).sum()).collect();
        let (mut factors, mut order, mut found) = (matrix, [0; 3], [0.0; 3]);
        assert!(factorise(&mut factors, &mut order, 0.0));
        solve(&factors, &order, &right, &mut found);
        // Six products of numbers up to 12 stand behind each.
        found.iter().zip(&x).for_each(|(a, b)| assert!((a - b).abs() <= 6.0 * 12.0 * f64::EPSILON, "{a} {b}"));
        assert!(!factorise(&mut [1.0, 2.0, 2.0, 4.0], &mut [0; 2], 0.0));
    }
}
