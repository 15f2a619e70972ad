//! Dense linear systems in memory that is given: factors by elimination, with row pivots where the matrix is not
//! symmetric.

use gauss_runtime::real::Real;

use crate::lockstep::{Lockstep, larger, last};

/// The place of a row, in two bytes: less to be written in each step.
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
pub(crate) fn dot_and_size<T: Real>(a: &[T], b: &[T]) -> (T, T) {
    let (mut sums, mut sizes) = ([T::zero(); 4], [T::zero(); 4]);
    let mut add = |k: usize, term: T| {
        sums[k] += term;
        sizes[k] += term.abs();
    };
    let (a, rest_a) = a.as_chunks::<4>();
    let (b, rest_b) = b.as_chunks::<4>();
    for (a, b) in a.iter().zip(b) {
        (0..4).for_each(|k| add(k, a[k] * b[k]));
    }
    rest_a.iter().zip(rest_b).for_each(|(a, b)| add(0, *a * *b));
    let whole = |all: [T; 4]| (all[0] + all[1]) + (all[2] + all[3]);
    (whole(sums), whole(sizes))
}

/// Replaces a matrix, row by row, by its factors; `order` takes the rows in the order of their pivots. Whether no pivot
/// is smaller than a part of the largest entry of its column.
pub(crate) fn factorise<T: Real>(lockstep: &Lockstep, matrix: &mut [T], order: &mut [Place], part: f64) -> bool {
    let n = order.len();
    order.iter_mut().enumerate().for_each(|(i, row)| *row = i as Place);
    for k in 0..n {
        let size = |i: usize| matrix[i * n + k].abs();
        // Of the factors above and of what is left: an entry of the column to begin with is not far from these.
        let column = (0..n).map(size).fold(T::zero(), larger);
        // The last of the largest.
        let pivot = (k..n).reduce(|a, b| if lockstep.less(size(b), size(a)) { a } else { b }).unwrap_or(k);
        if pivot != k {
            (0..n).for_each(|j| matrix.swap(pivot * n + j, k * n + j));
            order.swap(pivot, k);
        }
        let (above, below) = matrix.split_at_mut((k + 1) * n);
        let first = &above[k * n..];
        let diagonal = first[k];
        let is_small = lockstep.at_most(diagonal.abs(), T::from_f64(part) * column);
        if is_small || !lockstep.agree::<T>(|lane| diagonal.lane(lane).is_finite()) {
            return false;
        }
        // Of contacts in a row, as in a stack, most of it is zero.
        let end = last(lockstep, 0..n, first).unwrap_or(k) + 1;
        for row in below.chunks_exact_mut(n) {
            let factor = row[k] / diagonal;
            row[k] = factor;
            if !lockstep.is_zero(factor) {
                row[k + 1..end].iter_mut().zip(&first[k + 1..end]).for_each(|(x, y)| *x -= factor * *y);
            }
        }
    }
    true
}

