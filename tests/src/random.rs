//! Numbers that look random, the same in every run.

use gauss_runtime::prelude::*;

/// A reproducible stream of numbers in [−1, 1] (Knuth's linear congruence of 64 bits).
pub struct Random(pub u64);

impl Random {
    /// The next one.
    pub fn number(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// Components up to a size.
    pub fn vector<T: Real, V: VectorSpace<T>>(&mut self, size: f64) -> V {
        let mut v = V::zero();
        (0..V::DIM).for_each(|i| v.set_component(i, T::from_f64(size * self.number())));
        v
    }
}
