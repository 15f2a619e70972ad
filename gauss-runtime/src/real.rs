//! The scalar of every kernel: [`Real`], and why it is not `nalgebra::RealField`.
//!
//! Generated code is straight-line arithmetic, so one function body serves plain floats, SIMD lanes, dual numbers
//! (derivatives of a whole simulation) and double-double numbers (reference solutions). [`Real`] asks for exactly what
//! such code needs. It is deliberately poorer than `RealField`: there is no total order and no conversion from a lane
//! back into control flow, apart from [`Real::lane`], which step control and parameter checks use, and
//! [`Real::select_lt`], which is how lanes take different branches.

use core::fmt::Debug;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use crate::trigonometry::{sin_cos, sines_and_cosines};

/// A real number, or a pack of them that is worked on lane by lane.
///
/// Implemented for [`f32`] and [`f64`]; implement it for SIMD packs, dual numbers or extended precision to run the same
/// generated kernels on them. The supertraits are those that nalgebra's containers (`SVector`, `Isometry3`,
/// `UnitQuaternion`, …) need to hold a scalar: `Copy + PartialEq + Debug + 'static` implies `nalgebra::Scalar`, and
/// nothing more is required because this crate works on components only.
///
/// A scalar of your own writes [`LANES`](Self::LANES) and eleven functions; all others are made of these, and are worth
/// writing where the number type knows better. A scalar with less precision or more than `f64` writes
/// [`EPSILON`](Self::EPSILON), and one that bounds its errors [`omitting`](Self::omitting). To be worked on in
/// lockstep, or many states at once, it implements [`Packed`](crate::simd::Packed) as well.
///
/// Every function acts on each lane by itself and follows IEEE 754: results outside the domain are NaN, never a panic.
/// Angles are in radians.
pub trait Real:
    Copy
    + PartialEq
    + Debug
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
    + DivAssign
{
    /// Number of independent numbers in a value: 1 for a plain scalar.
    const LANES: usize;

    /// Distance from 1 to the next larger number of a lane. Sets the length of power series and the slack of checks.
    const EPSILON: f64 = f64::EPSILON;

    /// Whether a number may carry derivatives, as dual numbers do: times of events are refined by them then (see
    /// [`event`](crate::integrate::drive::event)), and constraints are solved for them where values need no more.
    /// A scalar of your own is taken to, unless it writes `false` here, which saves that work.
    const DERIVATIVES: bool = true;

    /// The value part of lane `i < LANES`, rounded to `f64`: for checks, step control and reports, not for arithmetic.
    fn lane(self, i: usize) -> f64;

    /// Zero in every lane.
    #[inline(always)]
    fn zero() -> Self {
        Self::from_f64(0.0)
    }

    /// One in every lane.
    #[inline(always)]
    fn one() -> Self {
        Self::from_f64(1.0)
    }

    /// `value` in every lane, rounded to the precision of a lane.
    fn from_f64(value: f64) -> Self;

    /// The rational number `p/q` in every lane. `q = 0` gives the result of a division by zero.
    ///
    /// Correctly rounded where lanes can hold p and q, if division is; plain floats round other ratios once as well,
    /// the function provided here p and q first.
    #[inline]
    fn ratio(p: i64, q: i64) -> Self {
        // Halves of 32 digits are exact in `f64`, and their sum in whatever has 64 digits.
        let number = |n: i64| Self::from_f64(((n >> 32) << 32) as f64) + Self::from_f64((n & 0xffff_ffff) as f64);
        number(p) / number(q)
    }

    /// `self·b + c`. Fused where that is one machine instruction, else two roundings: a fused multiply-add by software
    /// costs more than everything around it.
    #[inline(always)]
    fn fma(self, b: Self, c: Self) -> Self {
        self * b + c
    }

    /// Square root.
    fn sqrt(self) -> Self;

    /// Sine and cosine together.
    fn sin_cos(self) -> (Self, Self);

    /// Sines and cosines of several angles, with the bits that each gets alone: kernels ask for those of all angles of
    /// a state at once, which plain floats compute side by side in vectors.
    #[inline(always)]
    fn sines_and_cosines<const N: usize>(angles: [Self; N]) -> ([Self; N], [Self; N]) {
        // Not `map` of arrays, which compilers leave a call.
        let (mut sines, mut cosines) = (angles, angles);
        for i in 0..N {
            (sines[i], cosines[i]) = angles[i].sin_cos();
        }
        (sines, cosines)
    }

    /// Sine.
    #[inline(always)]
    fn sin(self) -> Self {
        self.sin_cos().0
    }

    /// Cosine.
    #[inline(always)]
    fn cos(self) -> Self {
        self.sin_cos().1
    }

    /// Tangent.
    #[inline(always)]
    fn tan(self) -> Self {
        let (sine, cosine) = self.sin_cos();
        sine / cosine
    }

    /// Inverse sine, in [−π/2, π/2].
    #[inline]
    fn asin(self) -> Self {
        self.atan2(((Self::one() - self) * (Self::one() + self)).sqrt())
    }

    /// Inverse cosine, in [0, π].
    #[inline]
    fn acos(self) -> Self {
        ((Self::one() - self) * (Self::one() + self)).sqrt().atan2(self)
    }

    /// Inverse tangent, in [−π/2, π/2].
    #[inline]
    fn atan(self) -> Self {
        self.atan2(Self::one())
    }

    /// The angle of the point (`x`, `self`), in [−π, π]: `self` is the ordinate.
    fn atan2(self, x: Self) -> Self;

    /// Hyperbolic sine.
    fn sinh(self) -> Self;

    /// Hyperbolic cosine.
    #[inline]
    fn cosh(self) -> Self {
        // By the exponential of half the argument, whose square alone may overflow.
        let half = Self::ratio(1, 2);
        let (growing, shrinking) = ((half * self).exp(), (-half * self).exp());
        (half * growing) * growing + (half * shrinking) * shrinking
    }

    /// Hyperbolic tangent.
    fn tanh(self) -> Self;

    /// Exponential.
    fn exp(self) -> Self;

    /// Natural logarithm.
    fn ln(self) -> Self;

    /// Integer power, by repeated squaring.
    #[inline]
    fn powi(self, exponent: i32) -> Self {
        let mut square = self;
        let mut result = Self::one();
        let mut remaining = exponent.unsigned_abs();
        while remaining > 0 {
            if remaining & 1 == 1 {
                result *= square;
            }
            remaining >>= 1;
            if remaining > 0 {
                square *= square;
            }
        }
        if exponent < 0 { result.recip() } else { result }
    }

    /// Power with a real exponent, of a base that is not negative.
    #[inline]
    fn powf(self, exponent: Self) -> Self {
        (exponent * self.ln()).exp()
    }

    /// Absolute value. The function provided here leaves −0 as it is.
    #[inline(always)]
    fn abs(self) -> Self {
        Self::select_lt(self, Self::zero(), -self, self)
    }

    /// −1, 0 or 1, lane by lane; NaN of NaN.
    #[inline(always)]
    fn signum(self) -> Self {
        let (zero, one) = (Self::zero(), Self::one());
        Self::select_lt(zero, self, one, Self::select_lt(self, zero, -one, self))
    }

    /// The smaller, lane by lane; NaN where one of them is.
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        // Neither is smaller: they are equal, or one is NaN and so is their sum.
        let half = Self::ratio(1, 2);
        let same = self * half + other * half;
        Self::select_lt(self, other, self, Self::select_lt(other, self, other, same))
    }

    /// The larger, lane by lane; NaN where one of them is.
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        let half = Self::ratio(1, 2);
        let same = self * half + other * half;
        Self::select_lt(self, other, other, Self::select_lt(other, self, self, same))
    }

    /// `1/self`.
    #[inline(always)]
    fn recip(self) -> Self {
        Self::one() / self
    }

    /// `self`, of which terms were left out that are together at most `at_most` in magnitude: the rest of a power
    /// series, the rounding of a coefficient. Scalars that account for their error (`gauss-bounded`) widen it; others
    /// are what they are.
    // No trait of its own: functions that take any `Real` call it, so that each scalar would have to implement that
    // one, too.
    #[inline(always)]
    fn omitting(self, at_most: Self) -> Self {
        let _ = at_most;
        self
    }

    /// Whether every lane (derivative parts included, where there are any) is finite.
    fn is_finite(self) -> bool;

    /// Lane by lane, `x` where `a < b`, else `y` (so `y` where `a` or `b` is NaN).
    ///
    /// What is not chosen may be NaN or infinite and must leave no trace.
    fn select_lt(a: Self, b: Self, x: Self, y: Self) -> Self;

    /// Whether `a < b` in every lane: one branch for all of them, where a vector has an instruction for it.
    #[inline(always)]
    fn all_lt(a: Self, b: Self) -> bool {
        (0..Self::LANES).all(|i| a.lane(i) < b.lane(i))
    }

    /// The same, for all that a and b may stand for: of numbers with error bounds, within the bounds.
    #[inline(always)]
    fn all_surely_lt(a: Self, b: Self) -> bool {
        Self::all_lt(a, b)
    }
}

