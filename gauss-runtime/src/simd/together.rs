//! What is done with the numbers of lanes at once.

use crate::real::{Operation, Question, Real};

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

pub(super) struct Less;

impl Question for Less {
    #[inline(always)]
    fn of<V: Real>([a, b]: [V; 2]) -> bool {
        V::all_lt(a, b)
    }
}
