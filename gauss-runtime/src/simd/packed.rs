//! Numbers, vectors and configurations of several states in lockstep, and how one state is put in and taken out.

use nalgebra::{Isometry2, Isometry3, SMatrix, UnitQuaternion};

use super::together::{Operation, Question, each, one_by_one};
use crate::configuration::{Configuration, Product, VectorSpace};
use crate::real::Real;

/// A number, vector or configuration made of packs: the values of [`WIDTH`](Self::WIDTH) states in lockstep.
///
/// A plain scalar is a pack of one. Implemented for the containers that states are made of.
pub trait Packed: Copy {
    /// The value of one state.
    type Single: Copy;

    /// Number of the states.
    const WIDTH: usize;

    /// One value for every state.
    fn repeat(single: &Self::Single) -> Self;

    /// The value of the state in a lane.
    ///
    /// # Panics
    /// When `lane ≥ WIDTH`.
    fn extract(&self, lane: usize) -> Self::Single;

    /// Replaces the value of the state in a lane.
    ///
    /// # Panics
    /// When `lane ≥ WIDTH`.
    fn replace(&mut self, lane: usize, single: &Self::Single);

    /// One operation on the numbers of arrays, with the bits of one by one: plain floats are done in vectors.
    #[doc(hidden)]
    #[inline(always)]
    fn together<O: Operation, const N: usize>(numbers: [&[Self; N]; 4]) -> [Self; N]
    where
        Self: Real,
    {
        one_by_one::<Self, O, N>(numbers)
    }

    /// Whether the answer is yes for all numbers of arrays.
    #[doc(hidden)]
    #[inline(always)]
    fn all_together<Q: Question, const N: usize>(numbers: [&[Self; N]; 2]) -> bool
    where
        Self: Real,
    {
        each::<Self, Q, N>(numbers)
    }
}

/// [`Packed`] of scalars that are one number: one state of a batch is one number. For crates with
/// scalars of their own, by `__crates_0_1_0`.
#[doc(hidden)]
#[macro_export]
macro_rules! __packs_of_one_0_1_0 {
    ($([$($generics:tt)*] $scalar:ty $({ $($own:tt)* })?;)+) => {$(
        impl<$($generics)*> $crate::simd::Packed for $scalar {
            type Single = Self;
            const WIDTH: usize = 1;

            #[inline(always)]
            fn repeat(single: &Self) -> Self {
                *single
            }

            #[inline(always)]
            fn extract(&self, lane: usize) -> Self {
                [*self][lane]
            }

            #[inline(always)]
            fn replace(&mut self, lane: usize, single: &Self) {
                [self][lane].clone_from(single);
            }

            $($($own)*)?
        }
    )+};
}

/// The same numbers in another scalar.
#[inline]
fn in_another_scalar<A: Configuration, B: Configuration>(from: &A, number: impl Fn(A::Scalar) -> B::Scalar) -> B {
    let (from, mut to) = (from.components(), B::Components::zero());
    for i in 0..<A::Components as VectorSpace<A::Scalar>>::DIM {
        to.set_component(i, number(from.component(i)));
    }
    B::from_components(&to)
}

/// Configurations, which are components and nothing else.
macro_rules! packed_components {
    ($($container:ident)+) => {$(
        impl<T: Real + Packed<Single: Real>> Packed for $container<T> {
            type Single = $container<T::Single>;
            const WIDTH: usize = T::WIDTH;

            #[inline]
            fn repeat(single: &Self::Single) -> Self {
                in_another_scalar(single, |number| T::repeat(&number))
            }

            #[inline]
            fn extract(&self, lane: usize) -> Self::Single {
                in_another_scalar(self, |number| number.extract(lane))
            }

            #[inline]
            fn replace(&mut self, lane: usize, single: &Self::Single) {
                let (new, mut components) = (single.components(), self.components());
                for i in 0..<<Self as Configuration>::Components as VectorSpace<T>>::DIM {
                    let mut number = components.component(i);
                    number.replace(lane, &new.component(i));
                    components.set_component(i, number);
                }
                *self = Self::from_components(&components);
            }
        }
    )+};
}

packed_components! { UnitQuaternion Isometry2 Isometry3 }

impl<T: Real + Packed<Single: Real>, const N: usize, const M: usize> Packed for SMatrix<T, N, M> {
    type Single = SMatrix<T::Single, N, M>;
    const WIDTH: usize = T::WIDTH;

    #[inline]
    fn repeat(single: &Self::Single) -> Self {
        Self::from_fn(|i, j| T::repeat(&single[(i, j)]))
    }

    #[inline]
    fn extract(&self, lane: usize) -> Self::Single {
        SMatrix::from_fn(|i, j| self[(i, j)].extract(lane))
    }

    #[inline]
    fn replace(&mut self, lane: usize, single: &Self::Single) {
        self.iter_mut().zip(single.iter()).for_each(|(number, new)| number.replace(lane, new));
    }
}

/// Nothing, as the input of a scene without inputs: it is the same in all lanes.
impl Packed for () {
    type Single = ();
    const WIDTH: usize = 1;

    #[inline]
    fn repeat((): &()) {}

    #[inline]
    fn extract(&self, _: usize) {}

    #[inline]
    fn replace(&mut self, _: usize, (): &()) {}
}

impl<A: Packed, B: Packed> Packed for (A, B) {
    type Single = (A::Single, B::Single);
    const WIDTH: usize = A::WIDTH;

    #[inline]
    fn repeat(single: &Self::Single) -> Self {
        (A::repeat(&single.0), B::repeat(&single.1))
    }

    #[inline]
    fn extract(&self, lane: usize) -> Self::Single {
        (self.0.extract(lane), self.1.extract(lane))
    }

    #[inline]
    fn replace(&mut self, lane: usize, single: &Self::Single) {
        self.0.replace(lane, &single.0);
        self.1.replace(lane, &single.1);
    }
}

impl<A: Packed, B: Packed> Packed for Product<A, B> {
    type Single = Product<A::Single, B::Single>;
    const WIDTH: usize = A::WIDTH;

    #[inline]
    fn repeat(single: &Self::Single) -> Self {
        Self { first: A::repeat(&single.first), second: B::repeat(&single.second) }
    }

    #[inline]
    fn extract(&self, lane: usize) -> Self::Single {
        Product { first: self.first.extract(lane), second: self.second.extract(lane) }
    }

    #[inline]
    fn replace(&mut self, lane: usize, single: &Self::Single) {
        self.first.replace(lane, &single.first);
        self.second.replace(lane, &single.second);
    }
}
