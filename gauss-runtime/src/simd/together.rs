//! Operations on the numbers of lanes at once.

use crate::real::Real;

/// An operation on numbers, lane by lane: of as many of the four as it needs.
pub trait Operation {
    /// Computes the result.
    fn of<V: Real>(numbers: [V; 4]) -> V;
}

/// A question whose answer for several numbers is yes where it is for each.
pub trait Question {
    /// The answer.
    fn of<V: Real>(numbers: [V; 2]) -> bool;
}

/// One by one.
#[inline]
pub(super) fn one_by_one<T: Real, O: Operation, const N: usize>(numbers: [&[T; N]; 4]) -> [T; N] {
    let mut results = *numbers[0];
    for i in 0..N {
        results[i] = O::of([numbers[0][i], numbers[1][i], numbers[2][i], numbers[3][i]]);
    }
    results
}

/// One by one, without a branch at each.
#[inline]
pub(super) fn each<T: Real, Q: Question, const N: usize>(numbers: [&[T; N]; 2]) -> bool {
    (0..N).fold(true, |all, i| all & Q::of([numbers[0][i], numbers[1][i]]))
}

macro_rules! operations {
    ($($name:ident: |$numbers:ident| $value:expr;)+) => {$(
        pub(super) struct $name;

        impl Operation for $name {
            #[inline(always)]
            fn of<V: Real>($numbers: [V; 4]) -> V {
                $value
            }
        }
    )+};
}

operations! {
    Sum: |x| x[0] + x[1];
    Difference: |x| x[0] - x[1];
    Product: |x| x[0] * x[1];
    Quotient: |x| x[0] / x[1];
    ProductAndSum: |x| x[0].fma(x[1], x[2]);
    Opposite: |x| -x[0];
    Root: |x| x[0].sqrt();
    Magnitude: |x| x[0].abs();
    Reciprocal: |x| x[0].recip();
    Choice: |x| V::select_lt(x[0], x[1], x[2], x[3]);
}

pub(super) struct Finite;

impl Question for Finite {
    #[inline(always)]
    fn of<V: Real>(numbers: [V; 2]) -> bool {
        numbers[0].is_finite()
    }
}

pub(super) struct LessThan;

impl Question for LessThan {
    #[inline(always)]
    fn of<V: Real>([a, b]: [V; 2]) -> bool {
        V::all_lt(a, b)
    }
}
