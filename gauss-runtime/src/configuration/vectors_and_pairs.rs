//! Configurations that are vectors, and those that consist of two.

use nalgebra::SVector;

use super::Configuration;
use crate::real::Real;
use crate::triple::norm;
use crate::vector_space::{Product, VectorSpace, add_carrying};

impl<T: Real, const N: usize> Configuration for SVector<T, N> {
    type Scalar = T;
    type Tangent = Self;
    type Components = Self;

    #[inline(always)]
    fn retract(&self, tangent: &Self) -> Self {
        Self::from(core::array::from_fn(|i| self.data.0[0][i] + tangent.data.0[0][i]))
    }

    #[inline(always)]
    fn retract_carrying(&self, tangent: &Self, low: &mut Self) -> Self {
        let (sum, rest) = add_carrying(self, tangent, low);
        *low = rest;
        sum
    }

    #[inline(always)]
    fn difference(&self, other: &Self) -> Self {
        Self::from(core::array::from_fn(|i| other.data.0[0][i] - self.data.0[0][i]))
    }

    #[inline(always)]
    fn dexp_inv(_: &Self, w: &Self) -> Self {
        *w
    }

    #[inline(always)]
    fn bracket(_: &Self, _: &Self) -> Self {
        Self::zero()
    }

    #[inline(always)]
    fn dexp(_: &Self) -> impl Fn(&Self) -> Self {
        |w| *w
    }

    #[inline(always)]
    fn components(&self) -> Self {
        *self
    }

    #[inline(always)]
    fn from_components(components: &Self) -> Self {
        *components
    }

    #[inline(always)]
    fn component_rates(&self, velocity: &Self) -> Self {
        *velocity
    }

    #[inline(always)]
    fn tangent(&self, change: &Self) -> Self {
        *change
    }

    #[inline]
    fn is_finite(&self) -> bool {
        VectorSpace::is_finite(self)
    }

    #[inline]
    fn magnitude(&self, i: usize) -> f64 {
        norm(&self.data.0[0][i..=i])
    }

    #[inline(always)]
    fn magnitudes(&self, i: usize) -> T {
        self.data.0[0][i].abs()
    }
}

impl<A: Configuration, B: Configuration<Scalar = A::Scalar>> Configuration for (A, B) {
    type Scalar = A::Scalar;
    type Tangent = Product<A::Tangent, B::Tangent>;
    type Components = Product<A::Components, B::Components>;

    #[inline(always)]
    fn retract(&self, tangent: &Self::Tangent) -> Self {
        (self.0.retract(&tangent.first), self.1.retract(&tangent.second))
    }

    #[inline(always)]
    fn advance(&self, tangent: &Self::Tangent) -> Self {
        (self.0.advance(&tangent.first), self.1.advance(&tangent.second))
    }

    #[inline(always)]
    fn retract_carrying(&self, tangent: &Self::Tangent, low: &mut Self::Tangent) -> Self {
        (
            self.0.retract_carrying(&tangent.first, &mut low.first),
            self.1.retract_carrying(&tangent.second, &mut low.second),
        )
    }

    #[inline(always)]
    fn difference(&self, other: &Self) -> Self::Tangent {
        Product { first: self.0.difference(&other.0), second: self.1.difference(&other.1) }
    }

    #[inline(always)]
    fn dexp_inv(v: &Self::Tangent, w: &Self::Tangent) -> Self::Tangent {
        Product { first: A::dexp_inv(&v.first, &w.first), second: B::dexp_inv(&v.second, &w.second) }
    }

    #[inline(always)]
    fn bracket(v: &Self::Tangent, w: &Self::Tangent) -> Self::Tangent {
        Product { first: A::bracket(&v.first, &w.first), second: B::bracket(&v.second, &w.second) }
    }

    #[inline(always)]
    fn dexp(v: &Self::Tangent) -> impl Fn(&Self::Tangent) -> Self::Tangent {
        let (first, second) = (A::dexp(&v.first), B::dexp(&v.second));
        move |w| Product { first: first(&w.first), second: second(&w.second) }
    }

    #[inline(always)]
    fn components(&self) -> Self::Components {
        Product { first: self.0.components(), second: self.1.components() }
    }

    #[inline(always)]
    fn from_components(components: &Self::Components) -> Self {
        (A::from_components(&components.first), B::from_components(&components.second))
    }

    #[inline(always)]
    fn component_rates(&self, velocity: &Self::Tangent) -> Self::Components {
        Product { first: self.0.component_rates(&velocity.first), second: self.1.component_rates(&velocity.second) }
    }

    #[inline(always)]
    fn tangent(&self, change: &Self::Components) -> Self::Tangent {
        Product { first: self.0.tangent(&change.first), second: self.1.tangent(&change.second) }
    }

    fn component_unit(i: usize) -> &'static str {
        let split = <A::Components as VectorSpace<A::Scalar>>::DIM;
        if i < split { A::component_unit(i) } else { B::component_unit(i - split) }
    }

    fn rate_unit(i: usize) -> &'static str {
        let split = <A::Tangent as VectorSpace<A::Scalar>>::DIM;
        if i < split { A::rate_unit(i) } else { B::rate_unit(i - split) }
    }

    #[inline]
    fn is_finite(&self) -> bool {
        self.0.is_finite() && self.1.is_finite()
    }

    #[inline(always)]
    fn norm_correction(&self) -> Self::Components {
        Product { first: self.0.norm_correction(), second: self.1.norm_correction() }
    }

    #[inline(always)]
    fn renormalise(&self) -> Self {
        (self.0.renormalise(), self.1.renormalise())
    }

    #[inline]
    fn increment_angle(tangent: &Self::Tangent) -> f64 {
        A::increment_angle(&tangent.first).max(B::increment_angle(&tangent.second))
    }

    #[inline(always)]
    fn increment_angles(tangent: &Self::Tangent) -> A::Scalar {
        Real::max(A::increment_angles(&tangent.first), B::increment_angles(&tangent.second))
    }

    #[inline]
    fn magnitude(&self, i: usize) -> f64 {
        let split = <A::Tangent as VectorSpace<A::Scalar>>::DIM;
        if i < split { self.0.magnitude(i) } else { self.1.magnitude(i - split) }
    }

    #[inline(always)]
    fn magnitudes(&self, i: usize) -> A::Scalar {
        let split = <A::Tangent as VectorSpace<A::Scalar>>::DIM;
        if i < split { self.0.magnitudes(i) } else { self.1.magnitudes(i - split) }
    }
}
