//! Configurations of a system, which are elements of groups, and the linear spaces of their increments.
//!
//! | configuration | increment (`Tangent`) | `retract` |
//! |---|---|---|
//! | [`Isometry3`] (R, b): a pose, body to observer | body twist × time (u, ω), pole O | right multiplication by exp on SE(3) |
//! | [`UnitQuaternion`] R | ω × time, body frame | right multiplication by exp on SO(3) |
//! | [`Isometry2`] | (u₁, u₂, ω) × time, body frame | right multiplication by exp on SE(2) |
//! | [`SVector`] | itself | addition |
//! | pairs `(A, B)`, also of pairs | [`Product`] | each by itself |
//!
//! All increments are *left-trivialised*: they are seen from the body, `q ↦ q ∘ exp(σ)`.

mod check;
mod vectors_and_pairs;

use core::fmt::Debug;

use nalgebra::{Isometry2, Isometry3, SVector, UnitQuaternion};

use crate::lie::{carried, se2, se3, so3};
use crate::real::Real;
use crate::triple::{lengths, norm, quaternion, rotate, rotate_back, triple, unit_quaternion};

#[cfg(feature = "serde")]
pub(crate) use check::all_finite;
pub use check::{StateError, check};

pub(crate) use crate::vector_space::add_carrying;
pub use crate::vector_space::{Product, VectorSpace};

/// A point of a configuration space that is a Lie group, with the functions that integrators move it by.
///
/// With `exp` the exponential map of the group and increments seen from the body,
/// `q.retract(σ) = q ∘ exp(σ)` and `p.difference(q) = log(p⁻¹ ∘ q)`.
pub trait Configuration: Copy + Debug {
    /// The scalar of the components.
    type Scalar: Real;

    /// The Lie algebra: increments, and velocities per unit of time.
    type Tangent: VectorSpace<Self::Scalar>;

    /// The numbers that a configuration consists of: the linear space in which the group lies, and in which
    /// [`RungeKutta`](crate::integrate::RungeKutta) works.
    type Components: VectorSpace<Self::Scalar>;

    /// `self ∘ exp(tangent)`. Of a pair the increment is a [`Product`], which a flat vector becomes by `.into()`; of a
    /// whole state, speeds and all, [`Increments`](crate::increments::Increments) take flat vectors as they are.
    fn retract(&self, tangent: &Self::Tangent) -> Self;

    /// `self ∘ exp(tangent)`, held at norm 1: the end of a step. What holds the norm is added before the sum is
    /// rounded, so that it does no harm over long runs (see [`lie::so3::advance`](crate::lie::so3::advance)).
    fn advance(&self, tangent: &Self::Tangent) -> Self {
        self.retract(tangent).renormalise()
    }

    /// `meant ∘ exp(tangent)`, brought back to norm 1, where `meant = self ∘ exp(carried)` is known beyond the
    /// precision of `self`; `carried` becomes that of the result: see [`lie::carried`](crate::lie::carried). Where this
    /// is not written, nothing is carried.
    fn retract_carrying(&self, tangent: &Self::Tangent, carried: &mut Self::Tangent) -> Self {
        let _ = carried;
        self.advance(tangent)
    }

    /// The shortest increment from `self` to `other`: `self.retract(&self.difference(other))` is `other`.
    fn difference(&self, other: &Self) -> Self::Tangent;

    /// The inverse of the left-trivialised differential of exp at `v`, applied to `w`.
    ///
    /// If `q(t) = q₀ ∘ exp(σ(t))` moves with the body velocity `w`, then `σ̇ = dexp_inv(σ, w)`:
    ///
    /// `dexp_inv(v, w) = Σ_k (−1)ᵏ B_k/k! ad_vᵏ w = w + ½ [v, w] + ¹⁄₁₂ [v, [v, w]] − …`  (B₁ = −½)
    ///
    /// The sign of the ½ is that of increments on the right; with increments on the left it would be −½.
    fn dexp_inv(v: &Self::Tangent, w: &Self::Tangent) -> Self::Tangent;

