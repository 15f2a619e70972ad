//! Many right-hand sides of one factored system, solved for together.

use nalgebra::SMatrix;

use crate::real::Real;

/// Columns that go through the substitution together, as many as registers hold two or four of.
const TOGETHER: usize = 8;

/// Columns of right-hand sides or of solutions in bundles, each for every unknown.
pub type Columns<T, const N: usize, const B: usize> = [[[T; TOGETHER]; N]; B];

/// `to − factor·of`.
#[inline(always)]
pub fn subtract_multiple<T: Real>(to: &mut [T; TOGETHER], factor: T, of: &[T; TOGETHER]) {
    for (to, &of) in to.iter_mut().zip(of) {
        *to = (-factor).fma(of, *to);
    }
}

/// `factor·of`.
#[inline(always)]
pub fn multiple<T: Real>(factor: T, of: &[T; TOGETHER]) -> [T; TOGETHER] {
    of.map(|of| factor * of)
}

/// Adds solutions to columns of a matrix, each in the row of its unknown after the first rows; `columns` are pairs of a column of x and
/// one of the matrix.
#[inline]
pub fn add_columns<T: Real, const N: usize, const B: usize, const R: usize, const C: usize>(
    to: &mut SMatrix<T, R, C>,
    x: &Columns<T, N, B>,
    order: &[usize; N],
    first: usize,
    columns: &[(usize, usize)],
) {
    for &(slot, column) in columns {
        let to = &mut to.data.0[column];
        for (&unknown, x) in order.iter().zip(&x[slot / TOGETHER]) {
            let row = first + unknown;
            to[row] += x[slot % TOGETHER];
        }
    }
}

/// A matrix without entries.
#[inline(always)]
pub fn zeros<T: Real, const R: usize, const C: usize>() -> SMatrix<T, R, C> {
    SMatrix::from([[T::zero(); R]; C])
}