/// The largest of the derivatives that a number of one lane carries, rounded up to a power of two: 0 of a plain number,
/// and of derivatives below 2⁻⁹⁰⁰; infinite from 2⁹⁰⁰ on. For decisions and reports, not for arithmetic.
///
/// All that numbers tell of their derivatives is whether they are finite: so they are enlarged until they are not.
#[must_use]
pub fn largest_derivative<T: Real>(x: T) -> f64 {
    const FARTHEST: i32 = 900;
    let rest = x - T::from_f64(x.lane(0));
    let power = |n: i32| Real::powi(2.0_f64, n);
    // Times 2^(1024 − n), in two factors, each of which is a number.
    let within = |n: i32| (rest * T::from_f64(power(512 - n / 2)) * T::from_f64(power(512 - (n - n / 2)))).is_finite();
    if !T::DERIVATIVES || within(-FARTHEST) {
        return 0.0;
    }
    if !within(FARTHEST) {
        return f64::INFINITY;
    }
    let (mut low, mut high) = (-FARTHEST, FARTHEST);
    while high - low > 1 {
        let middle = (low + high).div_euclid(2);
        if within(middle) { high = middle } else { low = middle }
    }
    power(high)
}

#[cfg(feature = "std")]
macro_rules! elementary {
    ($float:ident, $std:ident, $libm:ident; $($argument:expr),+) => { $float::$std($($argument),+) };
}

