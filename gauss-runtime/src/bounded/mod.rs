//! How many digits of a result are right: a scalar that carries a guaranteed bound on its own rounding.
//!
//! Every generic kernel, [`linearize`](crate::linearize), energies and integrators of fixed step take [`Bounded`] as
//! they take `f64`. Its `value` is, to the last bit, what the same code computes in the plain scalar; its `bound` is
//! never below the distance of that value from what exact arithmetic makes of the same inputs.
//!
#![cfg_attr(
    feature = "derive",
    doc = r##"
```
use gauss_runtime::bounded::exact;
use gauss_runtime::prelude::*;

/// An arm of two links that carries a load at its end.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(a, b),
    particle(mass = elbow, position = [l * cos(a), l * sin(a), 0]),
    particle(mass = load, position = [l * (cos(a) + cos(a + b)), l * (sin(a) + sin(a + b)), 0]),
)]
struct Arm<T> {
    elbow: T,
    load: T,
    l: T,
}

# fn main() -> Result<(), Box<dyn std::error::Error>> {
let [elbow, load, l] = exact(&[1.0, 2.0, 0.5]);
let arm = Arm { elbow, load, l }.kernel()?;
let (q, z) = (SVector::from([0.3, 1.2]), SVector::from([2.0, -1.0]));
let a = arm.acceleration(Bounded::exact(0.0), &exact(&q), &exact(&z), &());
assert!(a.iter().all(|a| a.digits() > 14.0));

// A load that was weighed to a gram leaves three digits.
let arm = Arm { elbow, load: Bounded::measured(2.0, 1e-3), l }.kernel()?;
let a = arm.acceleration(Bounded::exact(0.0), &exact(&q), &exact(&z), &());
assert!(a.iter().all(|a| (2.0..4.0).contains(&a.digits())));
# Ok(())
# }
```
"##
)]
//!
//! # What is bounded
//!
//! Running error analysis (J. H. Wilkinson; N. J. Higham, *Accuracy and Stability of Numerical Algorithms*, 2nd ed.,
//! section 3.3): each operation carries the bounds of its operands on, as they are, and adds its own rounding.
//! Correlations are forgotten, so a bound is the worst case over all signs of errors.
//!
//! - Sums add the rounding that they made, which is a floating-point number (Knuth's TwoSum), products with powers of
//!   two none: what is exact in floating point stays exact here. Other operations add half a unit in the last place.
//! - Elementary functions are taken to be within one unit in the last place (sine and cosine together), four
//!   (hyperbolic functions) or two (all others). The largest errors known of the libraries in use are 2.3 and below 1
//!   (B. Gladman, V. Innocente, J. Mather & P. Zimmermann, *Accuracy of Mathematical Functions in Single, Double,
//!   Double Extended, and Quadruple Precision*).
//! - Bounds are rounded upwards, gradual underflow included. A bound is infinite where nothing is known: after
//!   overflow, after a division by a number that may be zero, and where the value itself is not finite. It is never
//!   NaN.
//! - Where a comparison is open, because the two numbers lie within their bounds, the bound covers either outcome.
//! - What the runtime leaves out of its power series, and the rounding of the coefficients of methods, counts
//!   ([`Real::omitting`](crate::real::Real::omitting)).
//!
//! Exact results are those of the same steps. What a method leaves out (the error of an integrator, what is left when
//! an iteration stops, the order in which rows are eliminated) is not rounding, and not in the bound. Roots, logarithms
//! and inverse functions suppose that the exact argument lies in their domain.
//!
//! # Inputs
//!
//! | constructor | the number is |
//! |---|---|
//! | [`Bounded::exact`] | what is stored, to the last bit |
//! | [`Bounded::rounded`] | rounded when it was stored, as 0.1 is |
//! | [`Bounded::measured`] | known up to a given distance |
//!
//! The functions [`exact`], [`rounded`] and [`measured`] do the same to all numbers of a vector, a rotation, a pose, a
//! body or a pair of them. Of a unit quaternion they take the four components as they are; formulas that agree for unit
//! quaternions only agree up to its norm, so compare them with [`rounded`].

