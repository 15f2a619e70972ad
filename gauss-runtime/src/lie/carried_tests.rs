//! Products of many increments about one axis, whose exact value is known.

use nalgebra::{Isometry2, Isometry3, Quaternion, SVector, UnitQuaternion, Vector3};

use crate::configuration::{Configuration, Product, VectorSpace};
use crate::triple::quaternion;

/// 65536 numbers between 2⁻⁹ and 2⁻⁸, multiples of 2⁻²⁹: their sum is exact, and none is there twice, so that no
/// rounding is repeated either.
fn multiples() -> impl Iterator<Item = f64> {
    (0..1_u64 << 16).scan(12_345_u64, |state, _| {
        *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        Some(((1 << 20) + (*state >> 44)) as f64 / f64::from(1 << 29))
    })
}

/// The product of the increments m·σ with carrying and without, and the sum of the m.
fn products<C: Configuration<Scalar = f64>>(start: C, along: impl Fn(f64) -> C::Tangent) -> (C, C, f64) {
    let (mut carrying, mut plain, mut carried, mut total) = (start, start, C::Tangent::zero(), 0.0);
    for m in multiples() {
        let increment = along(m);
        carrying = carrying.retract_carrying(&increment, &mut carried);
        plain = plain.retract(&increment).renormalise();
        total += m;
    }
    (carrying, plain, total)
}

/// The errors of the increments, of which 7·2⁻⁸ ε/2 is the largest, and those of a few operations in each, add up like
/// the root of 65536 to a few ε; the result is rounded once more.
const FEW: f64 = 8.0 * f64::EPSILON;

/// The axis (2, 3, 6), of length 7 exactly.
fn axis() -> Vector3<f64> {
    SVector::from([2.0, 3.0, 6.0])
}

fn turned(total: f64) -> UnitQuaternion<f64> {
    let (sine, cosine) = (3.5 * total).sin_cos();
    UnitQuaternion::new_unchecked(Quaternion::from_parts(cosine, axis() * (sine / 7.0)))
}

/// Carried sums are much better than others, and good.
fn compare(carried: f64, plain: f64) {
    assert!(carried < FEW && plain > 5.0 * carried, "{carried:e}, not carried {plain:e}");
}

#[test]
fn rotations_add_up_to_rounding() {
    let (found, plain, total) = products(UnitQuaternion::identity(), |m| axis() * m);
    let error = |q: &UnitQuaternion<f64>| q.difference(&turned(total)).norm();
    compare(error(&found), error(&plain));
    let norm: f64 = quaternion(&found).iter().map(|c| c * c).sum();
    assert!((norm - 1.0).abs() <= 4.0 * f64::EPSILON);
}

#[test]
fn screws_add_up_to_rounding() {
    let u = SVector::from([1.0, -2.0, 0.5]);
    let (found, plain, total) =
        products(Isometry3::identity(), |m| SVector::from([m, -2.0 * m, 0.5 * m, 2.0 * m, 3.0 * m, 6.0 * m]));
    let along = axis() * (u.dot(&axis()) / 49.0);
    let (sine, cosine) = (7.0 * total).sin_cos();
    let across = (u - along) * (sine / 7.0) + axis().cross(&u) * ((1.0 - cosine) / 49.0);
    let exact = along * total + across;
    let error = |q: &Isometry3<f64>| (q.translation.vector - exact).norm() / exact.norm();
    compare(error(&found), error(&plain));
    assert!(found.rotation.difference(&turned(total)).norm() < FEW);
}

#[test]
fn plane_motions_add_up_to_rounding() {
    let (found, plain, total) = products(Isometry2::identity(), |m| SVector::from([m, -2.0 * m, 5.0 * m]));
    let (sine, cosine) = (5.0 * total).sin_cos();
    let (a, b) = (sine / 5.0, (1.0 - cosine) / 5.0);
    let error = |q: &Isometry2<f64>| {
        let shift = q.translation.vector - SVector::from([a + 2.0 * b, b - 2.0 * a]);
        shift.norm().max((q.rotation.re - cosine).abs()).max((q.rotation.im - sine).abs())
    };
    compare(error(&found), error(&plain));
}

#[test]
fn plain_numbers_and_pairs_are_carried_too() {
    let start = (UnitQuaternion::identity(), SVector::from([1e8 / 3.0]));
    let (found, plain, total) = products(start, |m| Product { first: axis() * m, second: SVector::from([0.5 * m]) });
    // The increments are exact: so is the sum, to nearest. Not carried they are rounded to multiples of 2⁻²⁸.
    assert_eq!(found.1[0], 1e8 / 3.0 + 0.5 * total);
    assert_ne!(plain.1[0], found.1[0]);
    assert!(found.0.difference(&turned(total)).norm() < FEW);
}
