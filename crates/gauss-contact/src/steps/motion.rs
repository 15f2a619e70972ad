//! The formulas of a step in any scalar: what is left of it once it is known which contacts act.

use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::integrate::problem::state::TangentOf;
use gauss_runtime::real::Real;

use crate::law::carrier;
use crate::lockstep::larger;

/// The state at half of a step at which forces are taken, with the speeds at which they are.
pub(super) struct Middle<K: ContactSystem> {
    pub(super) t: K::Scalar,
    pub(super) q: K::Configuration,
    pub(super) z: K::Speeds,
    /// The place to which half of the step leads with the speeds before it, from which the second half goes on.
    pub(super) half: K::Configuration,
    /// The speeds that lead to `q`.
    pub(super) way: K::Speeds,
    /// Whether these are the mean ones of the step, not those before it.
    pub(super) is_mean: bool,
}

impl<K: ContactSystem> Middle<K> {
    /// Half of a step of length `h`, with forces at the place there and at some speeds.
    pub(super) fn new((t, h): (K::Scalar, f64), half: K::Configuration, way: K::Speeds, z: K::Speeds) -> Self {
        Self { t: t + K::Scalar::from_f64(0.5 * h), q: half, z, half, way, is_mean: false }
    }

    /// The same with forces at the place to which mean speeds lead from that before the step.
    pub(super) fn with_mean(
        &self,
        kernel: &K,
        (t, h): (K::Scalar, f64),
        (q, way): (&K::Configuration, K::Speeds),
        z: K::Speeds,
    ) -> Self {
        let q = half_way::<K>(h, q, &kernel.kinematics(t, q, &way));
        Self { t: self.t, q, z, half: self.half, way, is_mean: true }
    }
}

/// The mean of the speeds at both ends.
pub(super) fn mean<T: Real, V: VectorSpace<T>>(before: &V, after: &V) -> V {
    before.add_scaled(T::one(), after).scale(T::from_f64(0.5))
}

/// The rule by which the speeds at half of a step follow from an attempt at it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Mean {
    /// The mean of those at both ends.
    Ends,
    /// The same with the accelerations there: the mean over time, where speeds do not jump.
    Curved,
}

impl Mean {
    /// The mean speeds of a step from speeds at its start, with what gives the acceleration there, and from the state
    /// at its end.
    pub(super) fn of<K: ContactSystem>(
        self,
        kernel: &K,
        (t, h): (K::Scalar, f64),
        (z, before): (&K::Speeds, impl FnOnce() -> K::Speeds),
        (q_after, z_after): (&K::Configuration, &K::Speeds),
        input: &K::Input,
    ) -> K::Speeds {
        let number = K::Scalar::from_f64;
        let mean = mean(z, z_after);
        if self == Self::Ends {
            return mean;
        }
        let before = before();
        let after = kernel.acceleration(t + number(h), q_after, z_after, input);
        mean.add_scaled(number(h / 12.0), &before).add_scaled(number(-h / 12.0), &after)
    }
}

/// Rule by which the next attempt at a step follows from one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rule {
    /// The mean speeds that it goes to.
    pub(super) mean: Mean,
    /// Part of the difference to them by which it goes.
    pub(super) part: f64,
    /// Whether its forces are taken at the mean place.
    pub(super) at_mean_place: bool,
}

/// Speeds changed by a part of the difference to others.
pub(super) fn towards<T: Real, V: VectorSpace<T>>(used: &V, wanted: &V, part: f64) -> V {
    if part == 1.0 { *wanted } else { used.add_scaled(T::from_f64(part), &wanted.add_scaled(-T::one(), used)) }
}

/// Configuration to which half of a step leads with the rate of places before it.
pub(super) fn half_way<K: ContactSystem>(h: f64, q: &K::Configuration, rate: &TangentOf<K>) -> K::Configuration {
    q.advance(&rate.scale(K::Scalar::from_f64(0.5 * h)))
}

/// Rates before a step, and at its end without contact impulses: to second order those there. Of contacts that may
/// bounce, and of all where some depend on one another, both are taken at half of the step: there dependent ones agree
/// with one another to rounding, and `½ P (u + u⁺)` is the work of an impulse P. `free` are the speeds without contact
/// impulses, `bias` the b of their accelerations.
pub(super) fn free_rates<K: ContactSystem>(
    kernel: &K,
    h: f64,
    middle: &Middle<K>,
    (z, rates): (&K::Speeds, &K::ContactRows),
    (free, bias): (&K::Speeds, &K::ContactRows),
    (dependent, bounces): (bool, impl Fn(usize) -> bool),
) -> [K::ContactRows; 2] {
    let at_half = |i: usize| dependent || bounces(carrier(kernel.contacts(), i));
    let mut taken = [*rates, rates.add_scaled(K::Scalar::from_f64(h), bias)];
    if !(0..kernel.contacts().len()).any(at_half) {
        return taken;
    }
    let halves = [*z, *free].map(|z| kernel.contact_rates(middle.t, &middle.q, &z));
    for (taken, half) in taken.iter_mut().zip(&halves) {
        let rows =
            kernel.contacts().iter().enumerate().filter(|(i, _)| at_half(*i)).flat_map(|(_, contact)| contact.rows());
        rows.for_each(|row| taken.set_component(row, half.component(row)));
    }
    taken
}

/// The fastest of rates before a step, and at its end without impulses: what lies still has only rounding before it.
pub(super) fn fastest<K: ContactSystem>(rates: &[K::ContactRows; 2]) -> K::Scalar {
    let each = rates.iter().flat_map(|rates| (0..K::ContactRows::DIM).map(|row| rates.component(row).abs()));
    each.fold(K::Scalar::zero(), larger)
}

/// Part of the fastest rate by which one that is zero may be off for rounding.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// The rate before a step that an impact reverses a part of. It is that of an approach; and of a gap that opens before
/// the step and that only impulses at other contacts close within it: `end` is with what it would end without these.
/// What is pressed to zero in place of that takes part in an impact by another law than the others do, and Newton's
/// law with one e then gives energy (it takes `½(1 − e²) uᵀD⁻¹u` with the rates u before the impact, of either sign).
/// Contacts that depend on one another have rates after it only if all are such parts, so that no more than rounding
/// of the `fastest` rate is none.
pub(super) fn reversed<T: Real>(before: T, end: T, fastest: T) -> T {
    let opens = T::select_lt(T::zero(), end, before, T::zero());
    before.min(T::zero()) + T::select_lt(T::from_f64(ROUNDING) * fastest, before, opens, T::zero())
}

/// Size of a configuration: the largest magnitude of its numbers.
pub(super) fn magnitude<Q: Configuration>(q: &Q) -> Q::Scalar {
    (0..Q::Tangent::DIM).map(|i| q.magnitudes(i)).fold(Q::Scalar::zero(), larger)
}
