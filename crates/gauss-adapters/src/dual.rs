//! The dual numbers of the crate `num-dual` as scalars: derivatives of whole simulations.
//!
//! ```
//! use gauss_adapters::DualNumber;
//! use gauss_runtime::prelude::*;
//! use num_dual::Dual64;
//!
//! #[derive(GaussDynamics)]
//! #[gauss(coordinates(x), particle(mass = m, position = [x, 0, 0]), spring(s, along = x, stiffness = k))]
//! struct Oscillator<T> {
//!     m: T,
//!     k: T,
//! }
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let number = |x: f64| DualNumber(Dual64::from_re(x));
//! // The derivative by the mass: ẍ = −kx/m.
//! let kernel = Oscillator { m: DualNumber(Dual64::from_re(2.0).derivative()), k: number(3.0) }.kernel()?;
//! let a = kernel.acceleration(number(0.0), &SVector::from([number(0.1)]), &SVector::from([number(0.0)]), &())[0];
//! assert!((a.re + 0.15).abs() < 1e-15 && (a.eps - 0.075).abs() < 1e-15);
//! # Ok(())
//! # }
//! ```

use core::fmt::Debug;
use core::ops::{Add, AddAssign, Deref, DerefMut, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use gauss_runtime::__crates_0_1_0::packs_of_one;
use gauss_runtime::real::Real;
use num_dual::{Dual, Dual2, DualNum, DualSVec, HyperDual};

mod sealed {
    pub trait Sealed {}
}

/// The dual numbers that [`DualNumber`] takes: `Dual64`, `Dual2_64`, `HyperDual64` and `DualSVec64<N>`.
pub trait Parts: DualNum<InnerDual = f64> + Copy + PartialEq + Debug + Send + Sync + sealed::Sealed {
    /// The number without its derivatives.
    fn value(&self) -> f64;

    /// Whether the value and all derivatives are finite.
    fn are_finite(&self) -> bool;
}

/// The derivative parts of a dual number, all but its value.
macro_rules! implement_parts {
    ($([$($generics:tt)*] $dual:ty: $number:ident, $($finite:expr),+;)+) => {$(
        impl<$($generics)*> sealed::Sealed for $dual {}

        impl<$($generics)*> Parts for $dual {
            #[inline(always)]
            fn value(&self) -> f64 {
                self.re
            }

            #[inline]
            fn are_finite(&self) -> bool {
                let $number = self;
                self.re.is_finite() $(&& $finite)+
            }
        }
    )+};
}

implement_parts! {
    [] Dual<f64>: number, number.eps.is_finite();
    [] Dual2<f64>: number, number.v1.is_finite(), number.v2.is_finite();
    [] HyperDual<f64>: number, number.eps1.is_finite(), number.eps2.is_finite(), number.eps1eps2.is_finite();
    [const N: usize] DualSVec<f64, N>: number, number.eps.0.is_none_or(|slopes| slopes.iter().all(|slope| slope.is_finite()));
}

/// A dual number of `num-dual` as the scalar of kernels and integrators. Its parts are those of the number inside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DualNumber<D>(pub D);

impl<D> Deref for DualNumber<D> {
    type Target = D;

    #[inline(always)]
    fn deref(&self) -> &D {
        &self.0
    }
}

impl<D> DerefMut for DualNumber<D> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut D {
        &mut self.0
    }
}

macro_rules! operators {
    ($($operator:ident $function:ident $assign:ident $in_place:ident;)+) => {$(
        impl<D: $operator<Output = D>> $operator for DualNumber<D> {
            type Output = Self;

            #[inline]
            fn $function(self, other: Self) -> Self {
                Self($operator::$function(self.0, other.0))
            }
        }

        impl<D: $assign> $assign for DualNumber<D> {
            #[inline]
            fn $in_place(&mut self, other: Self) {
                $assign::$in_place(&mut self.0, other.0);
            }
        }
    )+};
}

operators! {
    Add add AddAssign add_assign;
    Sub sub SubAssign sub_assign;
    Mul mul MulAssign mul_assign;
    Div div DivAssign div_assign;
}

impl<D: Neg<Output = D>> Neg for DualNumber<D> {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

/// The functions of `DualNum` that have the same name and meaning there.
macro_rules! functions {
    ($($name:ident)+) => {$(
        #[inline]
        fn $name(self) -> Self {
            Self(DualNum::$name(&self.0))
        }
    )+};
}

impl<D: Parts> Real for DualNumber<D> {
    const LANES: usize = 1;

    #[inline(always)]
    fn lane(self, _: usize) -> f64 {
        self.0.value()
    }

    #[inline(always)]
    fn from_f64(value: f64) -> Self {
        Self(D::from_re(value))
    }

    #[inline(always)]
    fn ratio(p: i64, q: i64) -> Self {
        Self::from_f64(f64::ratio(p, q))
    }

    functions!(sqrt asin acos atan sinh cosh tanh exp ln recip);

    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        let (sine, cosine) = DualNum::sin_cos(&self.0);
        (Self(sine), Self(cosine))
    }

    #[inline]
    fn atan2(self, x: Self) -> Self {
        Self(DualNum::atan2(&self.0, x.0))
    }

    #[inline]
    fn is_finite(self) -> bool {
        self.0.are_finite()
    }

    #[inline(always)]
    fn select_lt(a: Self, b: Self, x: Self, y: Self) -> Self {
        if a.0.value() < b.0.value() { x } else { y }
    }
}

packs_of_one! {
    [D: Parts] DualNumber<D>;
}