#[cfg(not(feature = "std"))]
macro_rules! elementary {
    ($float:ident, $std:ident, $libm:ident; $($argument:expr),+) => { libm::$libm($($argument),+) };
}

/// Not every library reduces angles well that are larger.
const LARGE_ANGLE: f64 = 65_536.0;

macro_rules! implement_real {
    ($float:ident, $digits:expr; $($std:ident $libm:ident),+; $atan2:ident $pow:ident $tan:ident $sincos:expr, $together:expr) => {
        impl Real for $float {
            const LANES: usize = 1;
            const EPSILON: f64 = $float::EPSILON as f64;
            const DERIVATIVES: bool = false;

            #[inline(always)]
            fn lane(self, _: usize) -> f64 {
                f64::from(self)
            }

            #[inline(always)]
            fn zero() -> Self {
                0.0
            }

            #[inline(always)]
            fn one() -> Self {
                1.0
            }

            #[inline(always)]
            fn from_f64(value: f64) -> Self {
                value as $float
            }

            #[inline(always)]
            fn ratio(p: i64, q: i64) -> Self {
                // Exact operands make the one rounding of the division the only one.
                const EXACT: u64 = 1 << $digits;
                if p.unsigned_abs() <= EXACT && q.unsigned_abs() <= EXACT {
                    p as $float / q as $float
                } else {
                    rounded_ratio(p, q, $digits) as $float
                }
            }

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

            $(
                #[inline(always)]
                fn $std(self) -> Self {
                    elementary!($float, $std, $libm; self)
                }
            )+

            #[inline(always)]
            fn atan2(self, x: Self) -> Self {
                elementary!($float, atan2, $atan2; self, x)
            }

            #[inline(always)]
            fn powf(self, exponent: Self) -> Self {
                elementary!($float, powf, $pow; self, exponent)
            }

            #[inline(always)]
            fn sin_cos(self) -> (Self, Self) {
                $sincos(self)
            }

            #[inline(always)]
            fn tan(self) -> Self {
                if $float::abs(self) < LARGE_ANGLE as $float {
                    return elementary!($float, tan, $tan; self);
                }
                let (sine, cosine) = Real::sin_cos(self);
                sine / cosine
            }

            #[inline(always)]
            fn sines_and_cosines<const N: usize>(angles: [Self; N]) -> ([Self; N], [Self; N]) {
                $together(angles)
            }

            #[inline(always)]
            fn abs(self) -> Self {
                $float::abs(self)
            }

            #[inline(always)]
            fn is_finite(self) -> bool {
                $float::is_finite(self)
            }

            #[inline(always)]
            fn select_lt(a: Self, b: Self, x: Self, y: Self) -> Self {
                if a < b { x } else { y }
            }
        }
    };
}

