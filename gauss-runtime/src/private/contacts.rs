//! Contact columns and sizes of the terms of velocities of impulses, for kernels that have halves of A⁻¹Wᵀ.

use core::ops::Range;

use nalgebra::{SMatrix, SVector};

use crate::contact::ContactSystem;
use crate::real::Real;

/// The sizes of the terms of velocities of impulses: what the same substitution makes of the sizes of its numbers, with
/// those that are taken away, below the pivots, made negative: then nothing cancels.
pub fn impulse_terms_of_halves<T: Real, S, const F: usize, const C: usize, const R: usize>(
    system: &S,
    (factors, impulses): (&SMatrix<T, F, C>, &SVector<T, R>),
    below: Range<usize>,
) -> S::Speeds
where
    S: ContactSystem<Scalar = T, ImpulseFactors = SMatrix<T, F, C>, ContactRows = SVector<T, R>>,
{
    let mut sizes = *factors;
    sizes.iter_mut().for_each(|x| *x = Real::abs(*x));
    sizes.as_mut_slice()[below].iter_mut().for_each(|x| *x = -*x);
    let mut largest = *impulses;
    largest.iter_mut().for_each(|x| *x = Real::abs(*x));
    system.impulse_velocities(&sizes, &largest)
}

/// The velocities of each of the unit impulses.
pub fn contact_columns<T: Real, S, const N: usize, const R: usize>(
    system: &S,
    factors: &S::ImpulseFactors,
) -> SMatrix<T, N, R>
where
    S: ContactSystem<Scalar = T, Speeds = SVector<T, N>, ContactRows = SVector<T, R>>,
{
    let unit =
        |row: usize| SVector::from(core::array::from_fn(|other| if other == row { T::one() } else { T::zero() }));
    let column = |row: usize| system.impulse_velocities(factors, &unit(row)).data.0[0];
    SMatrix::from(core::array::from_fn(column))
}
