//! Rows of arrays as lanes: number `i` of eight rows becomes one vector.
//!
//! Many rows at a time go to a place of their own, and kernels read vectors there. Where a kernel gathers its vectors from
//! rows itself, compilers load single numbers, and a kernel of a robot waits for them half of the time.

#![allow(unsafe_code)]

use gauss_runtime::simd::Packed;

use crate::memory::Source;
use crate::scene::Pack;

/// How many lanes there are.
pub const WIDTH: usize = <Pack as Packed>::WIDTH;

/// Numbers in lanes: number `i` of pack `p` is vector `p · size + i`.
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

    /// Takes over the first rows, as many as fill these packs.
    ///
    /// Up to eight columns are gone through at once, whose number is then a constant, as is the way from row to row where
    /// they are all.
    ///
    /// # Safety
    /// The rows exist, and there is a place for them.
    pub unsafe fn take(&mut self, packs: usize, rows: Source) {
        let size = self.size;
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

    /// As rows of vectors, for kernels.
    ///
    /// # Safety
    /// They are read as [`Pack`]s while this is there and is not changed.
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
            if N.is_power_of_two() {
                // All are read before any is written: compilers do not know that these are different places, and make
                // shuffles of vectors only then. With other numbers of columns they make worse of it.
                let mut numbers = [[0.0; WIDTH]; N];
                for (i, numbers) in numbers.iter_mut().enumerate() {
                    for (k, number) in numbers.iter_mut().enumerate() {
                        *number = read(i, k);
                    }
                }
                for (i, numbers) in numbers.iter().enumerate() {
                    for (k, &number) in numbers.iter().enumerate() {
                        write(i, k, number);
                    }
                }
            } else {
                for i in 0..N {
                    for k in 0..WIDTH {
                        write(i, k, read(i, k));
                    }
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
                        let number = lanes.vectors[row / WIDTH * size + i].extract(row % WIDTH);
                        assert_eq!(number, rows[row * stride + i], "size {size}, stride {stride}, row {row}");
                    }
                }
            }
        }
    }
}