implement_real!(f64, 53;
    sqrt sqrt, asin asin, acos acos, atan atan,
    sinh sinh, cosh cosh, tanh tanh, exp exp, ln log; atan2 pow tan
    |x: f64| sin_cos(x, f64::fma), |angles: [f64; N]| sines_and_cosines(angles, f64::fma));
implement_real!(f32, 24;
sqrt sqrtf, asin asinf, acos acosf, atan atanf,
sinh sinhf, cosh coshf, tanh tanhf, exp expf, ln logf; atan2f powf tanf
|x: f32| {
    // Rounded once more than it need be: within 0.5 ulp and a little.
    let (sine, cosine) = sin_cos(f64::from(x), f64::fma);
    (sine as f32, cosine as f32)
},
|angles: [f32; N]| {
    let angles: [f64; N] = core::array::from_fn(|i| f64::from(angles[i]));
    let (sines, cosines) = sines_and_cosines(angles, f64::fma);
    let rounded = |numbers: [f64; N]| -> [f32; N] { core::array::from_fn(|i| numbers[i] as f32) };
    (rounded(sines), rounded(cosines))
});

/// `p/q` rounded once, to `digits ≤ 53` binary digits, ties to even; by integer long division, because operands beyond
/// 2⁵³ would be rounded before the division.
#[cold]
pub(crate) const fn rounded_ratio(p: i64, q: i64, digits: u32) -> f64 {
    if p == 0 || q == 0 {
        return p as f64 / q as f64;
    }
    let numerator = p.unsigned_abs() as u128;
    let denominator = q.unsigned_abs() as u128;
    // A shift after which the quotient has at least digits + 1 binary digits; at most 63 + 55 digits are needed.
    let shift = (digits + 2 + (128 - denominator.leading_zeros())).saturating_sub(128 - numerator.leading_zeros());
    let scaled = numerator << shift;
    let quotient = scaled / denominator;
    let inexact = !scaled.is_multiple_of(denominator);
    let surplus = 128 - quotient.leading_zeros() - digits;
    let kept = quotient >> surplus;
    let half = 1_u128 << (surplus - 1);
    let rest = quotient & ((1 << surplus) - 1);
    let up = rest > half || (rest == half && (inexact || kept & 1 == 1));
    let mantissa = (kept + up as u128) as f64;
    // 2^(surplus − shift), exact: the exponent stays within ±128.
    let exponent = surplus as i64 - shift as i64;
    let power = f64::from_bits(((1023 + exponent) as u64) << 52);
    let magnitude = mantissa * power;
    if (p < 0) == (q < 0) { magnitude } else { -magnitude }
}

/// `p/q` less [`rounded_ratio`] of it with 53 digits, rounded: the next 53 digits.
#[cold]
pub(crate) const fn ratio_rest(p: i64, q: i64) -> f64 {
    let rounded = rounded_ratio(p, q, f64::MANTISSA_DIGITS);
    if rounded == 0.0 || !rounded.is_finite() {
        return 0.0;
    }
    let (bits, hidden) = (rounded.abs().to_bits(), 1_u64 << 52);
    let mantissa = ((bits & (hidden - 1)) | hidden) as i128;
    let mantissa = if rounded < 0.0 { -mantissa } else { mantissa };
    // rounded = mantissa·2^exponent, and |p|/2^exponent is about 2⁵³|q|: no product leaves 128 digits.
    let exponent = (bits >> 52) as i32 - 1075;
    let (p, q) = (p as i128, q as i128);
    if exponent < 0 {
        let power = f64::from_bits(((1023 + exponent) as u64) << 52);
        ((p << -exponent) - mantissa * q) as f64 / q as f64 * power
    } else {
        (p - (mantissa << exponent) * q) as f64 / q as f64
    }
}

#[cfg(test)]
#[path = "real_tests.rs"]
mod tests;
