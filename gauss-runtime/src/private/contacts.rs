//! Where a kernel has halves of A⁻¹Wᵀ: velocities of impulses with the sizes of their terms, and columns.

use core::ops::Range;

use nalgebra::{SMatrix, SVector};

use crate::contact::{AfterImpulses, ContactSystem};
use crate::real::Real;

/// Speeds after impulses. The sizes of terms are what the same substitution makes of the sizes of its numbers, with
/// those that are taken away, below the pivots, made negative: then nothing cancels.
#[inline]
pub fn after_halves<T: Real, const N: usize, const F: usize, const R: usize>(
    z: &SVector<T, N>,
    (factors, impulses): (&SVector<T, F>, &SVector<T, R>),
    below: Range<usize>,
    velocities: impl Fn(&SVector<T, F>, &SVector<T, R>) -> SVector<T, N>,
) -> AfterImpulses<SVector<T, N>> {
    let mut sizes = *factors;
    sizes.iter_mut().for_each(|x| *x = Real::abs(*x));
    sizes.as_mut_slice()[below].iter_mut().for_each(|x| *x = -*x);
    let mut largest = *impulses;
    largest.iter_mut().for_each(|x| *x = Real::abs(*x));
    AfterImpulses::of(z, &velocities(factors, impulses), &velocities(&sizes, &largest))
}

/// The speeds after each of the unit impulses.
pub fn contact_columns<T: Real, S, const N: usize, const R: usize>(
    system: &S,
    factors: &S::ImpulseFactors,
) -> SMatrix<T, N, R>
where
    S: ContactSystem<Scalar = T, Speeds = SVector<T, N>, ContactRows = SVector<T, R>>,
{
    let still = SVector::from([T::zero(); N]);
    let unit =
        |row: usize| SVector::from(core::array::from_fn(|other| if other == row { T::one() } else { T::zero() }));
    let column = |row: usize| system.after_impulses(&still, factors, &unit(row)).speeds.data.0[0];
    SMatrix::from(core::array::from_fn(column))
}
