//! Rotation coordinates there and back, at the edges of their charts, and poses of every motion.

use nalgebra::{Isometry2, Isometry3, SVector, UnitQuaternion};
use std::string::ToString;

use super::rotation::{coordinates_of_rotation, rotation_from_coordinates};
use super::*;
use crate::configuration::Configuration;
use crate::lie::so3;
use crate::private;
use crate::simd::Lanes;
use core::f64::consts::{FRAC_PI_2, PI};

/// The angle between two rotations.
fn apart(a: &UnitQuaternion<f64>, b: &UnitQuaternion<f64>) -> f64 {
    a.difference(b).norm()
}

/// Whether the first axis is also the last.
fn is_proper(sequence: EulerSequence) -> bool {
    sequence.axes[0] == sequence.axes[2]
}

/// An irregular sequence in (−1, 1).
fn noise(n: usize) -> f64 {
    (n as f64 * 12.9898 + 0.7).sin()
}

#[test]
fn twelve_sequences_of_angles() {
    for sequence in EulerSequence::ALL {
        assert!(sequence.is_valid());
        let chart = RotationChart::Euler(sequence);
        let axis = |n: usize| {
            let mut v = SVector::from([0.0; 3]);
            v[usize::from(sequence.axes[n])] = 1.0;
            v
        };
        for n in 0..200 {
            let outer = [PI * noise(3 * n), PI * noise(3 * n + 1)];
            // Down to 1e-9 from both singularities.
            let closeness = 10.0_f64.powi(-(n as i32 % 10));
            let middle = match (is_proper(sequence), n % 2) {
                (true, 0) => closeness,
                (true, _) => PI - closeness,
                (false, 0) => FRAC_PI_2 - closeness,
                (false, _) => closeness - FRAC_PI_2,
            };
            let angles = [outer[0], middle, outer[1]];
            let rotation = rotation_from_coordinates(chart, angles);
            // The definition: a product of three exponentials.
            let product =
                so3::exp(&(axis(0) * angles[0])) * so3::exp(&(axis(1) * angles[1])) * so3::exp(&(axis(2) * angles[2]));
            assert!(apart(&rotation, &product) < 1e-15, "{chart} {angles:?}");

            let back = coordinates_of_rotation(chart, &rotation).expect("regular");
            // Only the sum of the outer angles is well conditioned near the singularity.
            for i in [0, 2] {
                let error = (back[i] - angles[i]).abs();
                let error = error.min((error - 2.0 * PI).abs());
                assert!(error <= 2e-15 / closeness, "{chart} {angles:?} {back:?}");
            }
            assert!((back[1] - angles[1]).abs() < 1e-15, "{chart} {angles:?} {back:?}");
            assert!(apart(&rotation_from_coordinates(chart, back), &rotation) < 2e-15, "{chart} {angles:?}");
            // The opposite quaternion is the same rotation.
            let opposite = UnitQuaternion::new_unchecked(-rotation.into_inner());
            let other = coordinates_of_rotation(chart, &opposite).expect("regular");
            assert!(apart(&rotation_from_coordinates(chart, other), &rotation) < 2e-15);
        }
    }
}

#[test]
fn small_angles_keep_their_digits() {
    for sequence in EulerSequence::ALL.into_iter().filter(|sequence| !is_proper(*sequence)) {
        let chart = RotationChart::Euler(sequence);
        let angles: [f64; 3] = [1e-9, -3e-12, 2e-10];
        let back = coordinates_of_rotation(chart, &rotation_from_coordinates(chart, angles)).expect("regular");
        assert!((0..3).all(|i| (back[i] / angles[i] - 1.0).abs() < 1e-6), "{chart} {back:?}");
        assert_eq!(coordinates_of_rotation(chart, &UnitQuaternion::identity()), Ok([0.0; 3]));
    }
}

