//! Properties that bounds need of a floating-point format.

use core::fmt::Display;

use gauss_runtime::real::Real;

mod sealed {
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
}

/// The formats that [`Bounded`](crate::Bounded) knows: `f32` and `f64`, of IEEE 754.
pub trait Float: Real + PartialOrd + Display + sealed::Sealed {
    /// Unit roundoff u: half the distance from 1 to the next larger number.
    #[doc(hidden)]
    const UNIT: Self;
    /// 1 + 16u: a factor that rounds up what at most twelve operations rounded down.
    #[doc(hidden)]
    const MORE: Self;
    /// 1 − 16u: the same downwards.
    #[doc(hidden)]
    const LESS: Self;
    /// The least positive number: more than what one gradual underflow loses.
    #[doc(hidden)]
    const TINY: Self;
    /// The least normal number.
    #[doc(hidden)]
    const LEAST_NORMAL: Self;
    /// +∞.
    #[doc(hidden)]
    const INFINITY: Self;
    /// Integers up to this are exact.
    #[doc(hidden)]
    const INTEGERS: u64;

    /// Whether a product with this number is exact: a power of two.
    #[doc(hidden)]
    fn is_power_of_two(self) -> bool;

    /// Bound of the rounding to nearest of a result, gradual underflow included. What u·|value| itself loses to
    /// underflow is less than the least number.
    #[doc(hidden)]
    #[inline(always)]
    fn half_unit(value: Self) -> Self {
        Self::UNIT * value.abs() + Self::TINY
    }
}

macro_rules! implement_float {
    ($($float:ident $fraction:literal;)+) => {$(
        impl Float for $float {
            const UNIT: Self = 0.5 * $float::EPSILON;
            const MORE: Self = 1.0 + 8.0 * $float::EPSILON;
            const LESS: Self = 1.0 - 8.0 * $float::EPSILON;
            const TINY: Self = $float::from_bits(1);
            const LEAST_NORMAL: Self = $float::MIN_POSITIVE;
            const INFINITY: Self = $float::INFINITY;
            const INTEGERS: u64 = 1 << ($fraction + 1);

            #[inline(always)]
            fn is_power_of_two(self) -> bool {
                // Subnormal numbers and zero have no fraction either, but the least exponent.
                self.to_bits() & ((1 << $fraction) - 1) == 0 && self.abs() >= $float::MIN_POSITIVE
            }
        }
    )+};
}

implement_float! {
    f32 23;
    f64 52;
}
