//! SO(3): rotations as unit quaternions, body to observer.

use nalgebra::{SVector, UnitQuaternion};

use super::coefficients;
use crate::real::Real;
use crate::triple::{axpy, compose, conjugate, cross, dot, quaternion, scaled, triple, unit_quaternion};

/// The rotation by the angle |σ| (rad) about σ: the quaternion `(sin(θ/2) σ/θ, cos(θ/2))`.
#[inline]
pub fn exp<T: Real>(sigma: &SVector<T, 3>) -> UnitQuaternion<T> {
    unit_quaternion(exp_components(triple(sigma)))
}

#[inline(always)]
pub(super) fn exp_components<T: Real>(sigma: [T; 3]) -> [T; 4] {
    let (sinc, cosine) = coefficients::sinc_cos(T::ratio(1, 4) * dot(sigma, sigma));
    let [x, y, z] = scaled(T::ratio(1, 2) * sinc, sigma);
    [x, y, z, cosine]
}

/// The rotation vector of smallest length, |σ| ≤ π, with `exp(σ)` the given rotation.
///
/// By atan2 of the vector part against the scalar part: full precision from the identity to half a turn, where of the
/// two opposite answers the one along the quaternion's vector part is given (against it when w < 0).
#[inline]
pub fn log<T: Real>(rotation: &UnitQuaternion<T>) -> SVector<T, 3> {
    SVector::from(log_components(quaternion(rotation)))
}

#[inline(always)]
pub(super) fn log_components<T: Real>(q: [T; 4]) -> [T; 3] {
    let vector = [q[0], q[1], q[2]];
    // q and −q are the same rotation: the one with w ≥ 0 turns by at most π.
    let sign = T::select_lt(q[3], T::zero(), -T::one(), T::one());
    let w = sign * q[3];
    let square = dot(vector, vector);
    let ratio = square / (w * w);
    let near = coefficients::arctangent_ratio(ratio) / w;
    let norm = square.sqrt();
    let far = norm.atan2(w) / norm;
    let half = T::select_lt(ratio, T::ratio(1, 64), near, far);
    scaled(sign * (half + half), vector)
}

/// The Lie bracket `[v, w] = v × w`.
#[inline]
pub fn bracket<T: Real>(v: &SVector<T, 3>, w: &SVector<T, 3>) -> SVector<T, 3> {
    SVector::from(cross(triple(v), triple(w)))
}

/// `Ad_R w = R w`: a body angular velocity seen from the observer.
#[inline]
pub fn adjoint<T: Real>(rotation: &UnitQuaternion<T>, w: &SVector<T, 3>) -> SVector<T, 3> {
    SVector::from(crate::triple::rotate(quaternion(rotation), triple(w)))
}

/// `w + ½ v×w + c v×(v×w)`, `c = (1 − (θ/2) cot(θ/2))/θ²`, θ = |v|: see [`Configuration::dexp_inv`].
///
/// [`Configuration::dexp_inv`]: crate::configuration::Configuration::dexp_inv
#[inline]
pub fn dexp_inv<T: Real>(v: &SVector<T, 3>, w: &SVector<T, 3>) -> SVector<T, 3> {
    let (v, w) = (triple(v), triple(w));
    let c = coefficients::dexp_inv(dot(v, v));
    let once = cross(v, w);
    SVector::from(axpy(c, cross(v, once), axpy(T::ratio(1, 2), once, w)))
}

/// The map `w ↦ w − a v×w + b v×(v×w)`, `a = (1 − cos θ)/θ²`, `b = (θ − sin θ)/θ³`, θ = |v|: see
/// [`Configuration::dexp`].
///
/// [`Configuration::dexp`]: crate::configuration::Configuration::dexp
#[inline]
pub fn dexp<T: Real>(v: &SVector<T, 3>) -> impl Fn(&SVector<T, 3>) -> SVector<T, 3> + use<T> {
    let v = triple(v);
    let s = dot(v, v);
    let (a, b) = (coefficients::versine(s), coefficients::cubic(s));
    move |w| {
        let w = triple(w);
        let once = cross(v, w);
        SVector::from(axpy(b, cross(v, once), axpy(-a, once, w)))
    }
}

/// `q ∘ exp(σ)`.
#[inline]
pub fn retract<T: Real>(rotation: &UnitQuaternion<T>, sigma: &SVector<T, 3>) -> UnitQuaternion<T> {
    unit_quaternion(compose(quaternion(rotation), exp_components(triple(sigma))))
}

/// `q ∘ exp(σ)`, held at norm 1: the end of a step.
///
/// The change `q ∘ (exp(σ) − 1)` and what brings the norm of q back are summed before they are rounded. A correction
/// that is rounded on its own is a few units in the last place, the same ones whenever the motion comes by: momenta in
/// space would drift in proportion to time.
#[inline]
pub fn advance<T: Real>(rotation: &UnitQuaternion<T>, sigma: &SVector<T, 3>) -> UnitQuaternion<T> {
    unit_quaternion(turned(quaternion(rotation), less_one(triple(sigma))))
}

