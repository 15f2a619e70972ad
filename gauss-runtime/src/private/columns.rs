//! Many right-hand sides of one factored system, solved for together.

use nalgebra::SMatrix;

use crate::linearize::Linearization;
use crate::real::Real;

/// Columns that go through the substitution together, as many as registers hold two or four of.
const TOGETHER: usize = 8;

/// A number of each of the columns that go together.
type Lanes<T> = [T; TOGETHER];

/// The rows of a bundle, each on a cache line where numbers are doubles: registers of 64 bytes are then loaded from one
/// line. The only structure here, and loops count by hand: rustc takes structures in code that it puts into a caller
/// apart one by one, which in a function of a hundred thousand statements takes seconds.
#[derive(Clone, Copy)]
#[repr(C, align(64))]
pub struct Bundle<T, const N: usize>(pub [Lanes<T>; N]);

/// `to − factor·of`.
#[inline(always)]
pub fn subtract_multiple<T: Real>(to: &mut Lanes<T>, factor: T, of: &Lanes<T>) {
    let mut lane = 0;
    while lane < TOGETHER {
        to[lane] = (-factor).fma(of[lane], to[lane]);
        lane += 1;
    }
}

/// `factor·of`.
#[inline(always)]
pub fn multiple<T: Real>(factor: T, of: &Lanes<T>) -> Lanes<T> {
    let mut product = *of;
    let mut lane = 0;
    while lane < TOGETHER {
        product[lane] = factor * of[lane];
        lane += 1;
    }
    product
}

/// Writes solutions to columns, each in the row of its unknown after the first rows.
#[inline(always)]
pub fn put<T: Real, const N: usize, const R: usize>(
    columns: &mut [&mut [T; R]; TOGETHER],
    x: &Bundle<T, N>,
    order: &[usize; N],
    first: usize,
) {
    // Where columns are is loaded once. Column by column, compilers would gather what is far apart.
    let mut columns = columns.each_mut().map(|column| &mut **column);
    for (&unknown, x) in order.iter().zip(&x.0) {
        for (column, &x) in columns.iter_mut().zip(x) {
            column[first + unknown] = x;
        }
    }
}

/// The columns of a matrix.
#[inline(always)]
pub fn each_column<T: Real, const R: usize, const C: usize>(matrix: &mut SMatrix<T, R, C>) -> [&mut [T; R]; C] {
    matrix.data.0.each_mut()
}

/// The column of a matrix with one.
#[inline(always)]
pub fn only_column<T: Real, const R: usize>(matrix: &mut SMatrix<T, R, 1>) -> &mut [T; R] {
    &mut matrix.data.0[0]
}

/// A matrix without entries.
#[inline(always)]
pub fn zeros<T: Real, const R: usize, const C: usize>() -> SMatrix<T, R, C> {
    SMatrix::from([[T::zero(); R]; C])
}

/// A linearization whose derivatives are filled in where it is handed over: in a function as long as a program
/// compilers would fill a copy.
#[inline(always)]
pub fn filled<T: Real, const D: usize, const U: usize>(
    rate: [T; D],
    fill: impl FnOnce(&mut Linearization<T, D, U>),
) -> Linearization<T, D, U> {
    let rate = SMatrix::from([rate]);
    let mut linear = Linearization { rate, by_state: zeros(), by_time: zeros(), by_input: zeros() };
    fill(&mut linear);
    linear
}

/// A matrix from its columns.
#[inline(always)]
pub fn columns<T: Real, const R: usize, const C: usize>(columns: [[T; R]; C]) -> SMatrix<T, R, C> {
    SMatrix::from(columns)
}