    /// The Lie bracket `[v, w] = ad_v w`, of increments on the right. Where it is not written it is twice the odd part
    /// of [`dexp_inv`](Self::dexp_inv) in v: all its further terms are even.
    fn bracket(v: &Self::Tangent, w: &Self::Tangent) -> Self::Tangent {
        let back = Self::dexp_inv(&v.scale(-Self::Scalar::one()), w);
        Self::dexp_inv(v, w).add_scaled(-Self::Scalar::one(), &back)
    }

    /// The left-trivialised differential of exp at `v`, a linear map of increments: the inverse of
    /// [`dexp_inv`](Self::dexp_inv), without its poles. What depends on `v` alone is worked out once.
    ///
    /// If σ moves with the rate w then `q₀ ∘ exp(σ)` moves with the body velocity `dexp(σ)(w)`:
    ///
    /// `dexp(v)(w) = Σ_k (−1)ᵏ/(k+1)! ad_vᵏ w = w − ½ [v, w] + ¹⁄₆ [v, [v, w]] − …`
    ///
    /// Where it is not written the series is summed, to rounding for increments that turn by up to π.
    fn dexp(v: &Self::Tangent) -> impl Fn(&Self::Tangent) -> Self::Tangent {
        // πᵏ/(k+1)! is below 1e-18 (1e-34) of the sum from these on.
        let terms = if Self::Scalar::EPSILON > 1e-17 { 30 } else { 46 };
        move |w| {
            let (mut term, mut sum) = (*w, *w);
            for k in 1..=terms {
                term = Self::bracket(v, &term).scale(Self::Scalar::ratio(-1, k + 1));
                sum = sum.add_scaled(Self::Scalar::one(), &term);
            }
            sum
        }
    }

    /// The components.
    fn components(&self) -> Self::Components;

    /// The configuration with these components, even where they are off the group: [`renormalise`](Self::renormalise)
    /// brings them back.
    fn from_components(components: &Self::Components) -> Self;

    /// The time derivatives of the components when the configuration moves with the left-trivialised `velocity`:
    /// `d/dt components(q ∘ exp(t·velocity))` at t = 0.
    ///
    /// Stages of a step are slightly off the group. There any smooth continuation will do whose flow stays on the group
    /// when it starts there; a product of the components and the velocity, as for quaternions `½ q ∘ (ω, 0)`, is one.
    fn component_rates(&self, velocity: &Self::Tangent) -> Self::Components;

    /// The left-trivialised increment that changes the components by `change`, to first order in it; what leads off the
    /// group is dropped. `q.tangent(&q.component_rates(&v))` is v.
    fn tangent(&self, change: &Self::Components) -> Self::Tangent;

    /// Whether every component is finite.
    fn is_finite(&self) -> bool;

    /// The unit of component `i` where all else is in units of the SI, `"1"` of a pure number; empty where the scene
    /// decides, as of a plain coordinate.
    #[must_use]
    fn component_unit(i: usize) -> &'static str {
        let _ = i;
        ""
    }

    /// The unit of component `i` of an increment per time; empty where the scene decides.
    #[must_use]
    fn rate_unit(i: usize) -> &'static str {
        let _ = i;
        ""
    }

    /// The change of the components that brings norms back to 1, to first order: what a method that works on components
    /// adds to the change of a step before it is rounded, as [`advance`](Self::advance) does. Zero where there is
    /// nothing to keep.
    fn norm_correction(&self) -> Self::Components {
        Self::Components::zero()
    }

    /// The nearest valid configuration: a unit quaternion is brought back to norm 1 without bias, and left alone where
    /// its norm is 1 up to rounding. The identity where there is nothing to keep.
    fn renormalise(&self) -> Self {
        *self
    }

    /// The angle in radians by which an increment turns: the largest over factors and lanes; 0 where nothing turns.
    ///
    /// Beyond π the increment is no longer the shortest, and near 2π `dexp_inv` is singular: integrators refuse it.
    fn increment_angle(tangent: &Self::Tangent) -> f64 {
        let _ = tangent;
        0.0
    }

    /// [`increment_angle`](Self::increment_angle) of every lane by itself. Where it is not written it is the largest
    /// one in all of them.
    #[inline]
    fn increment_angles(tangent: &Self::Tangent) -> Self::Scalar {
        Self::Scalar::from_f64(Self::increment_angle(tangent))
    }

    /// The size against which an error in component `i` of an increment is relative: 1 for rotations, the distance from
    /// the origin for translations, the value itself for a plain coordinate. The largest over the lanes.
    fn magnitude(&self, i: usize) -> f64;

    /// [`magnitude`](Self::magnitude) of every lane by itself. Where it is not written it is the largest one in all of
    /// them.
    #[inline]
    fn magnitudes(&self, i: usize) -> Self::Scalar {
        Self::Scalar::from_f64(self.magnitude(i))
    }
}

