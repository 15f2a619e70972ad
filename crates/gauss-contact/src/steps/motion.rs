//! The formulas of a step in any scalar: what is left of it once it is known which contacts act.

use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::constraint::ProjectionError;
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::integrate::problem::state::TangentOf;
use gauss_runtime::real::Real;

use crate::lockstep::larger;

/// The state at half of a step, with the speeds at which accelerations are taken.
pub(super) struct Middle<K: ContactSystem> {
    pub(super) t: K::Scalar,
    pub(super) q: K::Configuration,
    pub(super) z: K::Speeds,
}

/// Where half of a step leads with the rate of places before it.
pub(super) fn half_way<K: ContactSystem>(h: f64, q: &K::Configuration, rate: &TangentOf<K>) -> K::Configuration {
    q.advance(&rate.scale(K::Scalar::from_f64(0.5 * h)))
}

/// The second half of a step, with the speeds after it and the rate of places by these, and what keeps bilateral
/// constraints.
pub(super) fn second_half<K: ContactSystem>(
    kernel: &K,
    (t, h): (K::Scalar, f64),
    middle: &Middle<K>,
    (z, rate): (K::Speeds, &TangentOf<K>),
) -> Result<(K::Configuration, K::Speeds), ProjectionError> {
    let q = half_way::<K>(h, &middle.q, rate);
    if K::CONSTRAINED { kernel.project(t + K::Scalar::from_f64(h), &q, &z) } else { Ok((q, z)) }
}

/// Rates before a step, and at its end without contact impulses: to second order those there. Of contacts that depend
/// on one another both are taken at half of the step, where they agree with one another to rounding; that is of first
/// order. `free` are the speeds without contact impulses, `bias` the b of their accelerations.
pub(super) fn free_rates<K: ContactSystem>(
    kernel: &K,
    (h, dependent): (f64, bool),
    middle: &Middle<K>,
    (z, rates): (&K::Speeds, &K::ContactRows),
    (free, bias): (&K::Speeds, &K::ContactRows),
) -> [K::ContactRows; 2] {
    if !dependent {
        return [*rates, rates.add_scaled(K::Scalar::from_f64(h), bias)];
    }
    [*z, *free].map(|z| kernel.contact_rates(middle.t, &middle.q, &z))
}

/// The rate that an impact passes on, a part of the rate before it.
pub(super) fn passed_on<T: Real>(restitution: T, before: T) -> T {
    -restitution * before.min(T::zero())
}

/// How large numbers of a configuration are.
pub(super) fn magnitude<Q: Configuration>(q: &Q) -> Q::Scalar {
    (0..Q::Tangent::DIM).map(|i| q.magnitudes(i)).fold(Q::Scalar::zero(), larger)
}
