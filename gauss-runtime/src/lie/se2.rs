//! SE(2): motions of the plane k₁k₂, with body twists (u₁, u₂, ω).
//!
//! The rotation by θ is the unit complex number `cos θ + i sin θ`; plane vectors are complex numbers too, so that `i u`
//! is u turned by a right angle.

use nalgebra::{Complex, Isometry2, SVector, Translation, Unit, UnitComplex};

use super::coefficients;
use super::so3::norm_factor;
use crate::real::Real;

#[inline(always)]
pub(crate) fn rotation<T: Real>(cosine: T, sine: T) -> UnitComplex<T> {
    Unit::new_unchecked(Complex { re: cosine, im: sine })
}

#[inline(always)]
pub(crate) fn isometry<T: Real>(rotation: UnitComplex<T>, translation: [T; 2]) -> Isometry2<T> {
    Isometry2 { rotation, translation: Translation { vector: SVector::from(translation) } }
}

/// The rotation by ω and the displacement.
#[inline(always)]
fn exp_parts<T: Real>(sigma: &SVector<T, 3>) -> ([T; 2], [T; 2]) {
    let (sine, cosine) = sigma.data.0[0][2].sin_cos();
    ([cosine, sine], displacement(sigma))
}

/// The displacement `V u`, `V = sin ω/ω + i (1 − cos ω)/ω`.
#[inline(always)]
pub(super) fn displacement<T: Real>(sigma: &SVector<T, 3>) -> [T; 2] {
    let [u, v, omega] = sigma.data.0[0];
    let s = omega * omega;
    let (a, b) = (coefficients::sinc(s), omega * coefficients::versine(s));
    [a * u - b * v, b * u + a * v]
}

/// The plane motion of unit duration with the constant body twist σ = (u₁, u₂, ω).
#[inline]
pub fn exp<T: Real>(sigma: &SVector<T, 3>) -> Isometry2<T> {
    let ([cosine, sine], shift) = exp_parts(sigma);
    isometry(rotation(cosine, sine), shift)
}

/// The twist σ with |ω| ≤ π and `exp(σ)` the given motion: `u = V⁻¹ b`, `V⁻¹ = (ω/2) cot(ω/2) − i ω/2`.
#[inline]
pub fn log<T: Real>(pose: &Isometry2<T>) -> SVector<T, 3> {
    let turn = pose.rotation.as_ref();
    let [x, y] = pose.translation.vector.data.0[0];
    log_parts([turn.re, turn.im], [x, y])
}

#[inline(always)]
fn log_parts<T: Real>([cosine, sine]: [T; 2], [x, y]: [T; 2]) -> SVector<T, 3> {
    let omega = sine.atan2(cosine);
    let s = omega * omega;
    // (ω/2) cot(ω/2) = sin ω/ω · ω²/(2(1 − cos ω)): the quotient keeps its digits near π, where it vanishes.
    let versine = coefficients::versine(s);
    let (a, b) = (coefficients::sinc(s) / (versine + versine), T::ratio(1, 2) * omega);
    SVector::from([a * x + b * y, a * y - b * x, omega])
}

/// The Lie bracket `[(u, ω), (v, η)] = (ω i v − η i u, 0)`.
#[inline]
pub fn bracket<T: Real>(v: &SVector<T, 3>, w: &SVector<T, 3>) -> SVector<T, 3> {
    let ([a, b, omega], [c, d, eta]) = (v.data.0[0], w.data.0[0]);
    SVector::from([eta * b - omega * d, omega * c - eta * a, T::zero()])
}

/// `Ad w`: a body twist about O seen from the observer, about the pole Ω: `(R u − ω i b, ω)`.
#[inline]
pub fn adjoint<T: Real>(pose: &Isometry2<T>, w: &SVector<T, 3>) -> SVector<T, 3> {
    let turn = pose.rotation.as_ref();
    let ([u, v, omega], [x, y]) = (w.data.0[0], pose.translation.vector.data.0[0]);
    SVector::from([turn.re * u - turn.im * v + omega * y, turn.im * u + turn.re * v - omega * x, omega])
}

