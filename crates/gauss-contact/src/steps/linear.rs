//! Dense linear systems in memory that is given: factors by elimination with row pivots.

/// The place of a row. There are 256 at most; small numbers leave less to be zeroed in each step.
pub(crate) type Place = u16;

/// The scalar product.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    summed(a, b, |a, b| a * b)
}

/// The sum over pairs, in four sums that do not wait for one another.
pub(crate) fn summed(a: &[f64], b: &[f64], product: impl Fn(f64, f64) -> f64) -> f64 {
    let mut sums = [0.0; 4];
    let (a, rest_a) = a.as_chunks::<4>();
    let (b, rest_b) = b.as_chunks::<4>();
    for (a, b) in a.iter().zip(b) {
        (0..4).for_each(|k| sums[k] += product(a[k], b[k]));
    }
    let rest: f64 = rest_a.iter().zip(rest_b).map(|(a, b)| product(*a, *b)).sum();
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
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
        for row in below.chunks_exact_mut(n) {
            let factor = row[k] / diagonal;
            row[k] = factor;
            if factor != 0.0 {
                row[k + 1..].iter_mut().zip(&first[k + 1..n]).for_each(|(x, y)| *x -= factor * y);
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

#[cfg(test)]
mod tests {
    use alloc::vec::Vec;

    use super::{factorise, solve};

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
