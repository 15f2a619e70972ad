//! Dual numbers: derivatives along several directions, carried through whatever is written over [`Real`].

use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use crate::real::Real;

/// A number with its derivatives along N directions: `value + Σ slopes_k ε_k`, where products of two ε are 0.
///
/// Functions are differentiated exactly, to first order. Comparisons are those of values; where two are equal, `min`,
/// `max` and `abs` have the mean of the derivatives on both sides. A root at 0 has an infinite derivative, but along
/// directions in which its argument does not change.
///
/// ```
/// use gauss_runtime::dual::Dual;
/// use gauss_runtime::real::Real;
///
/// let (x, y) = (Dual::<2>::variable(2.0, 0), Dual::<2>::variable(3.0, 1));
/// let product = x * y.sqrt();
/// assert_eq!(product.slopes[0], 3.0_f64.sqrt());
/// assert!((product.slopes[1] - 1.0 / 3.0_f64.sqrt()).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<const N: usize> {
    /// The number.
    pub value: f64,
    /// Its derivative along each direction.
    pub slopes: [f64; N],
}

impl<const N: usize> Dual<N> {
    /// A number that does not change.
    #[inline(always)]
    #[must_use]
    pub const fn constant(value: f64) -> Self {
        Self { value, slopes: [0.0; N] }
    }

    /// The variable along direction number `direction`.
    ///
    /// # Panics
    /// Where there is no such direction.
    #[must_use]
    pub const fn variable(value: f64, direction: usize) -> Self {
        assert!(direction < N, "a dual number has as many directions as its type says");
        let mut slopes = [0.0; N];
        slopes[direction] = 1.0;
        Self { value, slopes }
    }

    /// A function of this number by its value and derivative.
    #[inline]
    fn chain(self, value: f64, derivative: f64) -> Self {
        let mut slopes = self.slopes;
        let mut k = 0;
        while k < N {
            slopes[k] *= derivative;
            k += 1;
        }
        Self { value, slopes }
    }

    /// The same where the derivative may be infinite.
    fn chain_at_edge(self, value: f64, derivative: f64) -> Self {
        Self { value, slopes: self.slopes.map(|slope| if slope == 0.0 { 0.0 } else { slope * derivative }) }
    }

    /// A function of two numbers by its value and derivatives. A call, where compilers leave it one: kernels are
    /// thousands of operations.
    #[inline]
    fn chain_of_two(self, other: &Self, value: f64, [a, b]: [f64; 2]) -> Self {
        let mut slopes = self.slopes;
        let mut k = 0;
        while k < N {
            slopes[k] = a * slopes[k] + b * other.slopes[k];
            k += 1;
        }
        Self { value, slopes }
    }
}

macro_rules! arithmetic {
    ($(
        $operator:ident $function:ident $assign:ident $in_place:ident:
            |$a:ident, $b:ident| $value:expr, $slopes:expr;
    )+) => {$(
        impl<const N: usize> $operator for Dual<N> {
            type Output = Self;

            #[inline]
            fn $function(self, other: Self) -> Self {
                let ($a, $b) = (self.value, other.value);
                self.chain_of_two(&other, $value, $slopes)
            }
        }

        impl<const N: usize> $assign for Dual<N> {
            #[inline]
            fn $in_place(&mut self, other: Self) {
                *self = $operator::$function(*self, other);
            }
        }
    )+};
}

arithmetic! {
    Add add AddAssign add_assign: |a, b| a + b, [1.0, 1.0];
    Sub sub SubAssign sub_assign: |a, b| a - b, [1.0, -1.0];
    Mul mul MulAssign mul_assign: |a, b| a * b, [b, a];
    Div div DivAssign div_assign: |a, b| a / b, [1.0 / b, -(a / b) / b];
}

impl<const N: usize> Neg for Dual<N> {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        self.chain(-self.value, -1.0)
    }
}

macro_rules! functions {
    ($($name:ident: |$x:ident, $y:ident| $derivative:expr;)+) => {$(
        #[inline]
        fn $name(self) -> Self {
            let $x = self.value;
            let $y = Real::$name($x);
            self.chain($y, $derivative)
        }
    )+};
}