impl<T: Real> Configuration for UnitQuaternion<T> {
    type Scalar = T;
    type Tangent = SVector<T, 3>;
    type Components = SVector<T, 4>;

    #[inline(always)]
    fn retract(&self, tangent: &Self::Tangent) -> Self {
        so3::retract(self, tangent)
    }

    #[inline(always)]
    fn advance(&self, tangent: &Self::Tangent) -> Self {
        so3::advance(self, tangent)
    }

    #[inline(always)]
    fn retract_carrying(&self, tangent: &Self::Tangent, low: &mut Self::Tangent) -> Self {
        carried::rotation(self, tangent, low)
    }

    #[inline(always)]
    fn difference(&self, other: &Self) -> Self::Tangent {
        so3::difference(self, other)
    }

    #[inline(always)]
    fn dexp_inv(v: &Self::Tangent, w: &Self::Tangent) -> Self::Tangent {
        so3::dexp_inv(v, w)
    }

    #[inline(always)]
    fn bracket(v: &Self::Tangent, w: &Self::Tangent) -> Self::Tangent {
        so3::bracket(v, w)
    }

    #[inline(always)]
    fn dexp(v: &Self::Tangent) -> impl Fn(&Self::Tangent) -> Self::Tangent {
        so3::dexp(v)
    }

    /// x, y, z, w: i, j, k first.
    #[inline(always)]
    fn components(&self) -> Self::Components {
        self.as_ref().coords
    }

    #[inline(always)]
    fn from_components(components: &Self::Components) -> Self {
        unit_quaternion(components.data.0[0])
    }

    #[inline(always)]
    fn component_rates(&self, velocity: &Self::Tangent) -> Self::Components {
        SVector::from(so3::component_rates(quaternion(self), triple(velocity)))
    }

    #[inline(always)]
    fn tangent(&self, change: &Self::Components) -> Self::Tangent {
        SVector::from(so3::tangent(quaternion(self), change.data.0[0]))
    }

    fn component_unit(_: usize) -> &'static str {
        "1"
    }

    fn rate_unit(_: usize) -> &'static str {
        "rad/s"
    }

    #[inline]
    fn is_finite(&self) -> bool {
        quaternion(self).iter().all(|c| c.is_finite())
    }

    #[inline(always)]
    fn norm_correction(&self) -> Self::Components {
        SVector::from(so3::norm_correction(quaternion(self)))
    }

    #[inline(always)]
    fn renormalise(&self) -> Self {
        so3::renormalise(self)
    }

    #[inline]
    fn increment_angle(tangent: &Self::Tangent) -> f64 {
        norm(&tangent.data.0[0])
    }

    #[inline(always)]
    fn increment_angles(tangent: &Self::Tangent) -> T {
        lengths(&tangent.data.0[0])
    }

    #[inline]
    fn magnitude(&self, _: usize) -> f64 {
        1.0
    }

    #[inline(always)]
    fn magnitudes(&self, _: usize) -> T {
        T::one()
    }
}

impl<T: Real> Configuration for Isometry3<T> {
    type Scalar = T;
    type Tangent = SVector<T, 6>;
    type Components = SVector<T, 7>;

