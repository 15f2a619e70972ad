//! Elementary functions, choices and constants. a is the value, A the exact number, α the bound: |a − A| ≤ α.
//!
//! Each rule bounds |f(a) − f(A)| by the largest slope between a and A, or where slopes are infinite by how far f can
//! go over a distance of α anywhere. f(a) − f(A) is also never more than the width of the range of f.

use gauss_runtime::real::Real;

use crate::{Bounded, Float};

/// Rounding error of one evaluation of a function, in units of 2u, which is one unit in the last place or more.
const SINE: f64 = 1.0;
const HYPERBOLIC: f64 = 4.0;
const OTHER: f64 = 2.0;
/// The quotient of a sine and a cosine: one for each, half of one for the quotient, and their products.
const TANGENT: f64 = 3.0;

impl<T: Float> Bounded<T> {
    /// A value of a library function. `inherited` is made of at most ten operations.
    #[inline(always)]
    fn function(value: T, inherited: T, units: f64) -> Self {
        let rounding = T::from_f64(2.0 * units) * T::UNIT * value.abs() + T::TINY;
        Self::finish(value, inherited, rounding)
    }

    /// Whether the number is known to be exactly this.
    #[inline(always)]
    fn is_exactly(self, value: T) -> bool {
        self.value == value && self.bound == T::zero()
    }

    /// α times a slope; nothing where α is zero, even if the slope is infinite.
    #[inline(always)]
    fn along(self, slope: T) -> T {
        if self.bound == T::zero() { T::zero() } else { self.bound * slope + T::TINY }
    }

    /// The sine and the cosine of a, from `sine` and `cosine` of it.
    #[inline(always)]
    fn sine(self, value: T, slope: T) -> Self {
        if self.is_exactly(T::zero()) {
            return Self::exact(value);
        }
        // |sin a − sin A| = 2 |sin ½(a − A)| |cos ½(a + A)|, and the cosine there is within ½α of that at a.
        let half = T::from_f64(0.5) * self.bound;
        let near = slope.abs() * (T::one() + T::from_f64(4.0) * T::UNIT) + T::TINY + half;
        let slope = if near < T::one() { near } else { T::one() };
        Self::function(value, self.along(slope), SINE).at_most(T::one() + value.abs())
    }

    /// Inverse sine and cosine: slope 1/√(1 − x²), and over a distance α at most acos(1 − α) = 2 asin √(α/2) ≤ π
    /// √(α/2), at the ends.
    #[inline(always)]
    fn inverse(self, value: T, range: f64) -> Self {
        let greatest = self.greatest();
        let square = (T::one() - greatest) * (T::one() + greatest) * T::LESS;
        let anywhere = T::from_f64(2.25) * self.bound.sqrt();
        let inherited = if square > T::zero() {
            let by_slope = self.along(square.sqrt().recip());
            if by_slope < anywhere { by_slope } else { anywhere }
        } else {
            anywhere
        };
        Self::function(value, inherited, OTHER).at_most(T::from_f64(range))
    }

    /// Whether `self < other` is the same for all numbers within the bounds.
    #[inline(always)]
    fn is_decided(self, other: Self) -> bool {
        let reach = self.bound + other.bound;
        reach == T::zero() || (self.value - other.value).abs() * T::LESS > reach * T::MORE
    }

    /// The smaller or the larger of two: off by no more than the one that is further off.
    #[inline(always)]
    fn extreme(self, other: Self, value: T) -> Self {
        let larger = if self.bound < other.bound { other.bound } else { self.bound };
        let bound = if !self.is_decided(other) || self.value == other.value {
            larger
        } else if value == self.value {
            self.bound
        } else {
            other.bound
        };
        Self::measured(value, bound)
    }
}

/// √(x² + y²) to a few roundings, for x, y ≥ 0, without overflow and underflow on the way.
#[inline(always)]
fn hypotenuse<T: Float>(x: T, y: T) -> T {
    let (less, more) = if x < y { (x, y) } else { (y, x) };
    if less == T::zero() || !more.is_finite() {
        return more;
    }
    let ratio = less / more;
    more * (T::one() + ratio * ratio).sqrt()
}

