//! Exponential and logarithm of rigid motions, row by row.

use gauss_runtime::lie::se3;
use gauss_runtime::nalgebra::{IsometryMatrix3, Matrix3, Rotation3, SVector, Translation3, convert};
use gauss_runtime::prelude::Isometry3;
use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray2, PyReadonlyArray2};
use pyo3::prelude::*;

/// The numbers of a pose as a matrix of four rows.
fn matrix(pose: &Isometry3<f64>) -> [f64; 16] {
    let all = pose.to_homogeneous();
    std::array::from_fn(|k| all[(k / 4, k % 4)])
}

/// Poses, each 16 numbers of a matrix of four rows, of rows of six numbers: a translation and a rotation vector, as a
/// velocity that is constant in body axes goes on for a second.
#[pyfunction]
pub fn exp6<'py>(py: Python<'py>, increments: PyReadonlyArray2<'py, f64>) -> Bound<'py, PyArray2<f64>> {
    let rows = increments.as_array();
    let mut poses = Array2::zeros((rows.nrows(), 16));
    for (mut pose, row) in poses.rows_mut().into_iter().zip(rows.rows()) {
        let found = matrix(&se3::exp(&SVector::<f64, 6>::from_fn(|i, _| row[i])));
        pose.iter_mut().zip(found).for_each(|(number, own)| *number = own);
    }
    poses.into_pyarray(py)
}

/// The inverse: of each pose the shortest of these rows.
#[pyfunction]
pub fn log6<'py>(py: Python<'py>, poses: PyReadonlyArray2<'py, f64>) -> Bound<'py, PyArray2<f64>> {
    let rows = poses.as_array();
    let mut increments = Array2::zeros((rows.nrows(), 6));
    for (mut increment, row) in increments.rows_mut().into_iter().zip(rows.rows()) {
        let turn = Rotation3::from_matrix_unchecked(Matrix3::from_fn(|i, j| row[4 * i + j]));
        // R of a matrix as the nearest quaternion.
        let pose = convert(IsometryMatrix3::from_parts(Translation3::new(row[3], row[7], row[11]), turn));
        let found = se3::log(&pose);
        increment.iter_mut().zip(found.iter()).for_each(|(number, own)| *number = *own);
    }
    increments.into_pyarray(py)
}
