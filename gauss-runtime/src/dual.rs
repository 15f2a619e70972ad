//! The dual numbers of the crate `num-dual` as scalars.

use num_dual::{Dual, Dual2, DualNum, DualSVec, HyperDual};

use crate::real::Real;
use crate::simd::packs_of_one;

/// The functions of `DualNum` that have the same name and meaning there.
macro_rules! functions {
    ($($name:ident)+) => {$(
        #[inline]
        fn $name(self) -> Self {
            DualNum::$name(&self)
        }
    )+};
}

/// A dual number, given the functions that tell whether the parts beside its value are finite.
macro_rules! implement_real {
    ($([$($generics:tt)*] $dual:ty: $number:ident, $($finite:expr),+;)+) => {$(
        impl<$($generics)*> Real for $dual {
            const LANES: usize = 1;

            #[inline(always)]
            fn lane(self, _: usize) -> f64 {
                self.re
            }

            #[inline(always)]
            fn zero() -> Self {
                Self::from_re(0.0)
            }

            #[inline(always)]
            fn one() -> Self {
                Self::from_re(1.0)
            }

            #[inline(always)]
            fn from_f64(value: f64) -> Self {
                Self::from_re(value)
            }

            #[inline(always)]
            fn ratio(p: i64, q: i64) -> Self {
                Self::from_re(f64::ratio(p, q))
            }

            functions!(sqrt asin acos atan sinh cosh tanh exp ln recip);

            #[inline]
            fn sin_cos(self) -> (Self, Self) {
                DualNum::sin_cos(&self)
            }

            #[inline]
            fn atan2(self, x: Self) -> Self {
                DualNum::atan2(&self, x)
            }

            #[inline]
            fn abs(self) -> Self {
                Self::select_lt(self, Self::zero(), -self, self)
            }

            #[inline]
            fn is_finite(self) -> bool {
                let $number = &self;
                self.re.is_finite() $(&& $finite)+
            }

            #[inline(always)]
            fn select_lt(a: Self, b: Self, x: Self, y: Self) -> Self {
                if a.re < b.re { x } else { y }
            }
        }
    )+};
}

implement_real! {
    [] Dual<f64>: number, number.eps.is_finite();
    [] Dual2<f64>: number, number.v1.is_finite(), number.v2.is_finite();
    [] HyperDual<f64>: number, number.eps1.is_finite(), number.eps2.is_finite(), number.eps1eps2.is_finite();
    [const N: usize] DualSVec<f64, N>: number, number.eps.0.is_none_or(|slopes| slopes.iter().all(|slope| slope.is_finite()));
}

packs_of_one! {
    [] Dual<f64>;
    [] Dual2<f64>;
    [] HyperDual<f64>;
    [const N: usize] DualSVec<f64, N>;
}
