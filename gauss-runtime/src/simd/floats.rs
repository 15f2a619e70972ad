//! Plain floats in lanes: operations on many are done in vectors.

use super::together::{Operation, Question};
#[cfg(not(feature = "wide"))]
use super::together::{each, one_by_one};

/// In the vectors of the crate `wide`: as many of the longest as there are, then of shorter ones.
#[cfg(feature = "wide")]
macro_rules! in_vectors {
    ($float:ident, $operation:ident, $question:ident: $($vector:ident of $width:literal),+) => {
        #[inline]
        fn $operation<O: Operation, const N: usize>(numbers: [&[$float; N]; 4]) -> [$float; N] {
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
        fn $question<Q: Question, const N: usize>(numbers: [&[$float; N]; 2]) -> bool {
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
        fn $operation<O: Operation, const N: usize>(numbers: [&[$float; N]; 4]) -> [$float; N] {
            one_by_one::<$float, O, N>(numbers)
        }

        #[inline]
        fn $question<Q: Question, const N: usize>(numbers: [&[$float; N]; 2]) -> bool {
            each::<$float, Q, N>(numbers)
        }
    };
}

#[cfg(not(feature = "wide"))]
in_loops!(f64, of_doubles, all_doubles);
#[cfg(not(feature = "wide"))]
in_loops!(f32, of_singles, all_singles);

crate::__packs_of_one_0_1_0! {
    [] f64 {
        #[inline(always)]
        fn together<O: Operation, const N: usize>(numbers: [&[Self; N]; 4]) -> [Self; N] {
            of_doubles::<O, N>(numbers)
        }

        #[inline(always)]
        fn all_together<Q: Question, const N: usize>(numbers: [&[Self; N]; 2]) -> bool {
            all_doubles::<Q, N>(numbers)
        }
    };
    [] f32 {
        #[inline(always)]
        fn together<O: Operation, const N: usize>(numbers: [&[Self; N]; 4]) -> [Self; N] {
            of_singles::<O, N>(numbers)
        }

        #[inline(always)]
        fn all_together<Q: Question, const N: usize>(numbers: [&[Self; N]; 2]) -> bool {
            all_singles::<Q, N>(numbers)
        }
    };
}
