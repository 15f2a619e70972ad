//! Rounding of places.

use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::integrate::problem::state::TangentOf;
use gauss_runtime::real::Real;

use crate::dense::epsilon;

/// The size of a configuration.
pub(crate) struct Rounding {
    pub(crate) size: f64,
    epsilon: f64,
}

impl Rounding {
    pub(crate) fn of<K: ContactSystem>(q: &K::Configuration) -> Self {
        let size = (0..TangentOf::<K>::DIM).map(|i| q.magnitude(i)).fold(0.0, f64::max);
        Self { size, epsilon: epsilon::<K::Scalar>() }
    }

    /// 64 ε of it, and of numbers of order 1 that cancel: sums of some ten numbers are known to that.
    pub(crate) fn some_digits(&self) -> f64 {
        64.0 * self.epsilon * self.size.max(1.0)
    }

    /// √ε of it, and 64 ε for numbers of order 1 that cancel: what agrees in half of the digits was meant to.
    pub(crate) fn half_of_the_digits(&self) -> f64 {
        Real::sqrt(self.epsilon) * self.size + 64.0 * self.epsilon
    }
}
