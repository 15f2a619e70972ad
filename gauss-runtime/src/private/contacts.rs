//! Columns of A⁻¹Wᵀ where a kernel has halves of them.

use nalgebra::{SMatrix, SVector};

use crate::contact::ContactSystem;
use crate::real::Real;

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
