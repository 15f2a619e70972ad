//! The only code that touches memory of arrays: rows of numbers by their addresses.
//!
//! Arrays of Python may be written by other threads while these rows are read, as with every function of NumPy; numbers
//! are then any, and nothing else is. No reference is ever made to the numbers, only copies of single ones.

#![allow(unsafe_code)]

/// Rows that are read: row `k` begins `k · stride` numbers behind the first.
#[derive(Clone, Copy, Debug)]
pub struct Source {
    first: *const f64,
    stride: usize,
}

/// Rows that are written.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    first: *mut f64,
    stride: usize,
}

// Addresses of numbers that the caller keeps alive over the call; threads write different rows.
unsafe impl Send for Source {}
unsafe impl Sync for Source {}
unsafe impl Send for Target {}
unsafe impl Sync for Target {}

impl Source {
    /// Source of a method that does not read it.
    pub const NONE: Self = Self { first: std::ptr::null(), stride: 0 };

    /// # Safety
    /// Numbers at all rows that will be read outlive it.
    pub unsafe fn new(first: *const f64, stride: usize) -> Self {
        Self { first, stride }
    }

    /// From one row to the next, in numbers.
    #[inline(always)]
    pub fn stride(&self) -> usize {
        self.stride
    }

    /// The same rows at this distance from each other, which one row alone does not have.
    #[inline(always)]
    pub fn at_distance(self, stride: usize) -> Self {
        Self { stride, ..self }
    }

    /// The rows from one on.
    ///
    /// # Safety
    /// The row exists; any does of [`NONE`](Self::NONE).
    pub unsafe fn beginning(self, row: usize) -> Self {
        Self { first: unsafe { self.first.add(row * self.stride) }, ..self }
    }

    /// Copies so many numbers of each row, one row behind the other.
    ///
    /// # Safety
    /// The rows exist, and have so many numbers.
    pub unsafe fn copy(&self, rows: std::ops::Range<usize>, size: usize, to: &mut [f64]) {
        for (row, to) in rows.zip(to.chunks_exact_mut(size)) {
            to.iter_mut().enumerate().for_each(|(i, number)| *number = unsafe { self.get(row, i) });
        }
    }

    /// Number `i` of a row.
    ///
    /// # Safety
    /// The row and the number exist.
    #[inline(always)]
    pub unsafe fn get(&self, row: usize, i: usize) -> f64 {
        unsafe { self.first.add(row * self.stride + i).read() }
    }

    /// Vector `i` of a row of vectors, which lanes are. Of a scalar that is one number, rows are those of arrays.
    ///
    /// # Safety
    /// The vector exists and is of this type.
    #[inline(always)]
    pub unsafe fn vector<T: Copy>(&self, row: usize, i: usize) -> T {
        unsafe { self.first.cast::<T>().add(row * self.stride + i).read() }
    }
}

impl Target {
    /// Target of results that a method does not have.
    pub const NONE: Self = Self { first: std::ptr::null_mut(), stride: 0 };

    /// # Safety
    /// Numbers at all rows that will be written outlive it, and nobody else writes them.
    pub unsafe fn new(first: *mut f64, stride: usize) -> Self {
        Self { first, stride }
    }

    /// From one row to the next, in numbers.
    #[inline(always)]
    pub fn stride(&self) -> usize {
        self.stride
    }

    /// As of [`Source`].
    #[inline(always)]
    pub fn at_distance(self, stride: usize) -> Self {
        Self { stride, ..self }
    }

    /// As of [`Source`].
    ///
    /// # Safety
    /// As there.
    pub unsafe fn beginning(self, row: usize) -> Self {
        Self { first: unsafe { self.first.add(row * self.stride) }, ..self }
    }

    /// Writes number `i` of a row.
    ///
    /// # Safety
    /// The row and the number exist.
    #[inline(always)]
    pub unsafe fn set(&self, row: usize, i: usize, value: f64) {
        unsafe { self.first.add(row * self.stride + i).write(value) }
    }
}
