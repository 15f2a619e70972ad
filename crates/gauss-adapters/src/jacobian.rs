//! ∂f/∂x times a vector, for implicit methods.

use crate::flat::FlatSystem;
use crate::ways::{Differences, JacobianFunction};
use gauss_runtime::integrate::Problem;
use gauss_runtime::real::Real;
use gauss_runtime::system::GaussSystem;

type Scalar<P> = <<P as Problem>::System as GaussSystem>::Scalar;

/// A way to find `∂f/∂x · v` of a [`FlatSystem`].
pub trait JacobianProduct<P: Problem>: Sized {
    /// Writes `∂f/∂x · v` at (t, x) into `product`. All slices are [`FlatSystem::DIM`] long.
    fn product(
        &self,
        system: &FlatSystem<P, Self>,
        t: Scalar<P>,
        x: &[Scalar<P>],
        v: &[Scalar<P>],
        product: &mut [Scalar<P>],
    );
}

impl<S, P> JacobianProduct<P> for Differences
where
    S: GaussSystem,
    P: Problem<System = S>,
{
    fn product(
        &self,
        system: &FlatSystem<P, Self>,
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

impl<S, P, G> JacobianProduct<P> for JacobianFunction<G>
where
    S: GaussSystem,
    P: Problem<System = S>,
    G: Fn(S::Scalar, &[S::Scalar], &[S::Scalar], &mut [S::Scalar]),
{
    fn product(
        &self,
        _: &FlatSystem<P, Self>,
        t: S::Scalar,
        x: &[S::Scalar],
        v: &[S::Scalar],
        product: &mut [S::Scalar],
    ) {
        (self.0)(t, x, v, product);
    }
}
