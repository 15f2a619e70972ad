//! Kernels of Python, as the code that calls them sees them.

use gauss_runtime::prelude::*;
use gauss_runtime::simd::Packed;

/// A kernel in any number of lanes.
pub trait System:
    GaussSystem<Scalar: Packed<Single = f64>, Input: VectorSpace<<Self as GaussSystem>::Scalar>>
    + DescribedSystem
    + Send
    + Sync
    + 'static
{
}

impl<S> System for S where
    S: GaussSystem<Scalar: Packed<Single = f64>, Input: VectorSpace<<S as GaussSystem>::Scalar>>
        + DescribedSystem
        + Send
        + Sync
        + 'static
{
}
