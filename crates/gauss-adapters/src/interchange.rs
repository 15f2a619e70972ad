//! Poses in the types of other crates: of game engines and renderers, by way of the crate [`mint`] or directly.
//!
//! `nalgebra` converts vectors, matrices and quaternions both ways with `From` and `Into`, once a feature of this crate
//! is on: `mint`; `glam030`, `glam031`, `glam032`, `glam033` for the crate `glam` in these versions. Rotations,
//! translations and poses as pairs are among them for `glam`; for `mint`, which has neither, they are here.
//!
//! Axes and the order of parts are not touched: R and b, body to observer, are what an engine calls the orientation and
//! the position of an object. Many engines have f32, and y upwards: `pose.cast::<f32>()` does the former, a rotation of
//! the observer the latter.
//!
//! ```
//! use gauss_adapters::interchange::{pose_from_mint, pose_to_mint};
//! use gauss_runtime::prelude::*;
//!
//! let pose = Isometry3::new(Vector3::new(1.0, 2.0, 3.0), Vector3::new(0.1, 0.2, 0.3));
//! let (position, orientation) = pose_to_mint(&pose);
//! assert_eq!((position.z, orientation.s), (3.0, pose.rotation.w));
//! assert_eq!(pose_from_mint(position, orientation), Ok(pose));
//!
//! // A vector goes by itself.
//! let force: mint::Vector3<f64> = Vector3::new(0.0, 0.0, -9.81).into();
//! assert_eq!(Vector3::from(force).z, -9.81);
//! ```

use nalgebra::{Isometry3, Quaternion, Scalar, SimdValue, UnitQuaternion, Vector3};

use gauss_runtime::configuration::{StateError, check};
use gauss_runtime::real::Real;

/// b and R of a pose.
#[must_use]
pub fn pose_to_mint<T: Scalar + SimdValue + Copy>(pose: &Isometry3<T>) -> (mint::Vector3<T>, mint::Quaternion<T>) {
    (pose.translation.vector.into(), pose.rotation.into())
}

/// The pose of b and R.
///
/// # Errors
/// [`StateError`] of a quaternion that is not one of a rotation, and of numbers that are not finite.
pub fn pose_from_mint<T: Real>(
    position: impl Into<mint::Vector3<T>>,
    orientation: impl Into<mint::Quaternion<T>>,
) -> Result<Isometry3<T>, StateError> {
    let rotation = UnitQuaternion::new_unchecked(Quaternion::from(orientation.into()));
    let pose = Isometry3 { rotation, translation: Vector3::from(position.into()).into() };
    check(&pose)?;
    Ok(pose)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn poses_return_and_others_are_refused() {
        let pose = Isometry3::new(Vector3::new(1.0, 2.0, 3.0), Vector3::new(0.1, 0.2, 0.3)).cast::<f32>();
        let (position, orientation) = pose_to_mint(&pose);
        assert_eq!([position.x, position.y, position.z], [1.0, 2.0, 3.0]);
        let quaternion = [orientation.v.x, orientation.v.y, orientation.v.z, orientation.s];
        assert_eq!(quaternion, <[f32; 4]>::from(pose.rotation.coords));
        assert_eq!(pose_from_mint(position, orientation), Ok(pose));
        let long = pose_from_mint([0.0, 0.0, 0.0], [0.5, 0.0, 0.0, 1.0]);
        assert_eq!(long, Err(StateError::OffGroup { excess: 0.25 }));
        let lost = pose_from_mint([0.0, f64::NAN, 0.0], [0.0, 0.0, 0.0, 1.0]);
        assert_eq!(lost, Err(StateError::NotFinite { component: 5 }));
    }
}