    #[inline(always)]
    fn retract(&self, tangent: &Self::Tangent) -> Self {
        se3::retract(self, tangent)
    }

    #[inline(always)]
    fn advance(&self, tangent: &Self::Tangent) -> Self {
        se3::advance(self, tangent)
    }

    #[inline(always)]
    fn retract_carrying(&self, tangent: &Self::Tangent, low: &mut Self::Tangent) -> Self {
        carried::pose(self, tangent, low)
    }

    #[inline(always)]
    fn difference(&self, other: &Self) -> Self::Tangent {
        se3::difference(self, other)
    }

    #[inline(always)]
    fn dexp_inv(v: &Self::Tangent, w: &Self::Tangent) -> Self::Tangent {
        se3::dexp_inv(v, w)
    }

    #[inline(always)]
    fn bracket(v: &Self::Tangent, w: &Self::Tangent) -> Self::Tangent {
        se3::bracket(v, w)
    }

    #[inline(always)]
    fn dexp(v: &Self::Tangent) -> impl Fn(&Self::Tangent) -> Self::Tangent {
        se3::dexp(v)
    }

    /// x, y, z, w of the quaternion, then b in the observer's axes.
    #[inline(always)]
    fn components(&self) -> Self::Components {
        let ([x, y, z, w], [a, b, c]) = (quaternion(&self.rotation), triple(&self.translation.vector));
        SVector::from([x, y, z, w, a, b, c])
    }

    #[inline(always)]
    fn from_components(components: &Self::Components) -> Self {
        let [x, y, z, w, a, b, c] = components.data.0[0];
        se3::isometry(unit_quaternion([x, y, z, w]), [a, b, c])
    }

    #[inline(always)]
    fn component_rates(&self, velocity: &Self::Tangent) -> Self::Components {
        let (rotation, (u, omega)) = (quaternion(&self.rotation), se3::split(velocity));
        let ([x, y, z, w], [a, b, c]) = (so3::component_rates(rotation, omega), rotate(rotation, u));
        SVector::from([x, y, z, w, a, b, c])
    }

    #[inline(always)]
    fn tangent(&self, change: &Self::Components) -> Self::Tangent {
        let (rotation, [x, y, z, w, a, b, c]) = (quaternion(&self.rotation), change.data.0[0]);
        se3::join(rotate_back(rotation, [a, b, c]), so3::tangent(rotation, [x, y, z, w]))
    }

    fn component_unit(i: usize) -> &'static str {
        if i < 4 { "1" } else { "m" }
    }

    fn rate_unit(i: usize) -> &'static str {
        if i < 3 { "m/s" } else { "rad/s" }
    }

    #[inline]
    fn is_finite(&self) -> bool {
        Configuration::is_finite(&self.rotation) && VectorSpace::is_finite(&self.translation.vector)
    }

    #[inline(always)]
    fn norm_correction(&self) -> Self::Components {
        let ([x, y, z, w], zero) = (so3::norm_correction(quaternion(&self.rotation)), T::zero());
        SVector::from([x, y, z, w, zero, zero, zero])
    }

    #[inline(always)]
    fn renormalise(&self) -> Self {
        Self { rotation: so3::renormalise(&self.rotation), translation: self.translation }
    }

    #[inline]
    fn increment_angle(tangent: &Self::Tangent) -> f64 {
        norm(&tangent.data.0[0][3..])
    }

    #[inline(always)]
    fn increment_angles(tangent: &Self::Tangent) -> T {
        lengths(&tangent.data.0[0][3..])
    }

    #[inline]
    fn magnitude(&self, i: usize) -> f64 {
        if i < 3 { norm(&self.translation.vector.data.0[0]) } else { 1.0 }
    }

    #[inline(always)]
    fn magnitudes(&self, i: usize) -> T {
        if i < 3 { lengths(&self.translation.vector.data.0[0]) } else { T::one() }
    }
}

