//! Configurations of several factors as plain numbers, and random ones.

use gauss_runtime::prelude::*;

use super::Bounded;
use super::body::Parts;

pub use gauss_tests::random::Random;

/// Pairs, for systems: the parts of the first factor are those of a quaternion or of a pose.
impl<T: Real, A: Grouped<T>, B: Parts<T>> Parts<T> for (A, B) {
    fn parts(&self) -> Vec<T> {
        [self.0.parts(), self.1.parts()].concat()
    }
    fn assemble(parts: &[T]) -> Self {
        let (first, second) = parts.split_at(A::COUNT);
        (A::assemble(first), B::assemble(second))
    }
    fn rates(&self, velocity: &Self::Tangent) -> Vec<T> {
        [self.0.rates(&velocity.first), self.1.rates(&velocity.second)].concat()
    }
}

/// An element of a group before what else there is.
pub trait Grouped<T: Real>: Parts<T> {
    /// How many parts it has.
    const COUNT: usize;
}

impl<T: Real> Grouped<T> for UnitQuaternion<T> {
    const COUNT: usize = 4;
}

impl<T: Real> Grouped<T> for Isometry3<T> {
    const COUNT: usize = 7;
}

/// A configuration near which quaternions have norm 1: rounded components stand for exact ones up to their bounds.
pub fn random_configuration<C: Configuration<Scalar = f64> + Parts<f64>, B: Parts<Bounded>>(
    origin: &C,
    random: &mut Random,
) -> B {
    let mut tangent = C::Tangent::zero();
    for i in 0..C::Tangent::DIM {
        tangent.set_component(i, 1.2 * random.number());
    }
    let parts = origin.retract(&tangent).renormalise().parts();
    B::assemble(&parts.iter().map(|&x| Bounded::measured(x, 4.0 * f64::EPSILON * x.abs().max(1.0))).collect::<Vec<_>>())
}