impl<T: Float> Real for Bounded<T> {
    const LANES: usize = 1;
    const EPSILON: f64 = T::EPSILON;
    const DERIVATIVES: bool = false;

    #[inline(always)]
    fn lane(self, i: usize) -> f64 {
        self.value.lane(i)
    }

    #[inline(always)]
    fn zero() -> Self {
        Self::exact(T::zero())
    }

    #[inline(always)]
    fn one() -> Self {
        Self::exact(T::one())
    }

    /// Exactly `value`, where the scalar can hold it.
    #[inline]
    fn from_f64(value: f64) -> Self {
        let held = T::from_f64(value);
        let lost = Real::abs(value - held.lane(0));
        Self::finish(held, T::from_f64(lost), if lost == 0.0 { T::zero() } else { T::TINY })
    }

    #[inline]
    fn ratio(p: i64, q: i64) -> Self {
        let value = T::ratio(p, q);
        let whole = |p: i64| p.unsigned_abs() <= T::INTEGERS;
        let exact = (q.unsigned_abs().is_power_of_two() && whole(p))
            || (p.checked_rem(q) == Some(0) && p.checked_div(q).is_some_and(whole));
        if exact { Self::exact(value) } else { Self::rounded(value) }
    }

    /// Fused where the scalar's is; the bound covers what was computed.
    #[inline(never)]
    fn fma(self, b: Self, c: Self) -> Self {
        let sum = self * b + c;
        let value = self.value.fma(b.value, c.value);
        if value == sum.value {
            return Self { value, ..sum };
        }
        Self::finish(value, sum.bound, (value - sum.value).abs())
    }

    #[inline]
    fn omitting(self, at_most: Self) -> Self {
        Self::finish(self.value, self.bound, at_most.greatest())
    }

