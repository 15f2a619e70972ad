//! Packs of numbers that are worked on in lockstep: a kernel or an integrator in packs works on as many states as there
//! are lanes, for about the price of one.
//!
//! | scalar | with |
//! |---|---|
//! | [`Lanes<T, N>`](Lanes) | any scalar that is [`Packed`] and any number of lanes: an array; of `f32` and `f64` in the vectors below, where there are |
//! | `wide::f64x4`, `wide::f64x8`, `wide::f32x8`, `wide::f32x16` | the feature `wide`: instructions of that width where the target has them |
//!
//! Eight numbers of 64 bits are best in `wide::f64x8`, which always lies in one line of the cache; four are as good in
//! `Lanes<f64, 4>` (`BENCHMARKS.md`). The scalar is chosen by the parameter of the struct that a kernel is derived
//! from, `Body<T>`.
//!
//! **Bits.** No operation looks at another lane, and none is reordered: a kernel gives each lane the bits that it would
//! get alone. So do explicit methods on components; exponentials of increments choose their series by the largest lane
//! from half a radian on, and iterations of implicit methods go on until all lanes are solved.

mod floats;
mod packed;
mod together;
#[cfg(feature = "wide")]
mod wide;

pub use packed::Packed;

use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use crate::real::Real;
use together::{
    Choice, Difference, Finite, LessThan, Magnitude, Operation, Opposite, Product, ProductAndSum, Quotient, Reciprocal,
    Root, Sum,
};

/// N numbers in lockstep: of `f64`, four fill a vector of 256 bits, eight one of 512.
///
/// ```
/// use gauss_runtime::prelude::*;
///
/// let x = Lanes::from_fn(|i| i as f64);
/// let y: Lanes<f64, 4> = x.fma(x, Lanes::splat(1.0)).sqrt();
/// assert_eq!(y[3], 10.0_f64.sqrt());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
pub struct Lanes<T, const N: usize>(pub [T; N]);

impl<T: Copy, const N: usize> Lanes<T, N> {
    /// One value in every lane.
    #[must_use]
    #[inline(always)]
    pub const fn splat(value: T) -> Self {
        Self([value; N])
    }

    /// The values of a function of the lane.
    #[must_use]
    #[inline(always)]
    pub fn from_fn(value: impl FnMut(usize) -> T) -> Self {
        Self(core::array::from_fn(value))
    }

    #[inline(always)]
    fn map(self, f: impl Fn(T) -> T) -> Self {
        Self::from_fn(|i| f(self.0[i]))
    }

    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(T, T) -> T) -> Self {
        Self::from_fn(|i| f(self.0[i], other.0[i]))
    }
}

impl<T: Real + Packed, const N: usize> Lanes<T, N> {
    #[inline(always)]
    fn together<O: Operation>(&self, other: &Self) -> Self {
        Self(T::together::<O, N>([&self.0, &other.0, &other.0, &other.0]))
    }
}

impl<T, const N: usize> core::ops::Index<usize> for Lanes<T, N> {
    type Output = T;

    #[inline(always)]
    fn index(&self, lane: usize) -> &T {
        &self.0[lane]
    }
}

impl<T, const N: usize> core::ops::IndexMut<usize> for Lanes<T, N> {
    #[inline(always)]
    fn index_mut(&mut self, lane: usize) -> &mut T {
        &mut self.0[lane]
    }
}

macro_rules! lane_by_lane {
    ($($trait:ident $method:ident $assign_trait:ident $assign:ident $operation:ident;)+) => {$(
        impl<T: Real + Packed, const N: usize> $trait for Lanes<T, N> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                self.together::<$operation>(&other)
            }
        }

        impl<T: Real + Packed, const N: usize> $assign_trait for Lanes<T, N> {
            #[inline(always)]
            fn $assign(&mut self, other: Self) {
                *self = self.$method(other);
            }
        }
    )+};
}

lane_by_lane! {
    Add add AddAssign add_assign Sum;
    Sub sub SubAssign sub_assign Difference;
    Mul mul MulAssign mul_assign Product;
    Div div DivAssign div_assign Quotient;
}

impl<T: Real + Packed, const N: usize> Neg for Lanes<T, N> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        self.together::<Opposite>(&self)
    }
}

macro_rules! functions {
    ($($name:ident)+) => {$(
        #[inline(always)]
        fn $name(self) -> Self {
            self.map(T::$name)
        }
    )+};
}

impl<T: Real + Packed, const N: usize> Real for Lanes<T, N> {
    const LANES: usize = N * T::LANES;
    const EPSILON: f64 = T::EPSILON;
    const DERIVATIVES: bool = T::DERIVATIVES;

    #[inline(always)]
    fn lane(self, i: usize) -> f64 {
        self.0[i / T::LANES].lane(i % T::LANES)
    }

    #[inline(always)]
    fn zero() -> Self {
        Self::splat(T::zero())
    }

    #[inline(always)]
    fn one() -> Self {
        Self::splat(T::one())
    }

    #[inline(always)]
    fn from_f64(value: f64) -> Self {
        Self::splat(T::from_f64(value))
    }

    #[inline(always)]
    fn ratio(p: i64, q: i64) -> Self {
        Self::splat(T::ratio(p, q))
    }

    #[inline(always)]
    fn fma(self, b: Self, c: Self) -> Self {
        Self(T::together::<ProductAndSum, N>([&self.0, &b.0, &c.0, &c.0]))
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.together::<Root>(&self)
    }

    #[inline(always)]
    fn abs(self) -> Self {
        self.together::<Magnitude>(&self)
    }

    #[inline(always)]
    fn recip(self) -> Self {
        self.together::<Reciprocal>(&self)
    }

    functions!(sin cos tan asin acos atan sinh cosh tanh exp ln signum);

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (sines, cosines) = T::sines_and_cosines(self.0);
        (Self(sines), Self(cosines))
    }

    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        self.zip(x, T::atan2)
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.zip(other, T::min)
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.zip(other, T::max)
    }

    #[inline(always)]
    fn omitting(self, at_most: Self) -> Self {
        self.zip(at_most, T::omitting)
    }

    #[inline(always)]
    fn is_finite(self) -> bool {
        T::all_together::<Finite, N>([&self.0, &self.0])
    }

    #[inline(always)]
    fn select_lt(a: Self, b: Self, x: Self, y: Self) -> Self {
        Self(T::together::<Choice, N>([&a.0, &b.0, &x.0, &y.0]))
    }

    #[inline(always)]
    fn all_lt(a: Self, b: Self) -> bool {
        T::all_together::<LessThan, N>([&a.0, &b.0])
    }
}

impl<T: Real, const N: usize> Packed for Lanes<T, N> {
    type Single = T;
    const WIDTH: usize = N;

    #[inline(always)]
    fn repeat(single: &T) -> Self {
        Self::splat(*single)
    }

    #[inline(always)]
    fn extract(&self, lane: usize) -> T {
        self.0[lane]
    }

    #[inline(always)]
    fn replace(&mut self, lane: usize, single: &T) {
        self.0[lane] = *single;
    }
}