/// `exp(σ) − 1`. The scalar part cos(θ/2) − 1 must not be formed by that difference.
#[inline(always)]
pub(super) fn less_one<T: Real>(sigma: [T; 3]) -> [T; 4] {
    let s = T::ratio(1, 4) * dot(sigma, sigma);
    let [x, y, z] = scaled(T::ratio(1, 2) * coefficients::sinc(s), sigma);
    [x, y, z, -(s * coefficients::versine(s))]
}

/// `q ∘ (1 + step)`, held at norm 1.
#[doc(hidden)]
#[inline(always)]
pub fn turned<T: Real>(q: [T; 4], step: [T; 4]) -> [T; 4] {
    let (change, correction) = (compose(q, step), norm_correction(q));
    core::array::from_fn(|i| q[i] + (change[i] + correction[i]))
}

/// The change that brings the norm of q back to 1, to first order: `½(1 − |q|²) q`.
#[inline(always)]
pub(crate) fn norm_correction<T: Real>(q: [T; 4]) -> [T; 4] {
    let half = T::ratio(1, 2) * defect(q);
    q.map(|c| half * c)
}

#[inline(always)]
fn defect<T: Real>(q: [T; 4]) -> T {
    T::one() - q.iter().fold(T::zero(), |sum, &c| c.fma(c, sum))
}

/// `log(p⁻¹ ∘ q)`.
#[inline]
pub fn difference<T: Real>(from: &UnitQuaternion<T>, to: &UnitQuaternion<T>) -> SVector<T, 3> {
    SVector::from(log_components(compose(conjugate(quaternion(from)), quaternion(to))))
}

/// `½ q ∘ (ω, 0)`: the rates of the components of a quaternion. They are normal to q, so that |q| stays what it is.
#[inline(always)]
pub(crate) fn component_rates<T: Real>(q: [T; 4], omega: [T; 3]) -> [T; 4] {
    let half = scaled(T::ratio(1, 2), omega);
    let vector = [q[0], q[1], q[2]];
    let [x, y, z] = axpy(q[3], half, cross(vector, half));
    [x, y, z, -dot(vector, half)]
}

/// `2 Im(q̄ ∘ e)`: the body rotation that changes the components of a unit quaternion by e.
#[inline(always)]
pub(crate) fn tangent<T: Real>(q: [T; 4], change: [T; 4]) -> [T; 3] {
    let [x, y, z, _] = compose(conjugate(q), change);
    [x + x, y + y, z + z]
}

/// Brings the norm back to 1.
///
/// Near norm 1 each component gets the correction `q·½(1 − |q|²)` *added*, so that it is rounded to nearest: dividing
/// by a rounded norm shrinks on average, because floating-point numbers lie twice as densely below 1 as above. A norm
/// that is right up to rounding is left alone, because so small a correction, rounded, would turn as much as it mends:
/// steps hold the norm before they round ([`advance`]).
#[inline]
pub fn renormalise<T: Real>(rotation: &UnitQuaternion<T>) -> UnitQuaternion<T> {
    let q = quaternion(rotation);
    // A NaN, which counts as far, is none the worse for it.
    let far = |q: [T; 4]| !T::all_lt(defect(q).abs(), T::ratio(1, 2));
    let brought = |q: [T; 4]| {
        let factor = norm_factor(defect(q));
        q.map(|c| c.fma(factor, c))
    };
    let once = brought(q);
    // From far away the factor is −1 and a little, whose rounding is left.
    unit_quaternion(if far(q) { brought(once) } else { once })
}

/// `1/√(1 − defect) − 1`; to first order where the second order is below rounding, and 0 where the defect is the
/// rounding of four components and of the sum of their squares.
#[inline(always)]
pub(super) fn norm_factor<T: Real>(defect: T) -> T {
    let rounding = T::from_f64(4.0 * T::EPSILON);
    let defect = T::select_lt(defect * defect, rounding * rounding, T::zero(), defect);
    let half = T::ratio(1, 2) * defect;
    // Σ from the second order on: 3/8 d² + 5/16 d³ + …
    let near = half.omitting(half * defect / (T::one() - defect));
    // Nearly always so: nothing should wait for the root then.
    if T::all_lt(defect * defect, T::from_f64(T::EPSILON)) {
        near
    } else {
        T::select_lt(defect * defect, T::from_f64(T::EPSILON), near, far_correction(defect))
    }
}

/// Not inlined, because compilers would work it out in advance.
#[cold]
#[inline(never)]
fn far_correction<T: Real>(defect: T) -> T {
    (T::one() - defect).sqrt().recip() - T::one()
}
