//! Eigenvalues of small symmetric matrices by Jacobi's method.
//!
//! Chosen for its accuracy: on a positive definite matrix scaled to a unit diagonal it gives even the small eigenvalues
//! to high relative precision (Demmel & Veselić 1992), and these decide whether a mass matrix is accepted.

use crate::real::Real;

/// The eigenvalues of a symmetric matrix (its lower triangle is ignored), in no particular order; for a diagonal matrix
/// those of the axes in order. Finite input is expected; at most 20 sweeps, of which 6 suffice in practice.
pub(crate) fn eigenvalues<const N: usize>(matrix: &[[f64; N]; N]) -> [f64; N] {
    // Units: the largest entry becomes 1, so that squares neither overflow nor vanish.
    let largest = matrix.iter().flatten().fold(0.0_f64, |m, &e| m.max(e.abs()));
    if largest == 0.0 {
        return [0.0; N];
    }
    let mut a: [[f64; N]; N] =
        core::array::from_fn(|i| core::array::from_fn(|j| if i <= j { matrix[i][j] } else { matrix[j][i] } / largest));
    for _ in 0..20 {
        let mut rotated = false;
        for p in 0..N {
            for q in p + 1..N {
                // An entry below the rounding of the diagonal entries that it couples changes neither.
                if a[p][q].abs() <= 1e-17 * Real::sqrt((a[p][p] * a[q][q]).abs()) || a[p][q].abs() < 1e-300 {
                    continue;
                }
                rotated = true;
                rotate(&mut a, p, q);
            }
        }
        if !rotated {
            break;
        }
    }
    core::array::from_fn(|i| a[i][i] * largest)
}

/// One rotation that annihilates entry (p, q), by the smaller angle.
fn rotate<const N: usize>(a: &mut [[f64; N]; N], p: usize, q: usize) {
    let tau = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
    let root = Real::sqrt(1.0 + tau * tau);
    let tangent = if tau < 0.0 { -1.0 / (root - tau) } else { 1.0 / (root + tau) };
    let cosine = 1.0 / Real::sqrt(1.0 + tangent * tangent);
    let sine = tangent * cosine;
    let shift = tangent * a[p][q];
    a[p][p] -= shift;
    a[q][q] += shift;
    a[p][q] = 0.0;
    a[q][p] = 0.0;
    for k in 0..N {
        if k != p && k != q {
            let (u, v) = (a[k][p], a[k][q]);
            let (u, v) = (cosine * u - sine * v, sine * u + cosine * v);
            (a[k][p], a[p][k]) = (u, u);
            (a[k][q], a[q][k]) = (v, v);
        }
    }
}

/// The smallest eigenvalue of the symmetric part, where it is negative beyond rounding.
///
/// Rows and columns carry different units, but the sign of the smallest eigenvalue is invariant under congruence
/// (Sylvester), so it is decided after scaling to a unit diagonal, which takes the units out.
pub(super) fn negative_eigenvalue<const N: usize>(matrix: &[[f64; N]; N], unit: f64) -> Option<f64> {
    if !matrix.iter().flatten().all(|entry| entry.is_finite()) {
        return None;
    }
    let symmetric: [[f64; N]; N] =
        core::array::from_fn(|i| core::array::from_fn(|j| 0.5 * matrix[i][j] + 0.5 * matrix[j][i]));
    let scaled_eigenvalue = if let Some(i) = (0..N).find(|&i| symmetric[i][i] < 0.0) {
        // A diagonal entry is as it was given: its sign is beyond doubt.
        symmetric[i][i]
    } else {
        // Next to a zero on the diagonal any entry makes the part indefinite; the row is scaled to the size of its
        // entries then.
        let scale: [f64; N] = core::array::from_fn(|i| {
            let size = if symmetric[i][i] > 0.0 {
                symmetric[i][i]
            } else {
                symmetric[i].iter().fold(0.0_f64, |largest, entry| largest.max(entry.abs()))
            };
            if size > 0.0 { 1.0 / Real::sqrt(size) } else { 0.0 }
        });
        let scaled: [[f64; N]; N] =
            core::array::from_fn(|i| core::array::from_fn(|j| (symmetric[i][j] * scale[i]) * scale[j]));
        // Each entry is rounded when it is given, in the mean, and four times by scaling; these six ε of each move an
        // eigenvalue by 6 ε of the Frobenius norm at most. Jacobi's rotations are orthogonal up to rounding and add
        // about as much.
        let norm = Real::sqrt(scaled.iter().flatten().map(|entry| entry * entry).sum::<f64>());
        let smallest = least(&eigenvalues(&scaled));
        if smallest >= -16.0 * unit * norm {
            return None;
        }
        smallest
    };
    // What is reported is in the units given. Where these are so far apart that rounding hides its sign there, the
    // scaled one.
    let smallest = least(&eigenvalues(&symmetric));
    Some(if smallest < 0.0 { smallest } else { scaled_eigenvalue })
}

fn least<const N: usize>(values: &[f64; N]) -> f64 {
    values.iter().fold(f64::INFINITY, |least, &value| least.min(value))
}

#[cfg(test)]
mod tests {
    use super::eigenvalues;

    #[test]
    fn known_spectra() {
        assert_eq!(eigenvalues(&[[3.0, 0.0], [0.0, -1.0]]), [3.0, -1.0]);
        assert_eq!(eigenvalues(&[[0.0; 3]; 3]), [0.0; 3]);
        let mut found = eigenvalues(&[[2.0, -1.0, 0.0], [-1.0, 2.0, -1.0], [0.0, -1.0, 2.0]]);
        found.sort_by(f64::total_cmp);
        let root = 2.0_f64.sqrt();
        for (a, b) in found.into_iter().zip([2.0 - root, 2.0, 2.0 + root]) {
            assert!((a - b).abs() < 1e-15, "{a} {b}");
        }
        // Graded: the small eigenvalue keeps its relative precision. det = 1e-20 − 1e-22.
        let graded = eigenvalues(&[[1.0, 1e-11], [1e-11, 1e-20]]);
        let smallest = graded[0].min(graded[1]);
        assert!((smallest / 0.99e-20 - 1.0).abs() < 1e-13, "{smallest:e}");
        // Units at the end of the range.
        let huge = eigenvalues(&[[2e300, 1e300], [1e300, 2e300]]);
        assert!((huge[0].max(huge[1]) / 3e300 - 1.0).abs() < 1e-15);
    }
}
