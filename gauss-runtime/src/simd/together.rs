//! One operation on the numbers of an array: in vectors where there are any.

use crate::real::Real;

/// An operation on numbers, lane by lane: of as many of the four as it needs.
pub trait Operation {
    /// What it gives.
    fn of<V: Real>(numbers: [V; 4]) -> V;
}

/// A question whose answer for several numbers is yes where it is for each.
pub trait Question {
    /// The answer.
    fn of<V: Real>(numbers: [V; 2]) -> bool;
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

pub(super) struct Less;

impl Question for Less {
    #[inline(always)]
    fn of<V: Real>([a, b]: [V; 2]) -> bool {
        V::all_lt(a, b)
    }
}

/// One by one.
#[inline]
pub(crate) fn one_by_one<T: Real, O: Operation, const N: usize>(numbers: [&[T; N]; 4]) -> [T; N] {
    let mut results = *numbers[0];
    for i in 0..N {
        results[i] = O::of([numbers[0][i], numbers[1][i], numbers[2][i], numbers[3][i]]);
    }
    results
}

/// One by one, without a branch at each.
#[inline]
pub(crate) fn each<T: Real, Q: Question, const N: usize>(numbers: [&[T; N]; 2]) -> bool {
    (0..N).fold(true, |all, i| all & Q::of([numbers[0][i], numbers[1][i]]))
}

/// In the vectors of the crate `wide`: as many of the longest as there are, then of shorter ones.
#[cfg(feature = "wide")]
macro_rules! in_vectors {
    ($float:ident, $operation:ident, $question:ident: $($vector:ident of $width:literal),+) => {
        #[inline]
        pub(crate) fn $operation<O: Operation, const N: usize>(numbers: [&[$float; N]; 4]) -> [$float; N] {
            use ::wide::{$($vector),+};

            let (mut results, mut done) = ([0.0; N], 0);
            $(
                while done + $width <= N {
                    let part = |k: usize| {
                        let mut part = [0.0; $width];
                        part.copy_from_slice(&numbers[k][done..done + $width]);
                        $vector::new(part)
                    };
                    let result = O::of([part(0), part(1), part(2), part(3)]);
                    results[done..done + $width].copy_from_slice(&result.to_array());
                    done += $width;
                }
            )+
            while done < N {
                results[done] = O::of(numbers.map(|numbers| numbers[done]));
                done += 1;
            }
            results
        }

        #[inline]
        pub(crate) fn $question<Q: Question, const N: usize>(numbers: [&[$float; N]; 2]) -> bool {
            use ::wide::{$($vector),+};

            let (mut all, mut done) = (true, 0);
            $(
                while done + $width <= N {
                    let part = |k: usize| {
                        let mut part = [0.0; $width];
                        part.copy_from_slice(&numbers[k][done..done + $width]);
                        $vector::new(part)
                    };
                    all &= Q::of([part(0), part(1)]);
                    done += $width;
                }
            )+
            while done < N {
                all &= Q::of(numbers.map(|numbers| numbers[done]));
                done += 1;
            }
            all
        }
    };
}

#[cfg(feature = "wide")]
in_vectors!(f64, of_doubles, all_doubles: f64x8 of 8, f64x4 of 4);
#[cfg(feature = "wide")]
in_vectors!(f32, of_singles, all_singles: f32x16 of 16, f32x8 of 8);

#[cfg(not(feature = "wide"))]
macro_rules! in_loops {
    ($float:ident, $operation:ident, $question:ident) => {
        #[inline]
        pub(crate) fn $operation<O: Operation, const N: usize>(numbers: [&[$float; N]; 4]) -> [$float; N] {
            one_by_one::<$float, O, N>(numbers)
        }

        #[inline]
        pub(crate) fn $question<Q: Question, const N: usize>(numbers: [&[$float; N]; 2]) -> bool {
            each::<$float, Q, N>(numbers)
        }
    };
}

#[cfg(not(feature = "wide"))]
in_loops!(f64, of_doubles, all_doubles);
#[cfg(not(feature = "wide"))]
in_loops!(f32, of_singles, all_singles);
