//! Vectors of as many numbers as there are limbs that are alike.
//!
//! Without vectors with fused products arrays stand in their place, and products are rounded as those of numbers are.

#[cfg(all(feature = "wide", target_feature = "avx", target_feature = "fma"))]
use ::wide::{f64x2 as Two, f64x4 as Four};
#[cfg(not(all(feature = "wide", target_feature = "avx", target_feature = "fma")))]
use arrays::{Four, Two};

macro_rules! functions {
    ($lanes:ident, $many:literal) => {
        use super::$lanes as Lanes;

        /// These numbers.
        #[inline(always)]
        pub fn vector(lanes: [f64; $many]) -> Lanes {
            Lanes::new(lanes)
        }

        /// A number in all lanes.
        #[inline(always)]
        pub fn spread(number: f64) -> Lanes {
            Lanes::splat(number)
        }

        /// The numbers.
        #[inline(always)]
        pub fn lanes(vector: Lanes) -> [f64; $many] {
            vector.to_array()
        }

        /// a + b.
        #[inline(always)]
        pub fn sum(a: Lanes, b: Lanes) -> Lanes {
            a + b
        }

        /// a − b.
        #[inline(always)]
        pub fn difference(a: Lanes, b: Lanes) -> Lanes {
            a - b
        }

        /// a b.
        #[inline(always)]
        pub fn product(a: Lanes, b: Lanes) -> Lanes {
            a * b
        }

        /// a b + c.
        #[inline(always)]
        pub fn product_plus(a: Lanes, b: Lanes, c: Lanes) -> Lanes {
            a.mul_add(b, c)
        }

        /// c − a b.
        #[inline(always)]
        pub fn less_product(a: Lanes, b: Lanes, c: Lanes) -> Lanes {
            a.mul_neg_add(b, c)
        }

        /// −a.
        #[inline(always)]
        pub fn negative(a: Lanes) -> Lanes {
            -a
        }
    };
}

/// Vectors for two limbs.
pub mod two {
    functions!(Two, 2);
}

/// Vectors for three or four limbs.
pub mod four {
    functions!(Four, 4);
}

#[cfg(not(all(feature = "wide", target_feature = "avx", target_feature = "fma")))]
mod arrays {
    use core::array::from_fn;
    use core::ops::{Add, Mul, Neg, Sub};

    use super::super::fma_f64;

    pub type Two = Numbers<2>;
    pub type Four = Numbers<4>;

    /// Numbers in place of a vector.
    #[derive(Clone, Copy, Debug)]
    pub struct Numbers<const N: usize>([f64; N]);

    impl<const N: usize> Numbers<N> {
        #[inline(always)]
        pub fn new(numbers: [f64; N]) -> Self {
            Self(numbers)
        }

        #[inline(always)]
        pub fn splat(number: f64) -> Self {
            Self([number; N])
        }

        #[inline(always)]
        pub fn to_array(self) -> [f64; N] {
            self.0
        }

        /// self b + c.
        #[inline(always)]
        pub fn mul_add(self, b: Self, c: Self) -> Self {
            Self(from_fn(|k| fma_f64(self.0[k], b.0[k], c.0[k])))
        }

        /// c − self b.
        #[inline(always)]
        pub fn mul_neg_add(self, b: Self, c: Self) -> Self {
            Self(from_fn(|k| fma_f64(-self.0[k], b.0[k], c.0[k])))
        }
    }

    macro_rules! operators {
        ($($operator:ident $method:ident $sign:tt;)+) => {$(
            impl<const N: usize> $operator for Numbers<N> {
                type Output = Self;

                #[inline(always)]
                fn $method(self, other: Self) -> Self {
                    Self(from_fn(|k| self.0[k] $sign other.0[k]))
                }
            }
        )+};
    }

    operators! {
        Add add +;
        Sub sub -;
        Mul mul *;
    }

    impl<const N: usize> Neg for Numbers<N> {
        type Output = Self;

        #[inline(always)]
        fn neg(self) -> Self {
            Self(self.0.map(|number| -number))
        }
    }
}
