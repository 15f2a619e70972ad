//! Configurations that come from outside: are they any?

use core::fmt;

use super::{Configuration, VectorSpace};
use crate::real::Real;

/// Why numbers are no state.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum StateError {
    /// A number is infinite or NaN.
    NotFinite {
        /// Which, in the order of [`Configuration::components`], or of the speeds.
        component: usize,
    },
    /// The components of a rotation belong to none: of a quaternion, of cosine and sine, the squares do not add up to
    /// 1.
    OffGroup {
        /// Difference between the sum of the squares and 1, without a sign.
        excess: f64,
    },
}

impl fmt::Display for StateError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite { component } => write!(f, "number {component} is infinite or undefined"),
            Self::OffGroup { excess } => write!(
                f,
                "the components of a rotation belong to none: their squares should add up to 1 and are {excess:.1e} away"
            ),
        }
    }
}

impl core::error::Error for StateError {}

/// Refuses components that are not finite, and those that are off the group by more than the root of the rounding unit.
/// Nearer components are brought back to rounding by a single step, because the norm is held to second order
/// ([`renormalise`](Configuration::renormalise)). So components that were written with all digits are not touched.
///
/// ```
/// use gauss_runtime::configuration::{StateError, check};
/// use gauss_runtime::prelude::*;
///
/// let pose = Isometry3::new(Vector3::new(1.0, 2.0, 3.0), Vector3::new(0.1, 0.2, 0.3));
/// assert_eq!(check(&pose), Ok(()));
/// let long = UnitQuaternion::new_unchecked(Quaternion::new(1.0, 0.5, 0.0, 0.0));
/// assert_eq!(check(&long), Err(StateError::OffGroup { excess: 0.25 }));
/// ```
///
/// # Errors
/// A [`StateError`]: components that are not finite, or off the group.
pub fn check<Q: Configuration>(q: &Q) -> Result<(), StateError> {
    all_finite::<Q::Scalar, _>(&q.components())?;
    // On the group `tangent` of the rates of the components is the velocity; off the group the norm of the components
    // remains as a factor.
    let mut excess: f64 = 0.0;
    for i in 0..Q::Tangent::DIM {
        let mut unit = Q::Tangent::zero();
        unit.set_component(i, Q::Scalar::one());
        let back = q.tangent(&q.component_rates(&unit));
        excess = excess.max(back.add_scaled(-Q::Scalar::one(), &unit).max_norm());
    }
    // Overflow makes infinities and NaN of large numbers; neither is below.
    if excess * excess <= Q::Scalar::EPSILON { Ok(()) } else { Err(StateError::OffGroup { excess }) }
}

/// The first component that is not finite.
pub(crate) fn all_finite<T: Real, V: VectorSpace<T>>(vector: &V) -> Result<(), StateError> {
    match (0..V::DIM).find(|&i| !vector.component(i).is_finite()) {
        Some(component) => Err(StateError::NotFinite { component }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Isometry2, Isometry3, Quaternion, SVector, UnitQuaternion, Vector2, Vector3};

    fn quaternion(w: f64, i: f64, j: f64, k: f64) -> UnitQuaternion<f64> {
        UnitQuaternion::new_unchecked(Quaternion::new(w, i, j, k))
    }

    #[test]
    fn what_is_on_a_group_passes() {
        let pose = Isometry3::new(Vector3::new(1e9, 2.0, 3.0), Vector3::new(0.1, 0.2, 3.0));
        let plane = Isometry2::new(Vector2::new(1.0, 2.0), 0.7);
        assert_eq!(check(&(pose, (plane, SVector::from([1.0, -1e300])))), Ok(()));
        // Nine digits of a file.
        assert_eq!(check(&quaternion(0.547722558, 0.0, 0.836660027, 0.0)), Ok(()));
        assert_eq!(check(&UnitQuaternion::from_euler_angles(0.1_f32, 0.2, 0.3)), Ok(()));
    }

    #[test]
    fn what_is_beside_is_refused() {
        for beside in
            [quaternion(0.0, 0.0, 0.0, 0.0), quaternion(0.5477, 0.0, 0.8367, 0.0), quaternion(1e200, 0., 0., 0.)]
        {
            let pose = Isometry3::from_parts(Vector3::zeros().into(), beside);
            for error in [check(&beside), check(&pose), check(&(SVector::from([1.0]), pose))] {
                assert!(matches!(error, Err(StateError::OffGroup { .. })), "{beside:?}: {error:?}");
            }
        }
        let mut plane = Isometry2::new(Vector2::new(1.0, 2.0), 0.7);
        plane.rotation = nalgebra::Unit::new_unchecked(nalgebra::Complex::new(0.6, 0.7));
        let Err(StateError::OffGroup { excess }) = check(&plane) else { panic!("refused") };
        assert!((excess - 0.15).abs() < 1e-15);
        plane.translation.y = f64::NAN;
        assert_eq!(check(&plane), Err(StateError::NotFinite { component: 3 }));
        assert_eq!(check(&(plane, SVector::from([f64::INFINITY]))), Err(StateError::NotFinite { component: 3 }));
    }
}