mod arithmetic;
mod float;
mod functions;
mod lift;

pub use float::Float;
pub use lift::{Lift, exact, measured, rounded};

use core::fmt;

use crate::real::Real;

/// A computed number and a bound on its distance from the exact one; see the [module](self).
///
/// Numbers are equal when their values are: bounds never decide what is computed.
#[derive(Clone, Copy, Debug)]
pub struct Bounded<T> {
    /// The computed number, the same as without bounds.
    pub value: T,
    /// |value − exact| is at most this. Not negative and not NaN; infinite where nothing is known.
    pub bound: T,
}

impl<T: Float> Bounded<T> {
    /// A number that is what is stored.
    #[must_use]
    #[inline]
    pub fn exact(value: T) -> Self {
        Self::measured(value, T::zero())
    }

    /// A number that was rounded to the nearest when it was stored.
    #[must_use]
    #[inline]
    pub fn rounded(value: T) -> Self {
        Self::finish(value, T::zero(), T::half_unit(value))
    }

    /// A number that is known up to `bound`, of which the sign does not matter.
    #[must_use]
    #[inline]
    pub fn measured(value: T, bound: T) -> Self {
        let known = value.is_finite() && bound.abs() >= T::zero();
        Self { value, bound: if known { bound.abs() } else { T::INFINITY } }
    }

    /// How many decimal digits of the value are right: −log₁₀ of the bound relative to the value, between 0 and what
    /// the scalar holds (15.95 for `f64`, 7.22 for `f32`).
    ///
    /// A number that is zero up to its bound has none: see [`digits_beside`](Self::digits_beside).
    #[must_use]
    pub fn digits(self) -> f64 {
        self.digits_beside(self.value)
    }

    /// The digits that are right in numbers of the size of `scale`: of one component of an acceleration, beside the
    /// largest of them.
    #[must_use]
    pub fn digits_beside(self, scale: T) -> f64 {
        let most = -log10(T::UNIT.lane(0));
        if self.bound == T::zero() {
            return most;
        }
        let relative = self.bound.lane(0) / Real::abs(scale.lane(0));
        // Neither infinite nor NaN bounds are below 1.
        if relative < 1.0 { Real::min(-log10(relative), most) } else { 0.0 }
    }

    /// The least magnitude that the exact number can have, rounded down.
    #[inline(always)]
    fn least(self) -> T {
        if self.bound == T::zero() {
            return self.value.abs();
        }
        let least = (self.value.abs() - self.bound) * T::LESS;
        if least > T::zero() { least } else { T::zero() }
    }

    /// The greatest magnitude that the exact number can have, rounded up.
    #[inline(always)]
    fn greatest(self) -> T {
        (self.value.abs() + self.bound) * T::MORE
    }

    /// A result: what its operands' bounds came to and what the operation itself rounded, each made of at most ten
    /// operations on numbers that are not negative, which [`Float::MORE`] rounds up.
    #[inline(always)]
    fn finish(value: T, inherited: T, rounding: T) -> Self {
        let bound = (inherited + rounding) * T::MORE;
        let known = bound >= T::zero() && value.is_finite();
        Self { value, bound: if known { bound } else { T::INFINITY } }
    }

    /// The same, where the distance cannot be more than `most` for another reason.
    #[inline(always)]
    fn at_most(self, most: T) -> Self {
        let most = most * T::MORE;
        Self { bound: if most < self.bound && self.value.is_finite() { most } else { self.bound }, ..self }
    }
}

fn log10(x: f64) -> f64 {
    Real::ln(x) / core::f64::consts::LN_10
}

impl<T: PartialEq> PartialEq for Bounded<T> {
    #[inline]
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

/// `value ± bound`, the bound with two digits, rounded up. The precision is that of the value.
impl<T: Float> fmt::Display for Bounded<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.value, f)?;
        // Two digits are off by less than a twentieth.
        write!(f, " ± {:.1e}", self.bound.lane(0) * 1.05)
    }
}
