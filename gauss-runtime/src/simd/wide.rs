//! The vectors of the crate `wide` as scalars.

use ::wide::{f32x8, f32x16, f64x4, f64x8};

use super::Packed;
use crate::real::Real;

/// Functions without an instruction of their own, lane by lane: the bits of each lane are those that it would get
/// alone.
macro_rules! lane_by_lane {
    ($vector:ident: $($name:ident)+) => {$(
        #[inline(always)]
        fn $name(self) -> Self {
            $vector::new(self.to_array().map(Real::$name))
        }
    )+};
}

macro_rules! implement_real {
    ($($vector:ident of $lanes:literal $float:ident;)+) => {$(
        impl Real for $vector {
            const LANES: usize = $lanes;
            const EPSILON: f64 = <$float as Real>::EPSILON;
            const DERIVATIVES: bool = false;

            #[inline(always)]
            fn lane(self, i: usize) -> f64 {
                f64::from(self.as_array()[i])
            }

            #[inline(always)]
            fn zero() -> Self {
                $vector::splat(0.0)
            }

            #[inline(always)]
            fn one() -> Self {
                $vector::splat(1.0)
            }

            #[inline(always)]
            fn from_f64(value: f64) -> Self {
                $vector::splat(<$float as Real>::from_f64(value))
            }

            #[inline(always)]
            fn ratio(p: i64, q: i64) -> Self {
                $vector::splat(<$float as Real>::ratio(p, q))
            }

            // Fused where that of plain floats is.
            #[inline(always)]
            fn fma(self, b: Self, c: Self) -> Self {
                #[cfg(all(
                    feature = "std",
                    any(target_feature = "fma", all(target_arch = "aarch64", target_feature = "neon"))
                ))]
                return self.mul_add(b, c);
                #[cfg(not(all(
                    feature = "std",
                    any(target_feature = "fma", all(target_arch = "aarch64", target_feature = "neon"))
                )))]
                return self * b + c;
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                $vector::sqrt(self)
            }

            #[inline(always)]
            fn abs(self) -> Self {
                $vector::abs(self)
            }

            lane_by_lane!($vector: sin cos tan asin acos atan sinh cosh tanh exp ln);

            #[inline(always)]
            fn sin_cos(self) -> (Self, Self) {
                let (sines, cosines) = Real::sines_and_cosines(self.to_array());
                ($vector::new(sines), $vector::new(cosines))
            }

            #[inline(always)]
            fn atan2(self, x: Self) -> Self {
                let (ordinates, abscissas) = (self.to_array(), x.to_array());
                $vector::new(core::array::from_fn(|i| Real::atan2(ordinates[i], abscissas[i])))
            }

            #[inline(always)]
            fn is_finite(self) -> bool {
                // 0, or NaN where the number is not finite.
                let null = self - self;
                null.simd_eq(null).all()
            }

            #[inline(always)]
            fn select_lt(a: Self, b: Self, x: Self, y: Self) -> Self {
                a.simd_lt(b).select(x, y)
            }

            #[inline(always)]
            fn all_lt(a: Self, b: Self) -> bool {
                a.simd_lt(b).all()
            }
        }

        impl Packed for $vector {
            type Single = $float;
            const WIDTH: usize = $lanes;

            #[inline(always)]
            fn repeat(single: &$float) -> Self {
                $vector::splat(*single)
            }

            #[inline(always)]
            fn extract(&self, lane: usize) -> $float {
                self.as_array()[lane]
            }

            #[inline(always)]
            fn replace(&mut self, lane: usize, single: &$float) {
                self.as_mut_array()[lane] = *single;
            }
        }
    )+};
}

implement_real! {
    f64x4 of 4 f64;
    f64x8 of 8 f64;
    f32x8 of 8 f32;
    f32x16 of 16 f32;
}
