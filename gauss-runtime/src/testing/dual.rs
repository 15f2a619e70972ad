//! Dual numbers: derivatives carried through whatever is written over [`Real`].

use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use crate::real::Real;

/// `value + ε rate` with ε² = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TestDual {
    pub(crate) value: f64,
    pub(crate) rate: f64,
}

pub(crate) const fn dual(value: f64, rate: f64) -> TestDual {
    TestDual { value, rate }
}

macro_rules! arithmetic {
    ($($trait:ident $method:ident $assign_trait:ident $assign:ident: |$a:ident, $b:ident| $value:expr, $rate:expr;)+) => {$(
        impl $trait for TestDual {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                let ($a, $b) = (self, other);
                dual($value, $rate)
            }
        }
        impl $assign_trait for TestDual {
            fn $assign(&mut self, other: Self) {
                *self = self.$method(other);
            }
        }
    )+};
}

arithmetic! {
    Add add AddAssign add_assign: |a, b| a.value + b.value, a.rate + b.rate;
    Sub sub SubAssign sub_assign: |a, b| a.value - b.value, a.rate - b.rate;
    Mul mul MulAssign mul_assign: |a, b| a.value * b.value, a.rate * b.value + a.value * b.rate;
    Div div DivAssign div_assign: |a, b| a.value / b.value, (a.rate - a.value / b.value * b.rate) / b.value;
}

impl Neg for TestDual {
    type Output = Self;
    fn neg(self) -> Self {
        dual(-self.value, -self.rate)
    }
}

macro_rules! functions {
    ($($name:ident: |$x:ident| $derivative:expr;)+) => {$(
        fn $name(self) -> Self {
            let $x = self.value;
            dual(Real::$name($x), $derivative * self.rate)
        }
    )+};
}

impl Real for TestDual {
    const LANES: usize = 1;
    fn lane(self, _: usize) -> f64 {
        self.value
    }
    fn zero() -> Self {
        dual(0.0, 0.0)
    }
    fn one() -> Self {
        dual(1.0, 0.0)
    }
    fn from_f64(value: f64) -> Self {
        dual(value, 0.0)
    }
    fn ratio(p: i64, q: i64) -> Self {
        dual(f64::ratio(p, q), 0.0)
    }
    functions! {
        sqrt: |x| 0.5 / Real::sqrt(x);
        asin: |x| 1.0 / Real::sqrt(1.0 - x * x);
        acos: |x| -1.0 / Real::sqrt(1.0 - x * x);
        atan: |x| 1.0 / (1.0 + x * x);
        sinh: |x| Real::cosh(x);
        cosh: |x| Real::sinh(x);
        tanh: |x| 1.0 - Real::tanh(x) * Real::tanh(x);
        exp: |x| Real::exp(x);
        ln: |x| 1.0 / x;
        abs: |x| x.signum();
    }
    fn sin_cos(self) -> (Self, Self) {
        let (sine, cosine) = Real::sin_cos(self.value);
        (dual(sine, cosine * self.rate), dual(cosine, -sine * self.rate))
    }
    fn atan2(self, x: Self) -> Self {
        let square = self.value * self.value + x.value * x.value;
        dual(Real::atan2(self.value, x.value), (x.value * self.rate - self.value * x.rate) / square)
    }
    fn is_finite(self) -> bool {
        self.value.is_finite() && self.rate.is_finite()
    }
    fn select_lt(a: Self, b: Self, x: Self, y: Self) -> Self {
        if a.value < b.value { x } else { y }
    }
}
