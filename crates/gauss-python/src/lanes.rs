//! Rows of arrays as lanes: number `i` of eight rows becomes one vector.
//!
//! Many rows at a time go to a place of their own, and kernels read vectors there. Where a kernel gathers its vectors
//! from rows itself, compilers load single numbers, and a kernel of a robot waits for them half of the time. Of rows of
//! one or two numbers they make shuffles: these are read as they are.

#![allow(unsafe_code)]

use gauss_runtime::simd::Packed;

use crate::memory::Source;

/// The lanes in which batches are computed, where a struct is generic in its scalar: a vector that lies in one line of
/// the cache, as `Lanes<f64, 8>` need not do.
pub type Pack = wide::f64x8;

/// Number of lanes.
pub const WIDTH: usize = <Pack as Packed>::WIDTH;

/// Up to so many numbers of a row kernels make lanes of themselves.
pub const SHORT: usize = 2;

/// Numbers as kernels read them. Of rows that are longer than [`SHORT`] number `i` of pack `p` is vector
/// `p · size + i`; others are rows, one behind the other.
pub struct Lanes {
    vectors: Vec<Pack>,
    size: usize,
}

impl Lanes {
    /// A place for rows of so many numbers.
    #[must_use]
    pub fn new(packs: usize, size: usize) -> Self {
        Self { vectors: vec![Pack::ZERO; packs * size], size }
    }

    /// Whether kernels read these rows as they are.
    #[must_use]
    pub fn are(rows: Source, size: usize) -> bool {
        size <= SHORT && rows.stride() == size
    }

    /// Takes over the first rows, as many as fill these packs.
    ///
    /// Up to eight columns are gone through at once, whose number is then a constant, as is the way from row to row
    /// where they are all.
    ///
    /// # Safety
    /// The rows exist, and there is a place for them.
    pub unsafe fn take(&mut self, packs: usize, rows: Source) {
        let size = self.size;
        if size <= SHORT {
            let to = self.vectors.as_mut_ptr().cast::<f64>();
            for (row, i) in (0..packs * WIDTH).flat_map(|row| (0..size).map(move |i| (row, i))) {
                // SAFETY: of this function.
                unsafe { to.add(row * size + i).write(rows.get(row, i)) };
            }
            return;
        }
        for first in (0..size).step_by(8) {
            let columns = Columns { rows, lanes: self.vectors.as_mut_ptr().cast(), packs, size, first };
            // SAFETY: of this function.
            unsafe {
                match size - first {
                    1 => columns.take::<1>(),
                    2 => columns.take::<2>(),
                    3 => columns.take::<3>(),
                    4 => columns.take::<4>(),
                    5 => columns.take::<5>(),
                    6 => columns.take::<6>(),
                    7 => columns.take::<7>(),
                    _ => columns.take::<8>(),
                }
            }
        }
    }

    /// As kernels read them.
    ///
    /// # Safety
    /// They are read while this is there and is not changed.
    #[must_use]
    pub unsafe fn source(&self) -> Source {
        // SAFETY: of this function.
        unsafe { Source::new(self.vectors.as_ptr().cast(), self.size) }
    }
}

/// Some columns of rows, and where they go.
struct Columns {
    rows: Source,
    lanes: *mut f64,
    packs: usize,
    size: usize,
    first: usize,
}

impl Columns {
    /// # Safety
    /// As of [`Lanes::take`].
    #[inline(never)]
    unsafe fn take<const N: usize>(&self) {
        let stride = self.rows.stride();
        // SAFETY: of this function.
        unsafe { if stride == N { self.at_distance::<N>(N) } else { self.at_distance::<N>(stride) } }
    }

    #[inline(always)]
    unsafe fn at_distance<const N: usize>(&self, stride: usize) {
        // Not read again after each number that is written.
        let Self { rows, lanes, packs, size, first } = *self;
        let rows = rows.at_distance(stride);
        for pack in 0..packs {
            // SAFETY: of this function: these are places of these packs.
            let read = |i, k| unsafe { rows.get(pack * WIDTH + k, first + i) };
            let write = |i, k, number| unsafe {
                lanes.add((pack * size + first + i) * WIDTH + k).write(number);
            };
            for i in 0..N {
                for k in 0..WIDTH {
                    write(i, k, read(i, k));
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_become_lanes() {
        for size in 1..20 {
            for (stride, packs) in [(size, 3), (size + 2, 2), (0, 1)] {
                let rows: Vec<f64> = (0..packs * WIDTH * (stride + size)).map(|k| k as f64).collect();
                let mut lanes = Lanes::new(packs, size);
                // SAFETY: there are as many rows.
                unsafe { lanes.take(packs, Source::new(rows.as_ptr(), stride)) };
                for row in 0..packs * WIDTH {
                    for i in 0..size {
                        let (vector, lane) = match size {
                            ..=SHORT => ((row * size + i) / WIDTH, (row * size + i) % WIDTH),
                            _ => (row / WIDTH * size + i, row % WIDTH),
                        };
                        let number = lanes.vectors[vector].extract(lane);
                        assert_eq!(number, rows[row * stride + i], "size {size}, stride {stride}, row {row}");
                    }
                }
            }
        }
    }
}
