//! Substitutes for vectors where there are none.

/// The second of two blocks: the first has vectors.
#[doc(hidden)]
#[macro_export]
macro_rules! __with_vectors_0_1_0 {
    ({ $($with:tt)* } { $($without:tt)* }) => {{ $($without)* }};
}

/// Nothing: no vector loads them.
#[derive(Clone, Copy, Debug)]
pub struct Rows<const N: usize>;

impl<const N: usize> Rows<N> {
    /// Rows that hold nothing of these numbers.
    #[inline]
    pub fn new(_: [[f64; 4]; N]) -> Self {
        Self
    }
}
