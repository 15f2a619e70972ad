//! Poses of the body from configurations of every motion and chart, and configurations from poses.

use nalgebra::{Isometry2, Isometry3, IsometryMatrix3, Rotation3, SMatrix, SVector, UnitQuaternion};

use crate::chart::rotation::{coordinates_of_rotation, rotation_from_coordinates};
use crate::chart::{ChartError, MotionRule, RotationChart};
use crate::configuration::Configuration;
use crate::lie::{se2, se3};
use crate::private::containers::matrix;
use crate::real::Real;
use crate::triple::{quaternion, triple, unit_quaternion};

/// The Jacobian of the centre of mass, from the centroidal momentum matrix.
#[inline]
pub fn center_jacobian<T: Real, const N: usize>(matrix: &SMatrix<T, 6, N>, mass: T) -> SMatrix<T, 3, N> {
    SMatrix::from_fn(|i, k| matrix[(i, k)] / mass)
}

/// The pose of a frame, from b and the rows of R.
#[inline(always)]
pub fn frame_pose<T: Real>(position: [T; 3], rows: [[T; 3]; 3]) -> IsometryMatrix3<T> {
    let rotation = Rotation3::from_matrix_unchecked(matrix(rows));
    IsometryMatrix3 { rotation, translation: SVector::from(position).into() }
}

/// R = 1.
#[inline]
pub fn unturned<T: Real>() -> UnitQuaternion<T> {
    unit_quaternion([T::zero(), T::zero(), T::zero(), T::one()])
}

/// R = 1 and b = 0.
#[inline]
pub fn unmoved<T: Real>() -> Isometry3<T> {
    pose_of_rotation(&unturned())
}

/// The same in the plane.
#[inline]
pub fn unmoved_in_plane<T: Real>() -> Isometry2<T> {
    let (zero, one) = (T::zero(), T::one());
    Configuration::from_components(&SVector::from([one, zero, zero, zero]))
}

/// The pose with a unit quaternion (x, y, z, w) and a translation b.
#[inline(always)]
pub fn pose_from_quaternion<T: Real>(rotation: [T; 4], b: [T; 3]) -> Isometry3<T> {
    se3::isometry(unit_quaternion(rotation), b)
}

/// A pose as the configuration of a free body.
///
/// # Errors
/// When a component is not finite.
#[inline(always)]
pub fn free_pose<T: Real>(pose: &Isometry3<T>) -> Result<Isometry3<T>, ChartError> {
    check_finite(pose)?;
    Ok(*pose)
}

/// The pose of a body with a fixed point: b = 0.
#[inline(always)]
pub fn pose_of_rotation<T: Real>(rotation: &UnitQuaternion<T>) -> Isometry3<T> {
    se3::isometry(*rotation, [T::zero(); 3])
}

/// The inverse of [`pose_of_rotation`].
///
/// # Errors
/// When b is not zero.
#[inline(always)]
pub fn rotation_of_pose<T: Real>(pose: &Isometry3<T>) -> Result<UnitQuaternion<T>, ChartError> {
    check_finite(pose)?;
    check_fixed_point(pose)?;
    Ok(pose.rotation)
}

/// The pose of a planar body.
#[inline(always)]
pub fn pose_of_plane<T: Real>(plane: &Isometry2<T>) -> Isometry3<T> {
    // The half angle from cos θ and sin θ without an inverse function: for cos θ ≥ 0 it is (sin θ, 1 + cos θ) up to
    // length, otherwise ±(1 − cos θ, sin θ), so that the longer one is always taken.
    let rotation = plane.rotation.as_ref();
    let (cosine, sine) = (rotation.re, rotation.im);
    let (zero, one) = (T::zero(), T::one());
    let long = one + cosine.abs();
    let z = T::select_lt(cosine, zero, T::select_lt(sine, zero, -long, long), sine);
    let w = T::select_lt(cosine, zero, sine.abs(), long);
    let over = (z * z + w * w).sqrt().recip();
    let [x, y] = plane.translation.vector.data.0[0];
    pose_from_quaternion([zero, zero, z * over, w * over], [x, y, zero])
}

