//! Mass matrices factored along their sparsity: A = L Lᵀ, rows of L from the first entry of A that is not zero.
//!
//! Between these and the diagonal there may be any numbers; before them L has zeros like A (A. Jennings 1966). Of free
//! bodies that are the blocks of each.

use gauss_runtime::nalgebra::SMatrix;
use gauss_runtime::real::Real;

/// L of a matrix of D rows. Of packs zeros are those of all lanes, and of numbers with derivatives what has none.
pub(super) struct Envelope<T, const D: usize> {
    lower: SMatrix<T, D, D>,
    /// First column of each row that is not zero.
    first: [usize; D],
}

impl<T: Real, const D: usize> Envelope<T, D> {
    /// Factors a symmetric matrix, whose entries on and below the diagonal are read. One that is not positive definite
    /// gives no finite numbers.
    pub(super) fn of(mut lower: SMatrix<T, D, D>) -> Self {
        let first = core::array::from_fn(|i| (0..i).find(|&j| lower[(i, j)] != T::zero()).unwrap_or(i));
        for i in 0..D {
            for j in first[i]..=i {
                let common = first[i].max(first[j])..j;
                let rest = common.fold(lower[(i, j)], |sum, k| sum - lower[(i, k)] * lower[(j, k)]);
                lower[(i, j)] = if i == j { rest.sqrt() } else { rest / lower[(j, j)] };
            }
        }
        Self { lower, first }
    }

    /// L⁻¹ of a vector that is zero before `from`.
    pub(super) fn forward(&self, x: &mut [T], from: usize) {
        for i in from..D {
            let rest = (self.first[i].max(from)..i).fold(x[i], |sum, k| sum - self.lower[(i, k)] * x[k]);
            x[i] = if rest == T::zero() { rest } else { rest / self.lower[(i, i)] };
        }
    }

    /// L⁻ᵀ of a vector.
    pub(super) fn backward(&self, x: &mut [T]) {
        for i in (0..D).rev() {
            // Of bodies that do not touch.
            if x[i] != T::zero() {
                x[i] /= self.lower[(i, i)];
                let entry = x[i];
                (self.first[i]..i).for_each(|k| x[k] -= self.lower[(i, k)] * entry);
            }
        }
    }
}

/// Range of rows in which each column is not zero: from, and up to.
pub(super) fn extents<T: Real, const D: usize, const R: usize>(columns: &SMatrix<T, D, R>) -> [(usize, usize); R] {
    core::array::from_fn(|row| {
        let x = &columns.data.0[row];
        let from = x.iter().position(|x| *x != T::zero()).unwrap_or(D);
        (from, x.iter().rposition(|x| *x != T::zero()).map_or(from, |last| last + 1))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use gauss_runtime::nalgebra::SVector;

    #[test]
    fn blocks_and_bands_are_solved() {
        // Diagonally dominant, with a block of 3, one of 1, and a row that reaches back.
        let mut a = SMatrix::<f64, 6, 6>::identity() * 8.0;
        for (i, j, x) in [(1, 0, 1.0), (2, 0, -2.0), (2, 1, 0.5), (5, 2, 1.5), (5, 4, -1.0)] {
            (a[(i, j)], a[(j, i)]) = (x, x);
        }
        let factor = Envelope::of(a);
        assert_eq!(factor.first, [0, 0, 0, 3, 4, 2]);
        for from in 0..6 {
            let right = SVector::<f64, 6>::from_fn(|i, _| if i < from { 0.0 } else { 1.0 + i as f64 });
            let mut x = right;
            factor.forward(x.as_mut_slice(), from);
            assert!(x.iter().take(from).all(|x| *x == 0.0));
            factor.backward(x.as_mut_slice());
            // Six products of numbers up to 8, at a condition below 2.
            assert!((a * x - right).amax() <= 6.0 * 8.0 * 2.0 * f64::EPSILON, "{}", a * x - right);
        }
        let mut x = [1.0, 1.0];
        Envelope::of(SMatrix::<f64, 2, 2>::zeros()).forward(&mut x, 0);
        assert!(!x[0].is_finite());
        let columns = SMatrix::<f64, 4, 2>::from([[0.0, 1.0, 0.0, 2.0], [0.0; 4]]);
        assert_eq!(extents(&columns), [(1, 4), (4, 4)]);
    }
}
