//! Sums, products and quotients. a and b are the values, α and β the bounds of the operands.
//!
//! Operations are not inlined: kernels are thousands of them in a row, which would take the compiler many times as
//! long.

use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use crate::{Bounded, Float};

impl<T: Float> Add for Bounded<T> {
    type Output = Self;

    #[inline(never)]
    fn add(self, other: Self) -> Self {
        let (a, b) = (self.value, other.value);
        let sum = a + b;
        // TwoSum: what the sum rounded off, exactly.
        let part = sum - a;
        let rounding = (a - (sum - part)) + (b - part);
        Self::finish(sum, self.bound + other.bound, rounding.abs())
    }
}

impl<T: Float> Sub for Bounded<T> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<T: Float> Mul for Bounded<T> {
    type Output = Self;

    #[inline(never)]
    fn mul(self, other: Self) -> Self {
        let (a, b) = (self.value, other.value);
        let product = a * b;
        let inherited = if self.bound == T::zero() && other.bound == T::zero() {
            T::zero()
        } else {
            // Each of the three products may lose half the least number to underflow.
            (a.abs() + self.bound) * other.bound + b.abs() * self.bound + (T::TINY + T::TINY)
        };
        let shifted = (a.is_power_of_two() || b.is_power_of_two()) && product.abs() >= T::LEAST_NORMAL;
        let exact = shifted || a == T::zero() || b == T::zero();
        Self::finish(product, inherited, if exact { T::zero() } else { T::half_unit(product) })
    }
}

impl<T: Float> Div for Bounded<T> {
    type Output = Self;

    #[inline(never)]
    fn div(self, other: Self) -> Self {
        let (a, b) = (self.value, other.value);
        let quotient = a / b;
        let least = other.least();
        if least == T::zero() {
            return Self { value: quotient, bound: T::INFINITY };
        }
        let inherited = if self.bound == T::zero() && other.bound == T::zero() {
            T::zero()
        } else {
            // |a/b − A/B| ≤ (|a/b| |B − b| + |A − a|)/|B|, and |a/b| may be more than the quotient that was rounded.
            ((quotient.abs() + T::TINY) * other.bound + self.bound + T::TINY) / least + T::TINY
        };
        let shifted = b.is_power_of_two() && quotient.abs() >= T::LEAST_NORMAL;
        let exact = shifted || a == T::zero();
        Self::finish(quotient, inherited, if exact { T::zero() } else { T::half_unit(quotient) })
    }
}

impl<T: Float> Neg for Bounded<T> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self { value: -self.value, bound: self.bound }
    }
}

macro_rules! assigning {
    ($($trait:ident $assign:ident $method:ident;)+) => {$(
        impl<T: Float> $trait for Bounded<T> {
            #[inline(always)]
            fn $assign(&mut self, other: Self) {
                *self = self.$method(other);
            }
        }
    )+};
}

assigning! {
    AddAssign add_assign add;
    SubAssign sub_assign sub;
    MulAssign mul_assign mul;
    DivAssign div_assign div;
}