#[test]
fn gimbal_lock_is_an_error() {
    for sequence in EulerSequence::ALL {
        let chart = RotationChart::Euler(sequence);
        let locked = if is_proper(sequence) { [0.0, PI] } else { [FRAC_PI_2, -FRAC_PI_2] };
        for middle in locked {
            let rotation = rotation_from_coordinates(chart, [0.3, middle, -0.8]);
            match coordinates_of_rotation(chart, &rotation) {
                Err(ChartError::Singular { chart: named, angle, distance }) => {
                    assert_eq!(named, chart);
                    assert!((angle - middle).abs() < 1e-15 && distance < 1e-15, "{angle} {distance}");
                }
                other => panic!("{chart}: {other:?}"),
            }
        }
    }
    let error = coordinates_of_rotation(RotationChart::Euler(EulerSequence::ZXZ), &UnitQuaternion::<f64>::identity())
        .expect_err("singular");
    assert_eq!(
        error.to_string(),
        "the chart euler_zxz is singular here: its angle 0 rad is 0e0 rad from the singularity; \
         use another sequence of angles, or a chart without angles"
    );
    let invalid = EulerSequence { axes: [0, 0, 7] };
    let chart = RotationChart::Euler(invalid);
    let error = coordinates_of_rotation(chart, &rotation_from_coordinates(chart, [0.1, 0.2, 0.3]));
    assert_eq!(error, Err(ChartError::InvalidSequence { axes: [0, 0, 7] }));
}

#[test]
fn rodrigues_vectors() {
    for n in 0..100 {
        let direction = SVector::from([noise(n), noise(n + 500), noise(n + 900)]).normalize();
        let angle = 0.999 * PI * (0.5 + 0.5 * noise(n + 77));
        let rotation = so3::exp(&(direction * angle));
        let g = coordinates_of_rotation(RotationChart::Rodrigues, &rotation).expect("regular");
        let m = coordinates_of_rotation(RotationChart::ModifiedRodrigues, &rotation).expect("regular");
        for i in 0..3 {
            assert!((g[i] / ((angle / 2.0).tan() * direction[i]) - 1.0).abs() < 1e-11, "{angle}");
            assert!((m[i] - (angle / 4.0).tan() * direction[i]).abs() < 1e-15, "{angle}");
        }
        assert!(apart(&rotation_from_coordinates(RotationChart::Rodrigues, g), &rotation) < 1e-15);
        assert!(apart(&rotation_from_coordinates(RotationChart::ModifiedRodrigues, m), &rotation) < 1e-15);
        // The shadow set: the opposite quaternion gives the same short vector.
        let opposite = UnitQuaternion::new_unchecked(-rotation.into_inner());
        assert_eq!(coordinates_of_rotation(RotationChart::ModifiedRodrigues, &opposite), Ok(m));
    }
    let half = so3::exp(&SVector::from([0.0, PI, 0.0]));
    let error = coordinates_of_rotation(RotationChart::Rodrigues, &half);
    assert!(matches!(error, Err(ChartError::Singular { .. })), "{error:?}");
    let m = coordinates_of_rotation(RotationChart::ModifiedRodrigues, &half).expect("regular");
    assert!((m[1] - 1.0).abs() < 1e-15);
    // From outside the unit ball the answer is the shadow.
    let outside = rotation_from_coordinates(RotationChart::ModifiedRodrigues, [0.0, 0.0, 4.0_f64]);
    let inside: [f64; 3] = coordinates_of_rotation(RotationChart::ModifiedRodrigues, &outside).expect("regular");
    assert!((inside[2] + 0.25).abs() < 1e-15);
}

#[test]
fn packs_fail_when_a_lane_does() {
    let chart = RotationChart::Euler(EulerSequence::ZYX);
    let regular = rotation_from_coordinates(chart, [Lanes([0.1, 0.2]), Lanes([0.3, 0.4]), Lanes([0.5, -0.6])]);
    let back = coordinates_of_rotation(chart, &regular).expect("regular");
    assert!((back[2].0[1] + 0.6_f64).abs() < 1e-15);
    let locked = rotation_from_coordinates(chart, [Lanes([0.1, 0.2]), Lanes([0.3, FRAC_PI_2]), Lanes([0.5, -0.6])]);
    assert!(coordinates_of_rotation(chart, &locked).is_err());
}