    #[inline(never)]
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        if self.is_exactly(T::zero()) || self.is_exactly(T::one()) {
            return Self::exact(root);
        }
        // |√a − √A| = |a − A|/(√a + √A), and at most √|a − A|.
        let anywhere = self.bound.sqrt();
        let by_slope = self.along((root + self.least().sqrt()).recip());
        let inherited = if by_slope < anywhere { by_slope } else { anywhere };
        Self::finish(root, inherited, T::half_unit(root))
    }

    #[inline(never)]
    fn sin_cos(self) -> (Self, Self) {
        let (sine, cosine) = self.value.sin_cos();
        (self.sine(sine, cosine), self.sine(cosine, sine))
    }

    fn sin(self) -> Self {
        self.sine(self.value.sin(), self.value.cos())
    }

    fn cos(self) -> Self {
        self.sine(self.value.cos(), self.value.sin())
    }

    fn tan(self) -> Self {
        let value = self.value.tan();
        if self.is_exactly(T::zero()) {
            return Self::exact(value);
        }
        // tan a − tan A = sin(a − A)/(cos a cos A).
        let near = Self::exact(self.value).cos().least();
        let least = self.cos().least();
        let slope = if self.bound == T::zero() { T::zero() } else { (near * least).recip() };
        Self::function(value, self.along(slope), TANGENT)
    }

    fn asin(self) -> Self {
        let value = self.value.asin();
        if self.is_exactly(T::zero()) {
            return Self::exact(value);
        }
        self.inverse(value, 3.15)
    }

    fn acos(self) -> Self {
        let value = self.value.acos();
        if self.is_exactly(T::one()) {
            return Self::exact(value);
        }
        self.inverse(value, 3.15)
    }

    fn atan(self) -> Self {
        let value = self.value.atan();
        if self.is_exactly(T::zero()) {
            return Self::exact(value);
        }
        let least = self.least();
        let slope = (T::one() + least * least).recip();
        Self::function(value, self.along(slope), OTHER).at_most(T::from_f64(3.15))
    }

    /// Across the cut from −π to π, where it is within the bounds, the angle is off by 2π.
    fn atan2(self, x: Self) -> Self {
        let value = self.value.atan2(x.value);
        let least_x = x.value - x.bound;
        if self.is_exactly(T::zero()) && least_x > T::zero() {
            return Self::exact(value);
        }
        let crosses = self.bound > T::zero() && self.value.abs() <= self.bound && least_x <= T::zero();
        // Products round to the least number, whichever way.
        let disc = hypotenuse(self.bound, x.bound) * T::MORE + T::TINY;
        let radius = hypotenuse(self.value.abs(), x.value.abs()) * T::LESS - T::TINY;
        let most = T::from_f64(3.15) + value.abs();
        let inherited = if self.bound == T::zero() && x.bound == T::zero() {
            T::zero()
        } else if crosses || disc >= radius {
            most
        } else {
            // The disc is seen from the origin under the angle asin t ≤ ½π t, and ≤ t/√(1 − t²).
            let t = disc / radius * T::MORE;
            let (half_turn, tangent) = (T::from_f64(1.571) * t, t / ((T::one() - t) * (T::one() + t)).sqrt());
            if tangent < half_turn { tangent } else { half_turn }
        };
        Self::function(value, inherited, OTHER).at_most(most)
    }

    fn sinh(self) -> Self {
        let value = self.value.sinh();
        if self.is_exactly(T::zero()) {
            return Self::exact(value);
        }
        Self::function(value, self.along(self.greatest().cosh() * T::MORE), HYPERBOLIC)
    }

    fn cosh(self) -> Self {
        let value = self.value.cosh();
        if self.is_exactly(T::zero()) {
            return Self::exact(value);
        }
        Self::function(value, self.along(self.greatest().sinh() * T::MORE), HYPERBOLIC)
    }

    fn tanh(self) -> Self {
        let value = self.value.tanh();
        if self.is_exactly(T::zero()) {
            return Self::exact(value);
        }
        let least = self.least().cosh() * T::LESS;
        Self::function(value, self.along((least * least).recip()), HYPERBOLIC).at_most(T::one() + value.abs())
    }

    fn exp(self) -> Self {
        let value = self.value.exp();
        if self.is_exactly(T::zero()) {
            return Self::exact(value);
        }
        // e^a (e^α − 1) ≤ e^a α e^α; e^a is not more than what was rounded to it and the least number.
        let slope = (value * T::MORE + T::TINY) * self.bound.exp();
        Self::function(value, self.along(slope), OTHER)
    }

    fn ln(self) -> Self {
        let value = self.value.ln();
        if self.is_exactly(T::one()) {
            return Self::exact(value);
        }
        Self::function(value, self.along(self.least().recip()), OTHER)
    }

    #[inline]
    fn abs(self) -> Self {
        Self { value: self.value.abs(), bound: self.bound }
    }

    #[inline]
    fn min(self, other: Self) -> Self {
        self.extreme(other, self.value.min(other.value))
    }

    #[inline]
    fn max(self, other: Self) -> Self {
        self.extreme(other, self.value.max(other.value))
    }

    /// Whether the value is: a run takes the same course with bounds as without.
    #[inline(always)]
    fn is_finite(self) -> bool {
        self.value.is_finite()
    }

    /// Chooses one of two values; the other leaves a trace where the choice is open: the bound then covers it.
    #[inline]
    fn select_lt(a: Self, b: Self, x: Self, y: Self) -> Self {
        let (chosen, other) = if a.value < b.value { (x, y) } else { (y, x) };
        if a.is_decided(b) {
            return chosen;
        }
        let covering = (chosen.value - other.value).abs() + other.bound;
        let wide = Self::finish(chosen.value, covering, T::zero());
        if wide.bound > chosen.bound { wide } else { chosen }
    }

    #[inline(always)]
    fn all_surely_lt(a: Self, b: Self) -> bool {
        a.value < b.value && a.is_decided(b)
    }
}