/// The inverse of [`pose_of_plane`].
///
/// # Errors
/// When O is out of the plane k₁k₂, or e₃ is not k₃.
#[inline(always)]
pub fn plane_of_pose<T: Real>(pose: &Isometry3<T>) -> Result<Isometry2<T>, ChartError> {
    check_finite(pose)?;
    check_plane(pose)?;
    let ([_, _, z, w], [x, y, _]) = (quaternion(&pose.rotation), triple(&pose.translation.vector));
    let over = (w * w + z * z).recip();
    let (cosine, sine) = ((w - z) * (w + z) * over, (z + z) * w * over);
    Ok(se2::isometry(se2::rotation(cosine, sine), [x, y]))
}

/// The pose with rotation coordinates and a translation b.
#[inline(always)]
pub fn pose_of_chart<T: Real>(chart: RotationChart, coordinates: [T; 3], b: [T; 3]) -> Isometry3<T> {
    se3::isometry(rotation_from_coordinates(chart, coordinates), b)
}

/// The inverse of [`pose_of_chart`].
///
/// # Errors
/// When the coordinates are singular.
#[inline(always)]
pub fn chart_of_pose<T: Real>(chart: RotationChart, pose: &Isometry3<T>) -> Result<([T; 3], [T; 3]), ChartError> {
    check_finite(pose)?;
    let coordinates = coordinates_of_rotation(chart, &pose.rotation)?;
    Ok((coordinates, triple(&pose.translation.vector)))
}

/// The pose with rotation coordinates of a body with a fixed point.
#[inline(always)]
pub fn pose_of_rotation_chart<T: Real>(chart: RotationChart, coordinates: [T; 3]) -> Isometry3<T> {
    pose_of_chart(chart, coordinates, [T::zero(); 3])
}

/// The inverse of [`pose_of_rotation_chart`].
///
/// # Errors
/// When b is not zero, or the coordinates are singular.
#[inline(always)]
pub fn rotation_chart_of_pose<T: Real>(chart: RotationChart, pose: &Isometry3<T>) -> Result<[T; 3], ChartError> {
    check_finite(pose)?;
    check_fixed_point(pose)?;
    coordinates_of_rotation(chart, &pose.rotation)
}

/// The pose of a planar body with coordinates x, y, θ.
#[inline(always)]
pub fn pose_of_plane_chart<T: Real>([x, y, theta]: [T; 3]) -> Isometry3<T> {
    pose_of_chart(RotationChart::Angle, [theta, T::zero(), T::zero()], [x, y, T::zero()])
}

/// The inverse of [`pose_of_plane_chart`], θ in [−π, π].
///
/// # Errors
/// When O is out of the plane k₁k₂, or e₃ is not k₃.
#[inline(always)]
pub fn plane_chart_of_pose<T: Real>(pose: &Isometry3<T>) -> Result<[T; 3], ChartError> {
    check_finite(pose)?;
    check_plane(pose)?;
    let [theta, _, _] = coordinates_of_rotation(RotationChart::Angle, &pose.rotation)?;
    let [x, y, _] = triple(&pose.translation.vector);
    Ok([x, y, theta])
}

/// A length or a sine that should be zero and is so small that it can be the rounding of numbers of order 1. A pose
/// carries no unit of length of its own, so the bound is absolute.
#[inline(always)]
fn vanishes<T: Real>(value: T, rule: MotionRule) -> Result<(), ChartError> {
    for lane in 0..T::LANES {
        let value = value.lane(lane);
        if value.abs() > 8.0 * T::EPSILON {
            return Err(ChartError::Inexpressible { rule, value });
        }
    }
    Ok(())
}

#[inline(always)]
fn check_finite<T: Real>(pose: &Isometry3<T>) -> Result<(), ChartError> {
    let finite = crate::configuration::Configuration::is_finite(pose);
    if finite { Ok(()) } else { Err(ChartError::NonFinite) }
}

#[inline(always)]
fn check_fixed_point<T: Real>(pose: &Isometry3<T>) -> Result<(), ChartError> {
    let b = triple(&pose.translation.vector);
    (0..3).try_for_each(|axis| vanishes(b[axis], MotionRule::FixedPoint { axis }))
}

#[inline(always)]
fn check_plane<T: Real>(pose: &Isometry3<T>) -> Result<(), ChartError> {
    let [x, y, _, _] = quaternion(&pose.rotation);
    vanishes(triple(&pose.translation.vector)[2], MotionRule::InPlane)?;
    vanishes(x, MotionRule::Upright)?;
    vanishes(y, MotionRule::Upright)
}
