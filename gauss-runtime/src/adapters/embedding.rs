//! Configurations as numbers in a row: components, and how they change.

use nalgebra::{Complex, Isometry2, Isometry3, SVector, Translation2, Translation3, Unit, UnitQuaternion};

use crate::configuration::{Configuration, Product};
use crate::lie::so3;
use crate::real::Real;
use crate::triple::{compose, quaternion, rotate, triple, unit_quaternion};

/// A group embedded in a linear space: what an integrator needs that knows of vectors only.
///
/// | configuration | components |
/// |---|---|
/// | [`UnitQuaternion`] | x, y, z, w |
/// | [`Isometry3`] | those of the rotation, then b₁, b₂, b₃ |
/// | [`Isometry2`] | cos θ, sin θ, then b₁, b₂ |
/// | [`SVector`] | itself |
/// | pairs | those of the first, then those of the second |
///
/// A rotation's components may have any length: directions alone count. Equations of motion look at the rotation that they are
/// in the direction of, and its components change in proportion to their length, which the exact solution then keeps. What an
/// integrator adds to the length is no error of the rotation.
pub trait EmbeddedConfiguration: Configuration {
    /// The number of components.
    const COMPONENTS: usize;

    /// The configuration whose components are `get(first)`, `get(first + 1)`, …; rotations are brought to length 1.
    fn from_components(get: impl Fn(usize) -> Self::Scalar, first: usize) -> Self;

    /// Hands each component to `put` with its number, from `first` on.
    fn components(&self, put: impl FnMut(usize, Self::Scalar), first: usize);

    /// Hands the rate of each component to `put` when the velocity seen from the body is `velocity`: `self` is
    /// [`from_components`](Self::from_components) of `get`.
    fn component_rates(
        &self,
        velocity: &Self::Tangent,
        get: impl Fn(usize) -> Self::Scalar,
        put: impl FnMut(usize, Self::Scalar),
        first: usize,
    );
}

/// A few numbers in a row.
fn read<T, const N: usize>(get: impl Fn(usize) -> T, first: usize) -> [T; N] {
    core::array::from_fn(|i| get(first + i))
}

/// The same the other way.
fn write<T, const N: usize>(values: [T; N], mut put: impl FnMut(usize, T), first: usize) {
    for (i, value) in values.into_iter().enumerate() {
        put(first + i, value);
    }
}

impl<T: Real> EmbeddedConfiguration for UnitQuaternion<T> {
    const COMPONENTS: usize = 4;

    #[inline]
    fn from_components(get: impl Fn(usize) -> T, first: usize) -> Self {
        so3::renormalise(&unit_quaternion(read(get, first)))
    }

    #[inline]
    fn components(&self, put: impl FnMut(usize, T), first: usize) {
        write(quaternion(self), put, first);
    }

    /// q̇ = ½ q ∘ ω with q as it is, not as it is brought to length 1.
    #[inline]
    fn component_rates(
        &self,
        velocity: &SVector<T, 3>,
        get: impl Fn(usize) -> T,
        put: impl FnMut(usize, T),
        first: usize,
    ) {
        let [x, y, z] = triple(velocity).map(|c| T::ratio(1, 2) * c);
        write(compose(read(get, first), [x, y, z, T::zero()]), put, first);
    }
}

impl<T: Real> EmbeddedConfiguration for Isometry3<T> {
    const COMPONENTS: usize = 7;

    #[inline]
    fn from_components(get: impl Fn(usize) -> T, first: usize) -> Self {
        let rotation = UnitQuaternion::from_components(&get, first);
        Self { rotation, translation: Translation3 { vector: SVector::from(read(get, first + 4)) } }
    }

    #[inline]
    fn components(&self, mut put: impl FnMut(usize, T), first: usize) {
        self.rotation.components(&mut put, first);
        write(triple(&self.translation.vector), put, first + 4);
    }

    /// ḃ = R u.
    #[inline]
    fn component_rates(
        &self,
        velocity: &SVector<T, 6>,
        get: impl Fn(usize) -> T,
        mut put: impl FnMut(usize, T),
        first: usize,
    ) {
        let [u1, u2, u3, w1, w2, w3] = velocity.data.0[0];
        self.rotation.component_rates(&SVector::from([w1, w2, w3]), get, &mut put, first);
        write(rotate(quaternion(&self.rotation), [u1, u2, u3]), put, first + 4);
    }
}

impl<T: Real> EmbeddedConfiguration for Isometry2<T> {
    const COMPONENTS: usize = 4;

    #[inline]
    fn from_components(get: impl Fn(usize) -> T, first: usize) -> Self {
        let [re, im, x, y] = read(get, first);
        Self {
            rotation: Unit::new_unchecked(Complex { re, im }),
            translation: Translation2 { vector: SVector::from([x, y]) },
        }
        .renormalise()
    }

    #[inline]
    fn components(&self, put: impl FnMut(usize, T), first: usize) {
        let (rotation, [x, y]) = (self.rotation.as_ref(), self.translation.vector.data.0[0]);
        write([rotation.re, rotation.im, x, y], put, first);
    }

    /// (cos θ, sin θ)˙ = ω (−sin θ, cos θ), ḃ = R u.
    #[inline]
    fn component_rates(
        &self,
        velocity: &SVector<T, 3>,
        get: impl Fn(usize) -> T,
        put: impl FnMut(usize, T),
        first: usize,
    ) {
        let ([re, im], [u1, u2, omega]) = (read(get, first), velocity.data.0[0]);
        let (cosine, sine) = (self.rotation.as_ref().re, self.rotation.as_ref().im);
        let position = [cosine * u1 - sine * u2, sine * u1 + cosine * u2];
        write([-omega * im, omega * re, position[0], position[1]], put, first);
    }
}

impl<T: Real, const N: usize> EmbeddedConfiguration for SVector<T, N> {
    const COMPONENTS: usize = N;

    #[inline]
    fn from_components(get: impl Fn(usize) -> T, first: usize) -> Self {
        Self::from(read(get, first))
    }

    #[inline]
    fn components(&self, put: impl FnMut(usize, T), first: usize) {
        write(self.data.0[0], put, first);
    }

    #[inline]
    fn component_rates(&self, velocity: &Self, _: impl Fn(usize) -> T, put: impl FnMut(usize, T), first: usize) {
        write(velocity.data.0[0], put, first);
    }
}

impl<A, B> EmbeddedConfiguration for (A, B)
where
    A: EmbeddedConfiguration,
    B: EmbeddedConfiguration<Scalar = A::Scalar>,
{
    const COMPONENTS: usize = A::COMPONENTS + B::COMPONENTS;

    #[inline]
    fn from_components(get: impl Fn(usize) -> A::Scalar, first: usize) -> Self {
        (A::from_components(&get, first), B::from_components(&get, first + A::COMPONENTS))
    }

    #[inline]
    fn components(&self, mut put: impl FnMut(usize, A::Scalar), first: usize) {
        self.0.components(&mut put, first);
        self.1.components(put, first + A::COMPONENTS);
    }

    #[inline]
    fn component_rates(
        &self,
        velocity: &Product<A::Tangent, B::Tangent>,
        get: impl Fn(usize) -> A::Scalar,
        mut put: impl FnMut(usize, A::Scalar),
        first: usize,
    ) {
        self.0.component_rates(&velocity.first, &get, &mut put, first);
        self.1.component_rates(&velocity.second, get, put, first + A::COMPONENTS);
    }
}
