//! Vectors of four numbers, for programs that are packed.

use core::fmt;

use ::wide::f64x4;

/// The first of two blocks, which has vectors; the second does the same number by number.
#[doc(hidden)]
#[macro_export]
macro_rules! __with_vectors_0_1_0 {
    ({ $($with:tt)* } { $($without:tt)* }) => {{ $($with)* }};
}

/// Constants of a kernel once more, in rows that vectors load at once: a row on two cache lines would be loaded twice.
#[repr(align(32))]
#[derive(Clone, Copy)]
pub struct Rows<const N: usize>([[f64; 4]; N]);

impl<const N: usize> Rows<N> {
    /// Rows that hold these numbers.
    pub fn new(rows: [[f64; 4]; N]) -> Self {
        Self(rows)
    }

    /// One of them.
    #[inline(always)]
    pub fn row(&self, index: usize) -> f64x4 {
        f64x4::new(self.0[index])
    }
}

/// The name alone is shown: the numbers are shown as constants.
impl<const N: usize> fmt::Debug for Rows<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Rows")
    }
}

/// Four numbers.
#[inline(always)]
pub fn vector(lanes: [f64; 4]) -> f64x4 {
    f64x4::new(lanes)
}

/// A number in all lanes.
#[inline(always)]
pub fn spread(number: f64) -> f64x4 {
    f64x4::splat(number)
}

/// The numbers.
#[inline(always)]
pub fn lanes(vector: f64x4) -> [f64; 4] {
    vector.to_array()
}

/// a + b.
#[inline(always)]
pub fn sum(a: f64x4, b: f64x4) -> f64x4 {
    a + b
}

/// a − b.
#[inline(always)]
pub fn difference(a: f64x4, b: f64x4) -> f64x4 {
    a - b
}

/// a b.
#[inline(always)]
pub fn product(a: f64x4, b: f64x4) -> f64x4 {
    a * b
}

/// a b + c, rounded once.
#[inline(always)]
pub fn product_plus(a: f64x4, b: f64x4, c: f64x4) -> f64x4 {
    a.mul_add(b, c)
}

/// c − a b, rounded once.
#[inline(always)]
pub fn less_product(a: f64x4, b: f64x4, c: f64x4) -> f64x4 {
    a.mul_neg_add(b, c)
}

/// −a.
#[inline(always)]
pub fn negative(a: f64x4) -> f64x4 {
    -a
}
