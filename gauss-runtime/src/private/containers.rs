//! nalgebra's containers as arrays and back, and products of increments; every function compiles to nothing.

use nalgebra::{Isometry2, Isometry3, SMatrix, SVector, UnitQuaternion};

use crate::configuration::Product;
use crate::real::Real;

/// The components of a vector.
#[inline(always)]
pub fn components<T: Real, const N: usize>(v: &SVector<T, N>) -> [T; N] {
    v.data.0[0]
}

/// The entries of a matrix as `entries[row][column]`.
#[inline(always)]
pub fn entries<T: Real, const R: usize, const C: usize>(m: &SMatrix<T, R, C>) -> [[T; C]; R] {
    core::array::from_fn(|row| core::array::from_fn(|column| m.data.0[column][row]))
}

/// A vector from its components.
#[inline(always)]
pub fn vector<T: Real, const N: usize>(components: [T; N]) -> SVector<T, N> {
    SVector::from(components)
}

/// A matrix from `entries[row][column]`.
#[inline(always)]
pub fn matrix<T: Real, const R: usize, const C: usize>(entries: [[T; C]; R]) -> SMatrix<T, R, C> {
    let columns: [[T; R]; C] = core::array::from_fn(|column| core::array::from_fn(|row| entries[row][column]));
    SMatrix::from(columns)
}

/// The components x, y, z, w of a unit quaternion.
#[inline(always)]
pub fn quaternion<T: Real>(q: &UnitQuaternion<T>) -> [T; 4] {
    crate::triple::quaternion(q)
}

/// The quaternion (x, y, z, w) and the translation b of a pose.
#[inline(always)]
pub fn isometry3<T: Real>(pose: &Isometry3<T>) -> ([T; 4], [T; 3]) {
    (quaternion(&pose.rotation), components(&pose.translation.vector))
}

/// `[cos θ, sin θ]` and the translation of a plane pose.
#[inline(always)]
pub fn isometry2<T: Real>(pose: &Isometry2<T>) -> ([T; 2], [T; 2]) {
    let rotation = pose.rotation.as_ref();
    ([rotation.re, rotation.im], components(&pose.translation.vector))
}

/// The increment of a pair of configurations from those of its factors.
#[inline(always)]
pub fn product<A, B>(first: A, second: B) -> Product<A, B> {
    Product { first, second }
}
