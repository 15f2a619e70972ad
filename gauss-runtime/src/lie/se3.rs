//! SE(3): poses (R, b), `x̂ = R x + b`, and body twists (u, ω) about the pole O, in this order.
//!
//! The algebra of SE(3) is that of SO(3) over dual numbers, `ω + ε u` with ε² = 0 (Clifford; Study). So the angular
//! rows of every formula are those of [`so3`](super::so3), and the linear rows are their derivative in the direction u:
//! this is how [`dexp_inv`] is built, without a 6×6 matrix.

use nalgebra::{Isometry3, SVector, Translation, UnitQuaternion};

use super::coefficients;
use super::so3::{exp_components, less_one, log_components, turned};
use crate::real::Real;
use crate::triple::{
    add, axpy, compose, conjugate, cross, dot, quaternion, rotate, rotate_back, sub, triple, unit_quaternion,
};

/// Linear and angular part of a twist.
#[doc(hidden)]
#[inline(always)]
pub fn split<T: Real>(twist: &SVector<T, 6>) -> ([T; 3], [T; 3]) {
    let [a, b, c, d, e, f] = twist.data.0[0];
    ([a, b, c], [d, e, f])
}

/// The twist of a linear and an angular part.
#[doc(hidden)]
#[inline(always)]
pub fn join<T: Real>(linear: [T; 3], angular: [T; 3]) -> SVector<T, 6> {
    let ([a, b, c], [d, e, f]) = (linear, angular);
    SVector::from([a, b, c, d, e, f])
}

#[inline(always)]
pub(crate) fn isometry<T: Real>(rotation: UnitQuaternion<T>, translation: [T; 3]) -> Isometry3<T> {
    Isometry3 { rotation, translation: Translation { vector: SVector::from(translation) } }
}

/// The translation of `exp(u, ω)`: `V u` with `V = 1 + (1−cos θ)/θ² [ω]× + (θ−sin θ)/θ³ [ω]×²`.
#[inline(always)]
pub(super) fn displacement<T: Real>(u: [T; 3], omega: [T; 3]) -> [T; 3] {
    let s = dot(omega, omega);
    let once = cross(omega, u);
    axpy(coefficients::cubic(s), cross(omega, once), axpy(coefficients::versine(s), once, u))
}

/// The screw motion of unit duration with the constant body twist σ = (u, ω).
#[inline]
pub fn exp<T: Real>(sigma: &SVector<T, 6>) -> Isometry3<T> {
    let (u, omega) = split(sigma);
    isometry(unit_quaternion(exp_components(omega)), displacement(u, omega))
}

/// The twist σ of smallest rotation, |ω| ≤ π, with `exp(σ)` the given pose: `u = V⁻¹ b`,
/// `V⁻¹ = 1 − ½ [ω]× + (1 − (θ/2) cot(θ/2))/θ² [ω]×²`.
#[inline]
pub fn log<T: Real>(pose: &Isometry3<T>) -> SVector<T, 6> {
    log_parts(quaternion(&pose.rotation), triple(&pose.translation.vector))
}

#[inline(always)]
fn log_parts<T: Real>(rotation: [T; 4], b: [T; 3]) -> SVector<T, 6> {
    let omega = log_components(rotation);
    let once = cross(omega, b);
    let c = coefficients::dexp_inv(dot(omega, omega));
    join(axpy(c, cross(omega, once), axpy(-T::ratio(1, 2), once, b)), omega)
}

/// The Lie bracket `[(u, ω), (v, η)] = (ω×v + u×η, ω×η)`.
#[inline]
pub fn bracket<T: Real>(v: &SVector<T, 6>, w: &SVector<T, 6>) -> SVector<T, 6> {
    let ((v_u, v_o), (w_u, w_o)) = (split(v), split(w));
    join(add(cross(v_o, w_u), cross(v_u, w_o)), cross(v_o, w_o))
}

/// `Ad_(R,b) (u, ω) = (R u + b × R ω, R ω)`: a body twist about O seen from the observer, about the pole Ω.
#[inline]
pub fn adjoint<T: Real>(pose: &Isometry3<T>, w: &SVector<T, 6>) -> SVector<T, 6> {
    let (u, omega) = split(w);
    let rotation = quaternion(&pose.rotation);
    let angular = rotate(rotation, omega);
    join(add(rotate(rotation, u), cross(triple(&pose.translation.vector), angular)), angular)
}