impl<T: Real> Configuration for Isometry2<T> {
    type Scalar = T;
    type Tangent = SVector<T, 3>;
    type Components = SVector<T, 4>;

    #[inline(always)]
    fn retract(&self, tangent: &Self::Tangent) -> Self {
        se2::retract(self, tangent)
    }

    #[inline(always)]
    fn advance(&self, tangent: &Self::Tangent) -> Self {
        se2::advance(self, tangent)
    }

    #[inline(always)]
    fn retract_carrying(&self, tangent: &Self::Tangent, low: &mut Self::Tangent) -> Self {
        carried::plane(self, tangent, low)
    }

    #[inline(always)]
    fn difference(&self, other: &Self) -> Self::Tangent {
        se2::difference(self, other)
    }

    #[inline(always)]
    fn dexp_inv(v: &Self::Tangent, w: &Self::Tangent) -> Self::Tangent {
        se2::dexp_inv(v, w)
    }

    #[inline(always)]
    fn bracket(v: &Self::Tangent, w: &Self::Tangent) -> Self::Tangent {
        se2::bracket(v, w)
    }

    #[inline(always)]
    fn dexp(v: &Self::Tangent) -> impl Fn(&Self::Tangent) -> Self::Tangent {
        se2::dexp(v)
    }

    /// Cosine and sine of the angle, then b in the observer's axes.
    #[inline(always)]
    fn components(&self) -> Self::Components {
        let (turn, [x, y]) = (self.rotation.as_ref(), self.translation.vector.data.0[0]);
        SVector::from([turn.re, turn.im, x, y])
    }

    #[inline(always)]
    fn from_components(components: &Self::Components) -> Self {
        let [cosine, sine, x, y] = components.data.0[0];
        se2::isometry(se2::rotation(cosine, sine), [x, y])
    }

    #[inline(always)]
    fn component_rates(&self, velocity: &Self::Tangent) -> Self::Components {
        let (turn, [u, v, omega]) = (self.rotation.as_ref(), velocity.data.0[0]);
        SVector::from([-(omega * turn.im), omega * turn.re, turn.re * u - turn.im * v, turn.im * u + turn.re * v])
    }

    #[inline(always)]
    fn tangent(&self, change: &Self::Components) -> Self::Tangent {
        let (turn, [cosine, sine, x, y]) = (self.rotation.as_ref(), change.data.0[0]);
        let angle = turn.re * sine - turn.im * cosine;
        SVector::from([turn.re * x + turn.im * y, turn.re * y - turn.im * x, angle])
    }

    fn component_unit(i: usize) -> &'static str {
        if i < 2 { "1" } else { "m" }
    }

    fn rate_unit(i: usize) -> &'static str {
        if i < 2 { "m/s" } else { "rad/s" }
    }

    #[inline]
    fn is_finite(&self) -> bool {
        let rotation = self.rotation.as_ref();
        rotation.re.is_finite() && rotation.im.is_finite() && VectorSpace::is_finite(&self.translation.vector)
    }

    #[inline(always)]
    fn norm_correction(&self) -> Self::Components {
        let (turn, zero) = (self.rotation.as_ref(), T::zero());
        let [re, im] = se2::norm_correction([turn.re, turn.im]);
        SVector::from([re, im, zero, zero])
    }

    #[inline(always)]
    fn renormalise(&self) -> Self {
        se2::renormalise(self)
    }

    #[inline]
    fn increment_angle(tangent: &Self::Tangent) -> f64 {
        norm(&tangent.data.0[0][2..])
    }

    #[inline(always)]
    fn increment_angles(tangent: &Self::Tangent) -> T {
        lengths(&tangent.data.0[0][2..])
    }

    #[inline]
    fn magnitude(&self, i: usize) -> f64 {
        if i < 2 { norm(&self.translation.vector.data.0[0]) } else { 1.0 }
    }

    #[inline(always)]
    fn magnitudes(&self, i: usize) -> T {
        if i < 2 { lengths(&self.translation.vector.data.0[0]) } else { T::one() }
    }
}