impl<const N: usize> Real for Dual<N> {
    const LANES: usize = 1;

    #[inline(always)]
    fn lane(self, _: usize) -> f64 {
        self.value
    }

    #[inline(always)]
    fn from_f64(value: f64) -> Self {
        Self::constant(value)
    }

    #[inline(always)]
    fn ratio(p: i64, q: i64) -> Self {
        Self::constant(f64::ratio(p, q))
    }

    functions! {
        asin: |_x, y| 1.0 / Real::cos(y);
        acos: |_x, y| -1.0 / Real::sin(y);
        atan: |x, _y| 1.0 / (1.0 + x * x);
        sinh: |x, _y| Real::cosh(x);
        cosh: |x, _y| Real::sinh(x);
        tanh: |_x, y| 1.0 - y * y;
        exp: |_x, y| y;
        ln: |x, _y| 1.0 / x;
        recip: |_x, y| -y * y;
    }

    #[inline]
    fn sqrt(self) -> Self {
        let root = Real::sqrt(self.value);
        self.chain_at_edge(root, 0.5 / root)
    }

    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        let (sine, cosine) = Real::sin_cos(self.value);
        (self.chain(sine, cosine), self.chain(cosine, -sine))
    }

    #[inline]
    fn atan2(self, x: Self) -> Self {
        let square = self.value * self.value + x.value * x.value;
        self.chain_of_two(&x, Real::atan2(self.value, x.value), [x.value / square, -self.value / square])
    }

    #[inline]
    fn is_finite(self) -> bool {
        self.value.is_finite() && self.slopes.iter().all(|slope| slope.is_finite())
    }

    #[inline(always)]
    fn select_lt(a: Self, b: Self, x: Self, y: Self) -> Self {
        if a.value < b.value { x } else { y }
    }
}

crate::__packs_of_one_0_1_0! {
    [const N: usize] Dual<N>;
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Derivatives of all functions against differences: those of fourth order leave 1e-12 of functions of size one.
    #[test]
    fn slopes_are_those_of_differences() {
        type Of<T> = fn(T, T) -> T;
        macro_rules! each {
            ($($function:expr;)+) => {
                [$(($function as Of<f64>, $function as Of<Dual<2>>)),+]
            };
        }
        let functions = each![
            |x, y| x + y;
            |x, y| x - y * x;
            |x, y| x / y;
            |x, y| Real::sqrt(x * y);
            |x, y| Real::sin(x) * Real::cos(y);
            |x, y| Real::tan(x) + Real::atan2(x, y);
            |x, y| Real::asin(x) * Real::acos(y * x);
            |x, y| Real::atan(x) + Real::sinh(y);
            |x, y| Real::cosh(x) * Real::tanh(y);
            |x, y| Real::exp(x) * Real::ln(y);
            |x, y| Real::recip(x) - Real::powi(y, 3);
            |x, y| Real::powf(x, y);
            |x, y| Real::max(x, y) * Real::abs(-x);
        ];
        let (x, y, h) = (0.4, 0.7, 1e-3);
        for (n, (plain, dual)) in functions.into_iter().enumerate() {
            let found = dual(Dual::variable(x, 0), Dual::variable(y, 1));
            assert_eq!(found.value, plain(x, y), "{n}");
            for (slope, [dx, dy]) in found.slopes.into_iter().zip([[h, 0.0], [0.0, h]]) {
                let at = |k: f64| plain(x + k * dx, y + k * dy);
                let expected = (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * h);
                // Fifth derivatives of these functions are below 10⁴ here: h⁴/30 of that, and roundings over h.
                assert!((slope - expected).abs() < 1e-9, "{n}: {slope} {expected}");
            }
        }
    }

    #[test]
    fn roots_at_zero_have_no_slope_along_what_does_not_change() {
        let root = Real::sqrt(Dual::<2>::variable(0.0, 1));
        assert_eq!((root.value, root.slopes[0]), (0.0, 0.0));
        assert!(!Real::is_finite(root));
    }
}