/// See [`Configuration::dexp_inv`]. With σ = (v, ω), w = (w_u, w_ω), c(θ²) the coefficient of SO(3) and c′ its
/// derivative:
///
/// - angular: `w_ω + ½ ω×w_ω + c ω×(ω×w_ω)`
/// - linear: `w_u + ½(ω×w_u + v×w_ω) + c[ω×(ω×w_u + v×w_ω) + v×(ω×w_ω)] + 2c′(ω·v) ω×(ω×w_ω)`
///
/// [`Configuration::dexp_inv`]: crate::configuration::Configuration::dexp_inv
#[inline]
pub fn dexp_inv<T: Real>(sigma: &SVector<T, 6>, w: &SVector<T, 6>) -> SVector<T, 6> {
    let ((v, omega), (w_u, w_o)) = (split(sigma), split(w));
    let s = dot(omega, omega);
    let (c, half) = (coefficients::dexp_inv(s), T::ratio(1, 2));
    let turn = dot(omega, v);
    let derivative = coefficients::dexp_inv_derivative(s) * (turn + turn);

    let once = cross(omega, w_o);
    let twice = cross(omega, once);
    let once_linear = add(cross(omega, w_u), cross(v, w_o));
    let twice_linear = add(cross(omega, once_linear), cross(v, once));

    let angular = axpy(c, twice, axpy(half, once, w_o));
    let linear = axpy(derivative, twice, axpy(c, twice_linear, axpy(half, once_linear, w_u)));
    join(linear, angular)
}

/// See [`Configuration::dexp`]. With σ = (v, ω), w = (w_u, w_ω), a(θ²) and b(θ²) the coefficients of SO(3), a′ and b′
/// their derivatives:
///
/// - angular: `w_ω − a ω×w_ω + b ω×(ω×w_ω)`
/// - linear: `w_u − a(ω×w_u + v×w_ω) + b[ω×(ω×w_u + v×w_ω) + v×(ω×w_ω)] + 2(ω·v)[b′ ω×(ω×w_ω) − a′ ω×w_ω]`
///
/// [`Configuration::dexp`]: crate::configuration::Configuration::dexp
#[inline]
pub fn dexp<T: Real>(sigma: &SVector<T, 6>) -> impl Fn(&SVector<T, 6>) -> SVector<T, 6> + use<T> {
    let (v, omega) = split(sigma);
    let s = dot(omega, omega);
    let (a, b) = (coefficients::versine(s), coefficients::cubic(s));
    let turn = dot(omega, v);
    let twofold = turn + turn;
    let slopes = (coefficients::versine_derivative(s) * twofold, coefficients::cubic_derivative(s) * twofold);
    move |w| {
        let (w_u, w_o) = split(w);
        let once = cross(omega, w_o);
        let twice = cross(omega, once);
        let once_linear = add(cross(omega, w_u), cross(v, w_o));
        let twice_linear = add(cross(omega, once_linear), cross(v, once));

        let angular = axpy(b, twice, axpy(-a, once, w_o));
        let linear = axpy(b, twice_linear, axpy(-a, once_linear, w_u));
        join(axpy(slopes.1, twice, axpy(-slopes.0, once, linear)), angular)
    }
}

/// `q ∘ exp(σ)`: `(R exp(ω), b + R V u)`.
#[inline]
pub fn retract<T: Real>(pose: &Isometry3<T>, sigma: &SVector<T, 6>) -> Isometry3<T> {
    let (u, omega) = split(sigma);
    let rotation = quaternion(&pose.rotation);
    let shift = rotate(rotation, displacement(u, omega));
    isometry(unit_quaternion(compose(rotation, exp_components(omega))), add(triple(&pose.translation.vector), shift))
}

/// `q ∘ exp(σ)` with its rotation held at norm 1 (see [`so3::advance`](super::so3::advance)).
#[inline]
pub fn advance<T: Real>(pose: &Isometry3<T>, sigma: &SVector<T, 6>) -> Isometry3<T> {
    let (u, omega) = split(sigma);
    let rotation = quaternion(&pose.rotation);
    let shift = rotate(rotation, displacement(u, omega));
    isometry(unit_quaternion(turned(rotation, less_one(omega))), add(triple(&pose.translation.vector), shift))
}

/// `log(p⁻¹ ∘ q)`.
#[inline]
pub fn difference<T: Real>(from: &Isometry3<T>, to: &Isometry3<T>) -> SVector<T, 6> {
    let rotation = quaternion(&from.rotation);
    let between = sub(triple(&to.translation.vector), triple(&from.translation.vector));
    log_parts(compose(conjugate(rotation), quaternion(&to.rotation)), rotate_back(rotation, between))
}
