//! Linear spaces of quasi-velocities, momenta and increments, and pairs of them.

use core::fmt::Debug;

use nalgebra::SVector;

use crate::lie::carried::two_sum;
use crate::real::Real;

/// A finite-dimensional linear space over `T`: quasi-velocities, momenta, forces, increments of a configuration.
pub trait VectorSpace<T: Real>: Copy + Debug {
    /// The number of components.
    const DIM: usize;

    /// The null vector.
    fn zero() -> Self;

    /// `self + a·x`.
    fn add_scaled(&self, a: T, x: &Self) -> Self;

    /// `a·self`.
    fn scale(&self, a: T) -> Self;

    /// Component `i`.
    ///
    /// # Panics
    /// When `i ≥ DIM`.
    fn component(&self, i: usize) -> T;

    /// Replaces component `i`.
    ///
    /// # Panics
    /// When `i ≥ DIM`.
    fn set_component(&mut self, i: usize, value: T);

    /// All components as one vector. Another length than [`DIM`](Self::DIM) does not compile.
    #[inline(always)]
    fn flat<const N: usize>(&self) -> SVector<T, N> {
        const { holds(N, Self::DIM) };
        SVector::from_fn(|i, _| self.component(i))
    }

    /// The vector with these components. Another length than [`DIM`](Self::DIM) does not compile.
    #[inline(always)]
    fn from_flat<const N: usize>(flat: &SVector<T, N>) -> Self {
        const { holds(N, Self::DIM) };
        let mut vector = Self::zero();
        (0..N).for_each(|i| vector.set_component(i, flat[i]));
        vector
    }

    /// The largest magnitude among all components and lanes; NaN when there is a NaN.
    fn max_norm(&self) -> f64 {
        let mut largest = 0.0;
        for i in 0..Self::DIM {
            for lane in 0..T::LANES {
                let magnitude = self.component(i).lane(lane).abs();
                // Written so that a NaN wins and stays.
                if magnitude > largest || magnitude.is_nan() {
                    largest = magnitude;
                }
                if largest.is_nan() {
                    return largest;
                }
            }
        }
        largest
    }

    /// Whether every component is finite.
    #[inline]
    fn is_finite(&self) -> bool {
        (0..Self::DIM).all(|i| self.component(i).is_finite())
    }
}

const fn holds(length: usize, components: usize) {
    assert!(length == components, "a flat vector has as many components as the vector that it stands for");
}

impl<T: Real, const N: usize> VectorSpace<T> for SVector<T, N> {
    const DIM: usize = N;

    #[inline(always)]
    fn zero() -> Self {
        Self::from([T::zero(); N])
    }

    #[inline(always)]
    fn add_scaled(&self, a: T, x: &Self) -> Self {
        Self::from(core::array::from_fn(|i| a.fma(x.data.0[0][i], self.data.0[0][i])))
    }

    #[inline(always)]
    fn scale(&self, a: T) -> Self {
        Self::from(self.data.0[0].map(|component| a * component))
    }

    #[inline(always)]
    fn component(&self, i: usize) -> T {
        self.data.0[0][i]
    }

    #[inline(always)]
    fn set_component(&mut self, i: usize, value: T) {
        self.data.0[0][i] = value;
    }
}

/// `(x + carried) + increment` rounded to nearest, and the exact rounding error of that sum.
#[inline(always)]
pub(crate) fn add_carrying<T: Real, V: VectorSpace<T>>(x: &V, increment: &V, carried: &V) -> (V, V) {
    let (mut sum, mut rest) = (*x, *carried);
    for i in 0..V::DIM {
        let (high, low) = two_sum(x.component(i), increment.component(i) + carried.component(i));
        sum.set_component(i, high);
        rest.set_component(i, low);
    }
    (sum, rest)
}

/// A pair of vectors: the increments of a pair of configurations, first's components before second's. Flat vectors
/// become pairs and pairs flat vectors by `.into()`; states of kernels are moved by flat vectors without it:
/// [`Increments`](crate::increments::Increments).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Product<A, B> {
    /// Part of the first factor.
    pub first: A,
    /// Part of the second factor.
    pub second: B,
}

/// `x.into()` where a pair is asked for and a flat vector is there; another length does not compile.
impl<T: Real, A: VectorSpace<T>, B: VectorSpace<T>, const N: usize> From<SVector<T, N>> for Product<A, B> {
    #[inline(always)]
    fn from(flat: SVector<T, N>) -> Self {
        Self::from_flat(&flat)
    }
}

/// The components one after another; another length does not compile.
impl<T: Real, A: VectorSpace<T>, B: VectorSpace<T>, const N: usize> From<Product<A, B>> for SVector<T, N> {
    #[inline(always)]
    fn from(pair: Product<A, B>) -> Self {
        pair.flat()
    }
}

impl<T: Real, A: VectorSpace<T>, B: VectorSpace<T>> VectorSpace<T> for Product<A, B> {
    const DIM: usize = A::DIM + B::DIM;

    #[inline(always)]
    fn zero() -> Self {
        Self { first: A::zero(), second: B::zero() }
    }

    #[inline(always)]
    fn add_scaled(&self, a: T, x: &Self) -> Self {
        Self { first: self.first.add_scaled(a, &x.first), second: self.second.add_scaled(a, &x.second) }
    }

    #[inline(always)]
    fn scale(&self, a: T) -> Self {
        Self { first: self.first.scale(a), second: self.second.scale(a) }
    }

    #[inline(always)]
    fn component(&self, i: usize) -> T {
        if i < A::DIM { self.first.component(i) } else { self.second.component(i - A::DIM) }
    }

    #[inline(always)]
    fn set_component(&mut self, i: usize, value: T) {
        if i < A::DIM {
            self.first.set_component(i, value);
        } else {
            self.second.set_component(i - A::DIM, value);
        }
    }
}
