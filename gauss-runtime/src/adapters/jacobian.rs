//! ∂f/∂x times a vector, for implicit methods.

use super::flat::FlatSystem;
use super::ways::{Differences, Given};
use crate::integrate::{Form, InputSource};
use crate::real::Real;
use crate::system::GaussSystem;

/// A way to find `∂f/∂x · v` of a [`FlatSystem`].
pub trait JacobianProduct<S: GaussSystem, F, I>: Sized {
    /// Writes `∂f/∂x · v` at (t, x) into `product`. All slices are [`FlatSystem::DIM`] long.
    fn product(
        &self,
        system: &FlatSystem<'_, S, F, I, Self>,
        t: S::Scalar,
        x: &[S::Scalar],
        v: &[S::Scalar],
        product: &mut [S::Scalar],
    );
}

impl<S, F, I> JacobianProduct<S, F, I> for Differences
where
    S: GaussSystem,
    F: Form<S>,
    I: InputSource<S>,
{
    fn product(
        &self,
        system: &FlatSystem<'_, S, F, I, Self>,
        t: S::Scalar,
        x: &[S::Scalar],
        v: &[S::Scalar],
        product: &mut [S::Scalar],
    ) {
        let zero = S::Scalar::zero();
        let largest = |values: &[S::Scalar], least| values.iter().fold(least, |m: S::Scalar, &c| m.max(c.abs()));
        let length = largest(v, zero);
        // ∛ε to a power of two.
        let third = S::Scalar::from_f64(if S::Scalar::EPSILON < 1e-10 { 1.0 / 131_072.0 } else { 1.0 / 256.0 });
        // Nowhere to go, for a vector of no length: any step.
        let length = S::Scalar::select_lt(zero, length, length, S::Scalar::one());
        let h = third * largest(x, S::Scalar::one()) / length;
        system.rates_by(t, |i| h.fma(v[i], x[i]), |i, value| product[i] = value);
        let factor = (h + h).recip();
        system.rates_by(t, |i| (-h).fma(v[i], x[i]), |i, value| product[i] = factor * (product[i] - value));
    }
}

impl<S, F, I, G> JacobianProduct<S, F, I> for Given<G>
where
    S: GaussSystem,
    G: Fn(S::Scalar, &[S::Scalar], &[S::Scalar], &mut [S::Scalar]),
{
    fn product(
        &self,
        _: &FlatSystem<'_, S, F, I, Self>,
        t: S::Scalar,
        x: &[S::Scalar],
        v: &[S::Scalar],
        product: &mut [S::Scalar],
    ) {
        (self.0)(t, x, v, product);
    }
}