#[test]
fn poses_of_every_motion() {
    let rotation = so3::exp(&SVector::from([0.3, -0.7, 0.2]));
    let pose = private::pose_of_rotation(&rotation);
    assert_eq!(private::rotation_of_pose(&pose), Ok(rotation));
    let moved = private::pose_from_quaternion(private::quaternion(&rotation), [0.0, 1e-3, 0.0]);
    assert_eq!(
        private::rotation_of_pose(&moved),
        Err(ChartError::Inexpressible { rule: MotionRule::FixedPoint { axis: 1 }, value: 1e-3 })
    );
    let chart = RotationChart::Euler(EulerSequence::ZYX);
    assert!(private::rotation_chart_of_pose(chart, &moved).is_err());
    let (angles, b) = private::chart_of_pose(chart, &moved).expect("regular");
    let again = private::pose_of_chart(chart, angles, b);
    assert!(Configuration::difference(&moved, &again).amax() < 1e-15);
    let nothing: Isometry3<f64> = private::pose_from_quaternion([0.0, 0.0, 0.0, f64::NAN], [0.0; 3]);
    assert_eq!(private::chart_of_pose(chart, &nothing), Err(ChartError::NonFinite));

    for n in 0..50 {
        let theta = PI * noise(n);
        let plane = Isometry2::new(nalgebra::Vector2::new(0.4, -0.9), theta);
        let pose = private::pose_of_plane(&plane);
        let back = private::plane_of_pose(&pose).expect("planar");
        assert!(Configuration::difference(&plane, &back).amax() < 1e-15, "{theta}");
        let jet = private::plane_chart_of_pose(&pose).expect("planar");
        assert!((jet[0] - 0.4).abs() + (jet[1] + 0.9).abs() + (jet[2] - theta).abs() < 1e-15);
        assert!(Configuration::difference(&private::pose_of_plane_chart(jet), &pose).amax() < 1e-15);
    }
    let tilted = private::pose_of_rotation(&rotation);
    assert!(matches!(
        private::plane_of_pose(&tilted),
        Err(ChartError::Inexpressible { rule: MotionRule::Upright, .. })
    ));
    let raised = Isometry3::translation(0.0, 0.0, 2.0);
    assert_eq!(
        private::plane_chart_of_pose(&raised).expect_err("raised").to_string(),
        "a planar body has O in the plane k1 k2, so b3 must be 0, but it is 2e0"
    );
}

#[test]
fn containers() {
    let m = nalgebra::Matrix2x3::new(1.0, 2.0, 3.0, 4.0, 5.0, 6.0);
    assert_eq!(private::entries(&m), [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]);
    assert_eq!(private::matrix([[1.0, 2.0], [3.0, 4.0]]), nalgebra::Matrix2::new(1.0, 2.0, 3.0, 4.0));
    assert_eq!(private::components(&private::vector([1.0, 2.0])), [1.0, 2.0]);
    let q = UnitQuaternion::from_euler_angles(0.1_f64, 0.2, 0.3);
    assert_eq!(private::quaternion(&q), [q.i, q.j, q.k, q.w]);
    let plane = Isometry2::new(nalgebra::Vector2::new(1.0, 2.0), 0.5);
    assert_eq!(private::isometry2(&plane), ([0.5_f64.cos(), 0.5_f64.sin()], [1.0, 2.0]));
}

#[test]
fn names() {
    assert_eq!(Chart::LeftInvariant.to_string(), "left_invariant");
    assert_eq!(Chart::Jet(RotationChart::Euler(EulerSequence::ZYX)).to_string(), "jet(euler_zyx)");
    assert_eq!(Chart::Jet(RotationChart::ModifiedRodrigues).to_string(), "jet(modified_rodrigues)");
    assert_eq!(Chart::Jet(RotationChart::Angle).to_string(), "jet");
}
