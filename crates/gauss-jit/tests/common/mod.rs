//! Pseudo-random numbers, robots' files and names, for tests of several kinds.

use std::path::PathBuf;

/// A pseudo-random number between −1 and 1.
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64 * 2.0 - 1.0
    }

    pub fn list(&mut self, count: usize) -> Vec<f64> {
        (0..count).map(|_| self.next()).collect()
    }
}

pub fn robot(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../tests/robots").join(name)
}

pub fn names(list: &[gauss_jit::Quantity]) -> Vec<String> {
    list.iter().flat_map(|quantity| &quantity.numbers).cloned().collect()
}
