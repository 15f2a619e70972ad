//! Configurations of general position, at which `kernel()` looks at a mass matrix.

use crate::configuration::{Configuration, VectorSpace};
use crate::real::Real;

/// The time at them.
const TIME: f64 = 0.37;

/// A few configurations: turns of any size, and lengths and coordinates from a thousandth to a thousand.
pub fn samples<Q: Configuration>() -> [Q; 4] {
    let mut seed = 0x9e37_79b9_7f4a_7c15_u64;
    [1.0, 1e-3, 30.0, 1e3].map(|scale| {
        let mut components = <Q::Components as VectorSpace<Q::Scalar>>::zero();
        for i in 0..<Q::Components as VectorSpace<Q::Scalar>>::DIM {
            // Knuth's linear congruence; the upper digits, between ±¼ and ±1.
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let size = 0.25 + 0.75 * ((seed >> 12) as f64 / (1_u64 << 52) as f64);
            let sign = if seed >> 11 & 1 == 0 { 1.0 } else { -1.0 };
            components.set_component(i, Q::Scalar::from_f64(sign * scale * size));
        }
        Q::from_components(&components).renormalise()
    })
}

/// The time at which mass matrices are looked at.
pub fn sample_time<T: Real>() -> T {
    T::from_f64(TIME)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Isometry3, SVector};

    #[test]
    fn they_differ_and_are_configurations() {
        for q in samples::<(Isometry3<f64>, SVector<f64, 2>)>() {
            // What `renormalise` leaves alone is within 4ε of the square, and the norm has its own roundings.
            assert!((q.0.rotation.as_ref().norm() - 1.0).abs() < 4.0 * f64::EPSILON && q.is_finite());
            assert!(q.1[0] != q.1[1] && q.0.rotation.angle() > 0.1);
        }
    }
}
