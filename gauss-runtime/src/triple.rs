//! Vectors of three components and quaternions as plain arrays: the few products that rigid bodies need.
//!
//! A quaternion is `[x, y, z, w]`, nalgebra's order of storage; `w` is the scalar part.

use nalgebra::{Quaternion, SVector, Unit, UnitQuaternion};

use crate::real::Real;

/// A vector of ordinary space; its frame is named where it is used.
pub type Triple<T> = [T; 3];

/// The components of a vector.
#[inline(always)]
pub fn triple<T: Real>(v: &SVector<T, 3>) -> Triple<T> {
    v.data.0[0]
}

/// a · b.
#[inline(always)]
pub fn dot<T: Real>(a: Triple<T>, b: Triple<T>) -> T {
    a[0].fma(b[0], a[1].fma(b[1], a[2] * b[2]))
}

/// a × b.
#[inline(always)]
pub fn cross<T: Real>(a: Triple<T>, b: Triple<T>) -> Triple<T> {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// a + b.
#[inline(always)]
pub fn add<T: Real>(a: Triple<T>, b: Triple<T>) -> Triple<T> {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// a − b.
#[inline(always)]
pub fn sub<T: Real>(a: Triple<T>, b: Triple<T>) -> Triple<T> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// s a.
#[inline(always)]
pub fn scaled<T: Real>(s: T, a: Triple<T>) -> Triple<T> {
    [s * a[0], s * a[1], s * a[2]]
}

/// `y + s·x`.
#[inline(always)]
pub fn axpy<T: Real>(s: T, x: Triple<T>, y: Triple<T>) -> Triple<T> {
    [s.fma(x[0], y[0]), s.fma(x[1], y[1]), s.fma(x[2], y[2])]
}

/// The components x, y, z, w of a rotation.
#[inline(always)]
pub fn quaternion<T: Real>(q: &UnitQuaternion<T>) -> [T; 4] {
    q.as_ref().coords.data.0[0]
}

/// The rotation with the components x, y, z, w, which are of norm 1.
#[inline(always)]
pub fn unit_quaternion<T: Real>(q: [T; 4]) -> UnitQuaternion<T> {
    Unit::new_unchecked(Quaternion { coords: SVector::from(q) })
}

/// Hamilton's product `a ∘ b`.
#[inline(always)]
pub fn compose<T: Real>(a: [T; 4], b: [T; 4]) -> [T; 4] {
    let (u, v) = ([a[0], a[1], a[2]], [b[0], b[1], b[2]]);
    let [x, y, z] = axpy(a[3], v, axpy(b[3], u, cross(u, v)));
    [x, y, z, a[3] * b[3] - dot(u, v)]
}

/// The inverse of a unit quaternion.
#[inline(always)]
pub fn conjugate<T: Real>(q: [T; 4]) -> [T; 4] {
    [-q[0], -q[1], -q[2], q[3]]
}

/// `R(q) v` for a unit quaternion: `v + 2w(n×v) + 2n×(n×v)`, `n` the vector part.
#[inline(always)]
pub fn rotate<T: Real>(q: [T; 4], v: Triple<T>) -> Triple<T> {
    let n = [q[0], q[1], q[2]];
    let twice = cross(n, v);
    let twice = add(twice, twice);
    add(axpy(q[3], twice, v), cross(n, twice))
}

/// `R(q)ᵀ v`.
#[inline(always)]
pub fn rotate_back<T: Real>(q: [T; 4], v: Triple<T>) -> Triple<T> {
    rotate(conjugate(q), v)
}

/// Euclidean norm of the value parts, the largest over the lanes; NaN when a lane is NaN.
pub fn norm<T: Real>(components: &[T]) -> f64 {
    let mut largest = 0.0_f64;
    for lane in 0..T::LANES {
        let square: f64 = components.iter().map(|c| c.lane(lane) * c.lane(lane)).sum();
        if square.is_nan() {
            return f64::NAN;
        }
        largest = largest.max(square);
    }
    Real::sqrt(largest)
}

/// Euclidean norm of the value parts, lane by lane.
#[inline(always)]
pub fn lengths<T: Real>(components: &[T]) -> T {
    components.iter().fold(T::zero(), |sum, &c| sum + c * c).sqrt()
}
