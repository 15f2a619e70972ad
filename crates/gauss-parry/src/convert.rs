//! Poses and vectors of two libraries.

use gauss_runtime::frames::FramePose;
use gauss_runtime::nalgebra::{Isometry3, Vector3};
use parry3d_f64::math::{Matrix, Pose, Rotation, Vector};

pub(crate) fn vector(v: Vector) -> Vector3<f64> {
    Vector3::new(v.x, v.y, v.z)
}

pub(crate) fn pose(pose: &FramePose<f64>) -> Pose {
    let r = pose.rotation.matrix();
    let column = |k: usize| Vector::new(r[(0, k)], r[(1, k)], r[(2, k)]);
    let rotation = Rotation::from_mat3(&Matrix::from_cols(column(0), column(1), column(2)));
    let b = &pose.translation.vector;
    Pose::from_parts(Vector::new(b.x, b.y, b.z), rotation)
}

pub(crate) fn isometry(pose: &Isometry3<f64>) -> Pose {
    let (b, r) = (&pose.translation.vector, &pose.rotation.coords);
    Pose::from_parts(Vector::new(b.x, b.y, b.z), Rotation::from_xyzw(r.x, r.y, r.z, r.w))
}