/// Solves for a right side that is given in the order of the rows before elimination.
pub(crate) fn solve<T: Real>(factors: &[T], order: &[Place], right: &[T], x: &mut [T]) {
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

/// Numbers that are worked on together: rows of symmetric matrices begin at multiples of so many.
const WIDTH: usize = 4;

/// Length in memory of the rows of a symmetric matrix of n unknowns; what is after them is zero.
pub(crate) const fn stride(n: usize) -> usize {
    n.next_multiple_of(WIDTH)
}

/// `x −= Σ factor y` from a place on, and some before it with which it begins.
#[inline]
fn subtract<T: Real, const N: usize>(x: &mut [T], factors: [T; N], y: [&[T]; N], from: usize, to: usize) {
    let whole = from - from % WIDTH..to.next_multiple_of(WIDTH);
    let (x, _) = x[whole.clone()].as_chunks_mut::<WIDTH>();
    let y = y.map(|y| y[whole.clone()].as_chunks::<WIDTH>().0);
    let y = y.map(|y| &y[..x.len()]);
    for (c, x) in x.iter_mut().enumerate() {
        for p in 0..N {
            (0..WIDTH).for_each(|k| x[k] -= factors[p] * y[p][c][k]);
        }
    }
}

/// Replaces the upper triangle of a symmetric positive semidefinite matrix, in rows of [`stride`], by its factors: of
/// `RᵀD⁻¹R` the rows of R, with D⁻¹ on the diagonal; below it is nothing of use. `ends` takes where each row has its
/// last entry that is not zero, and `diagonal` what is its first. Whether no pivot is smaller than a part of the
/// diagonal entry that it was to begin with: of these matrices no other entry of a column is larger in its own scale.
pub(crate) fn factorise_symmetric<T: Real>(
    lockstep: &Lockstep,
    matrix: &mut [T],
    ends: &mut [Place],
    diagonal: &mut [T],
    part: f64,
) -> bool {
    let n = ends.len();
    let rows = stride(n);
    (0..n).for_each(|k| diagonal[k] = matrix[k * rows + k]);
    // Rows of some pivots at a time, so that those below them are read and written once for all.
    for from in (0..n).step_by(WIDTH) {
        let to = (from + WIDTH).min(n);
        let (above, below) = matrix.split_at_mut(to * rows);
        let pivots = &mut above[from * rows..];
        let mut most = 0;
        for k in from..to {
            let (before, after) = pivots.split_at_mut((k - from + 1) * rows);
            let first = &mut before[(k - from) * rows..];
            let (pivot, was) = (first[k], diagonal[k]);
            let is_large = |size: f64, was: f64| size > part * was && size > 0.0 && size.is_finite();
            if !lockstep.agree::<T>(|lane| is_large(pivot.lane(lane), was.lane(lane))) {
                return false;
            }
            first[k] = T::one() / pivot;
            // Contacts in a row, as in a stack, are coupled to their neighbours only. What is zero may have
            // a derivative.
            let end = if T::DERIVATIVES { n - 1 } else { last(lockstep, k..n, first).unwrap_or(k) };
            ends[k] = (end + 1) as Place;
            most = end.max(most);
            for (i, row) in (k + 1..to).zip(after.chunks_exact_mut(rows)) {
                subtract(row, [first[i] * first[k]], [first], i, end + 1);
            }
        }
        let pivot = |p: usize| &pivots[p * rows..(p + 1) * rows];
        for (i, row) in (to..=most).zip(below.chunks_exact_mut(rows)) {
            let factors: [T; WIDTH] = core::array::from_fn(|p| pivot(p)[i] * pivot(p)[from + p]);
            subtract(row, factors, core::array::from_fn(pivot), i, most + 1);
        }
    }
    true
}

/// Solves by the factors of a symmetric matrix. The solution has room for a whole row.
pub(crate) fn solve_symmetric<T: Real>(factors: &[T], ends: &[Place], right: &[T], x: &mut [T]) {
    let n = right.len();
    let rows = stride(n);
    x[..n].copy_from_slice(right);
    for k in 0..n {
        let (row, end) = (&factors[k * rows..(k + 1) * rows], usize::from(ends[k]));
        let factor = x[k] * row[k];
        let whole = (k + 1).next_multiple_of(WIDTH).min(end);
        (k + 1..whole).for_each(|j| x[j] -= factor * row[j]);
        if whole < end {
            subtract(x, [factor], [row], whole, end);
        }
    }
    for k in (0..n).rev() {
        let (row, end) = (&factors[k * rows..(k + 1) * rows], usize::from(ends[k]));
        x[k] = (x[k] - dot(&row[k + 1..end], &x[k + 1..end])) * row[k];
    }
}

#[cfg(test)]
mod tests {
    use alloc::vec::Vec;

    use super::{Lockstep, factorise, factorise_symmetric, solve, solve_symmetric};

    fn lockstep() -> Lockstep {
        Lockstep::default()
    }

    #[test]
    fn symmetric_systems_are_solved() {
        // Pivots 4, 9, 1 by an integer triangle.
        let matrix = [4.0, 2.0, -4.0, 0.0, 2.0, 10.0, 4.0, 0.0, -4.0, 4.0, 9.0, 0.0];
        let x = [3.0, -1.0, 2.0];
        let right: Vec<f64> = matrix.chunks(4).map(|row| row.iter().zip(&x).map(|(a, x)| a * x).sum()).collect();
        let (mut factors, mut found, mut ends) = (matrix, [0.0; 4], [0; 3]);
        assert!(factorise_symmetric(&lockstep(), &mut factors, &mut ends, &mut [0.0; 3], 1e-11));
        solve_symmetric(&factors, &ends, &right, &mut found);
        // The inverse has entries up to 3, right sides up to 22, three products each.
        found.iter().zip(&x).for_each(|(a, b)| assert!((a - b).abs() <= 3.0 * 66.0 * f64::EPSILON, "{a} {b}"));
        let dependent = &mut [1.0, 2.0, 0.0, 0.0, 2.0, 4.0, 0.0, 0.0];
        assert!(!factorise_symmetric(&lockstep(), dependent, &mut [0; 2], &mut [0.0; 2], 1e-11));
        assert!(!factorise_symmetric(&lockstep(), &mut [f64::NAN, 0.0, 0.0, 0.0], &mut [0], &mut [0.0], 0.0));
    }

    /// A chain of masses: each row ends after its neighbour, and what is solved is what the rows say.
    #[test]
    fn rows_end_where_couplings_do() {
        const N: usize = 23;
        let entry = |i: usize, j: usize| match i.abs_diff(j) {
            0 => 2.5,
            1 => -1.0,
            _ => 0.0,
        };
        let mut factors: Vec<f64> =
            (0..N).flat_map(|i| (0..24).map(move |j| if j < N { entry(i, j) } else { 0.0 })).collect();
        let x: Vec<f64> = (0..N).map(|i| ((i * i) % 7) as f64 - 3.0).collect();
        let right: Vec<f64> = (0..N).map(|i| (0..N).map(|j| entry(i, j) * x[j]).sum()).collect();
        let (mut found, mut ends) = ([0.0; 24], [0; N]);
        assert!(factorise_symmetric(&lockstep(), &mut factors, &mut ends, &mut [0.0; N], 0.0));
        solve_symmetric(&factors, &ends, &right, &mut found);
        (0..N).for_each(|k| assert_eq!(usize::from(ends[k]), (k + 2).min(N)));
        // The inverse is at most 1/(2.5 − 2), right sides up to 14, three products each.
        found.iter().zip(&x).for_each(|(a, b)| assert!((a - b).abs() <= 3.0 * 28.0 * f64::EPSILON, "{a} {b}"));
    }

    #[test]
    fn systems_are_solved_with_pivots() {
        // The first pivot is zero; an integer solution, which elimination finds to rounding.
        let matrix = [0.0, 2.0, 1.0, 4.0, -2.0, 0.0, 1.0, 1.0, 3.0];
        let x = [3.0, -1.0, 2.0];
        let right: Vec<f64> = matrix.chunks(3).map(|row| row.iter().zip(&x).map(|(a, x)| a * x).sum()).collect();
        let (mut factors, mut order, mut found) = (matrix, [0; 3], [0.0; 3]);
        assert!(factorise(&lockstep(), &mut factors, &mut order, 0.0));
        solve(&factors, &order, &right, &mut found);
        // Six products of numbers up to 12 stand behind each.
        found.iter().zip(&x).for_each(|(a, b)| assert!((a - b).abs() <= 6.0 * 12.0 * f64::EPSILON, "{a} {b}"));
        assert!(!factorise(&lockstep(), &mut [1.0, 2.0, 2.0, 4.0], &mut [0; 2], 0.0));
    }
}