/// `w + ½[v, w] + c [v, [v, w]]`, c at the angle of v: exact, since `ad³ = −ω² ad`. See [`Configuration::dexp_inv`].
///
/// [`Configuration::dexp_inv`]: crate::configuration::Configuration::dexp_inv
#[inline]
pub fn dexp_inv<T: Real>(v: &SVector<T, 3>, w: &SVector<T, 3>) -> SVector<T, 3> {
    let omega = v.data.0[0][2];
    let c = coefficients::dexp_inv(omega * omega);
    let once = bracket(v, w);
    let twice = bracket(v, &once);
    let sum = |i: usize| c.fma(twice.data.0[0][i], T::ratio(1, 2).fma(once.data.0[0][i], w.data.0[0][i]));
    SVector::from([sum(0), sum(1), w.data.0[0][2]])
}

/// The map `w ↦ w − a [v, w] + b [v, [v, w]]`, a and b those of SO(3) at the angle of v: exact, since `ad³ = −ω² ad`.
/// See [`Configuration::dexp`].
///
/// [`Configuration::dexp`]: crate::configuration::Configuration::dexp
#[inline]
pub fn dexp<T: Real>(v: &SVector<T, 3>) -> impl Fn(&SVector<T, 3>) -> SVector<T, 3> + use<T> {
    let v = *v;
    let omega = v.data.0[0][2];
    let s = omega * omega;
    let (a, b) = (coefficients::versine(s), coefficients::cubic(s));
    move |w| {
        let once = bracket(&v, w);
        let twice = bracket(&v, &once);
        let sum = |i: usize| b.fma(twice.data.0[0][i], (-a).fma(once.data.0[0][i], w.data.0[0][i]));
        SVector::from([sum(0), sum(1), w.data.0[0][2]])
    }
}

/// `q ∘ exp(σ)`.
#[inline]
pub fn retract<T: Real>(pose: &Isometry2<T>, sigma: &SVector<T, 3>) -> Isometry2<T> {
    let ([cosine, sine], [dx, dy]) = exp_parts(sigma);
    let turn = pose.rotation.as_ref();
    let [x, y] = pose.translation.vector.data.0[0];
    isometry(
        rotation(turn.re * cosine - turn.im * sine, turn.re * sine + turn.im * cosine),
        [x + (turn.re * dx - turn.im * dy), y + (turn.im * dx + turn.re * dy)],
    )
}

/// `q ∘ exp(σ)`, held at norm 1 (see [`so3::advance`](super::so3::advance)).
#[inline]
pub fn advance<T: Real>(pose: &Isometry2<T>, sigma: &SVector<T, 3>) -> Isometry2<T> {
    let turn = pose.rotation.as_ref();
    let [_, _, omega] = sigma.data.0[0];
    let s = omega * omega;
    // exp(iω) − 1.
    let (re, im) = (-(s * coefficients::versine(s)), omega * coefficients::sinc(s));
    let [dx, dy] = displacement(sigma);
    let ([x, y], [c_re, c_im]) = (pose.translation.vector.data.0[0], norm_correction([turn.re, turn.im]));
    isometry(
        rotation(turn.re + (turn.re * re - turn.im * im + c_re), turn.im + (turn.re * im + turn.im * re + c_im)),
        [x + (turn.re * dx - turn.im * dy), y + (turn.im * dx + turn.re * dy)],
    )
}

/// The change that brings the norm of a complex number back to 1, to first order.
#[inline(always)]
pub(crate) fn norm_correction<T: Real>([re, im]: [T; 2]) -> [T; 2] {
    let half = T::ratio(1, 2) * (T::one() - re.fma(re, im * im));
    [half * re, half * im]
}

/// `log(p⁻¹ ∘ q)`.
#[inline]
pub fn difference<T: Real>(from: &Isometry2<T>, to: &Isometry2<T>) -> SVector<T, 3> {
    let (p, q) = (from.rotation.as_ref(), to.rotation.as_ref());
    let ([x, y], [x1, y1]) = (from.translation.vector.data.0[0], to.translation.vector.data.0[0]);
    let (dx, dy) = (x1 - x, y1 - y);
    log_parts([p.re * q.re + p.im * q.im, p.re * q.im - p.im * q.re], [p.re * dx + p.im * dy, p.re * dy - p.im * dx])
}

/// Brings the complex number back to norm 1, without bias (see [`so3::renormalise`](super::so3::renormalise)).
#[inline]
pub fn renormalise<T: Real>(pose: &Isometry2<T>) -> Isometry2<T> {
    let turn = pose.rotation.as_ref();
    let factor = norm_factor(T::one() - turn.re.fma(turn.re, turn.im * turn.im));
    Isometry2 {
        rotation: rotation(turn.re.fma(factor, turn.re), turn.im.fma(factor, turn.im)),
        translation: pose.translation,
    }
}
