//! Condition number of a mass matrix: the digits that its inversion loses.

use nalgebra::SMatrix;

use crate::private::eigenvalues;
use crate::real::Real;
use crate::system::GaussSystem;

/// The condition number of A at a configuration, 1 at best: accelerations lose some log₁₀ of it in digits, beyond what
/// parameters and forces have lost already. Infinite where A is not positive definite up to rounding.
///
/// It is the ratio of the extreme eigenvalues of `D^−½ A D^−½`, D the diagonal of A: units, and how masses compare with
/// moments of inertia, do not matter to it, as they do not to the generated code. It is large for a light body in a
/// heavy fluid that couples its motions, for a centre of mass whose distance from O is large compared with the body,
/// and near a singularity of the coordinates. Where A is constant (one body in the left-invariant chart) any
/// configuration gives the same number. For packs of numbers it is the worst of the lanes.
///
#[cfg_attr(
    feature = "derive",
    doc = r##"
```
use gauss_runtime::condition::condition;
use gauss_runtime::prelude::*;

/// A body whose pole is not its centre of mass.
#[derive(GaussDynamics)]
#[gauss(motion = free)]
struct Body {
    #[gauss(mass)]           mass: f64,
    #[gauss(center_of_mass)] center: Vector3<f64>,
    #[gauss(inertia)]        inertia: Matrix3<f64>,
}

# fn main() -> Result<(), Box<dyn std::error::Error>> {
let of = |distance: f64| {
    // I_O of a ball of radius of gyration 0.1 at that distance.
    let center = Vector3::new(distance, 0.0, 0.0);
    let inertia = Matrix3::identity() * (0.01 + distance * distance) - center * center.transpose();
    Body { mass: 1.0, center, inertia }.kernel().map(|kernel| condition(&kernel, 0.0, &Isometry3::identity()))
};
assert!(of(0.0)? == 1.0 && of(1.0)? > 100.0 && of(1000.0)? > 1e8);
# Ok(())
# }
```
"##
)]
#[must_use]
pub fn condition<S, T, const N: usize>(system: &S, t: T, q: &S::Configuration) -> f64
where
    T: Real,
    S: GaussSystem<Scalar = T, MassMatrix = SMatrix<T, N, N>>,
{
    let matrix = system.mass_matrix(t, q);
    (0..T::LANES).fold(1.0, |worst, lane| {
        let entries: [[f64; N]; N] = core::array::from_fn(|i| core::array::from_fn(|j| matrix.data.0[j][i].lane(lane)));
        let found = scaled_condition(&entries);
        if found > worst { found } else { worst }
    })
}

fn scaled_condition<const N: usize>(a: &[[f64; N]; N]) -> f64 {
    if !a.iter().enumerate().all(|(i, row)| row[i] > 0.0 && row.iter().all(|e| f64::is_finite(*e))) {
        return f64::INFINITY;
    }
    let roots: [f64; N] = core::array::from_fn(|i| Real::sqrt(a[i][i]));
    let scaled: [[f64; N]; N] =
        core::array::from_fn(|i| core::array::from_fn(|j| if i == j { 1.0 } else { a[i][j] / roots[i] / roots[j] }));
    let found = eigenvalues(&scaled);
    let (least, most) = found.iter().fold((f64::INFINITY, 0.0_f64), |(l, m), &e| (l.min(e), m.max(e)));
    // Below N roundings of entries of size 1 nothing is known of it.
    if least <= N as f64 * f64::EPSILON { f64::INFINITY } else { most / least }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::order::{TOP, start_by_velocity};

    #[test]
    fn of_matrices_that_are_known() {
        assert_eq!(scaled_condition(&[[1e200, 0.0], [0.0, 1e-200]]), 1.0);
        for (m, i, coupling) in [(1.0, 1.0, 0.5), (1e-150, 1e150, 0.999), (3e4, 2e-5, -0.999_999)] {
            let off = coupling * f64::sqrt(m) * f64::sqrt(i);
            let exact = (1.0 + f64::abs(coupling)) / (1.0 - f64::abs(coupling));
            let found = scaled_condition(&[[m, off], [off, i]]);
            // A rounding of the entry moves the small eigenvalue by ε.
            assert!((found / exact - 1.0).abs() < 8.0 * f64::EPSILON * exact, "{found} {exact}");
        }
        for singular in
            [[[1.0, 1.0], [1.0, 1.0]], [[1.0, 2.0], [2.0, 1.0]], [[0.0, 0.0], [0.0, 1.0]], [[f64::NAN; 2]; 2]]
        {
            assert_eq!(scaled_condition(&singular), f64::INFINITY);
        }
    }

    #[test]
    fn principal_axes_are_well_conditioned() {
        assert_eq!(condition(&TOP, 0.0, &start_by_velocity().q), 1.0);
    }
}
