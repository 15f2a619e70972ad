//! A value and its bound: construction, and the number of right digits.

use core::fmt;

use gauss_runtime::real::Real;

use crate::Float;

/// A computed number and a bound on its distance from the exact one; see the [crate](crate).
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

    /// Number of decimal digits of the value that are right: −log₁₀ of the bound relative to the value, between 0 and
    /// what the scalar holds (15.95 for `f64`, 7.22 for `f32`).
    ///
    /// A number that is zero up to its bound has none: see [`digits_beside`](Self::digits_beside).
    #[must_use]
    pub fn digits(self) -> f64 {
        self.digits_beside(self.value)
    }

    /// The digits that are right relative to `scale`: for one component of an acceleration, say, relative to the
    /// largest component.
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
    pub(crate) fn least(self) -> T {
        if self.bound == T::zero() {
            return self.value.abs();
        }
        let least = (self.value.abs() - self.bound) * T::LESS;
        if least > T::zero() { least } else { T::zero() }
    }

    /// The greatest magnitude that the exact number can have, rounded up.
    #[inline(always)]
    pub(crate) fn greatest(self) -> T {
        (self.value.abs() + self.bound) * T::MORE
    }

    /// A result: what its operands' bounds came to and what the operation itself rounded, each made of at most ten
    /// operations on numbers that are not negative, which [`Float::MORE`] rounds up.
    #[inline(always)]
    pub(crate) fn finish(value: T, inherited: T, rounding: T) -> Self {
        let bound = (inherited + rounding) * T::MORE;
        let known = bound >= T::zero() && value.is_finite();
        Self { value, bound: if known { bound } else { T::INFINITY } }
    }

    /// The same, where the distance cannot be more than `most` for another reason.
    #[inline(always)]
    pub(crate) fn at_most(self, most: T) -> Self {
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
