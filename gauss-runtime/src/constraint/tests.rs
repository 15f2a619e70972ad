//! Projection: on which state, how near, in any scalar, and what is said where there is none.

use nalgebra::SVector;
use std::string::ToString;

use super::*;
use crate::simd::Lanes;
use crate::testing::constrained::{Constraint, Hand, circle, line, on_both, pendulum, skate};
use crate::testing::dual::dual;

/// The rounding of x² + y² − 1 at the nearest representable point: ½ε of each product and of their sum, and ε for that
/// of the point itself.
const ROUNDING: f64 = 2.0 * f64::EPSILON;

#[test]
fn a_point_comes_back_to_the_circle_along_the_radius() {
    let system = pendulum::<f64>(2.0);
    // Equal masses: the nearest point is on the same ray at each correction. Newton overshoots from near the centre.
    for scale in [1.0 + 1e-12, 1.001, 0.3, 5.0, 1e6, 1e-6] {
        let q = SVector::from([0.6 * scale, -0.8 * scale]);
        let (q, z) = system.project(0.0, &q, &SVector::from([1.0, 2.0])).expect("there is a nearest point");
        assert!((q - SVector::from([0.6, -0.8])).amax() <= 2.0 * f64::EPSILON, "from {scale}: {q}");
        assert!(system.position_residual(0.0, &q).amax() <= ROUNDING);
        // The radial part of the velocity goes: 1·0.6 − 2·0.8 = −1 along (0.6, −0.8).
        assert!((z - SVector::from([1.6, 1.2])).amax() <= 8.0 * f64::EPSILON, "from {scale}: {z}");
        assert!(system.velocity_residual(0.0, &q, &z).amax() <= 4.0 * ROUNDING);
    }
}

#[test]
fn corrections_are_least_in_the_metric_of_the_kinetic_energy() {
    let system = Hand { mass: [1.0, 4.0], ..pendulum::<f64>(1.0) };
    let (q, z) = (SVector::from([0.6, -0.8]), SVector::from([1.0, 2.0]));
    let (_, projected) = system.project(0.0, &q, &z).expect("satisfied in positions");
    // A Δz is a multiple of the row of J: Δz = −(−2)(0.6, −0.2)/(2 (0.36 + 0.16)).
    let change = (projected - z) * 0.52;
    assert!((change - SVector::from([0.6, -0.2])).amax() < 8.0 * f64::EPSILON, "{change}");
    let energy = |z: &SVector<f64, 2>| system.kinetic_energy(0.0, &q, z);
    let tangent = SVector::from([0.8, 0.6]);
    for other in [projected + 0.1 * tangent, projected - 0.1 * tangent] {
        assert!(energy(&(other - z)) > energy(&(projected - z)));
    }
}

#[test]
fn a_state_on_the_constraints_stays() {
    let (q, z) = (SVector::from([0.0, -1.0]), SVector::from([3.0, 0.0]));
    assert_eq!(pendulum::<f64>(2.0).project(0.0, &q, &z), Ok((q, z)));
    // An edge at 45° through velocities that are equal.
    let (q, z) = (SVector::from([5.0, -3.0, core::f64::consts::FRAC_PI_4]), SVector::from([0.5, 0.5, 4.0]));
    let (found, speeds) = skate().project(0.0, &q, &z).expect("satisfied");
    assert_eq!(found, q);
    assert!((speeds - z).amax() <= f64::EPSILON);
}

#[test]
fn velocity_constraints_leave_positions_alone() {
    let q = SVector::from([5.0, -3.0, 0.3]);
    let (found, z) = skate().project(0.0, &q, &SVector::from([1.0, 1.0, 4.0])).expect("is affine in z");
    assert_eq!(found, q);
    // The part across the edge goes.
    let along = 0.3_f64.cos() + 0.3_f64.sin();
    let expected = SVector::from([along * 0.3_f64.cos(), along * 0.3_f64.sin(), 4.0]);
    assert!((z - expected).amax() < 4.0 * f64::EPSILON, "{z}");
}

#[test]
fn every_scalar_is_projected_in_its_own_precision() {
    let q = SVector::from([0.7_f32, -0.8]);
    let (q, z) = pendulum::<f32>(2.0).project(0.0, &q, &SVector::from([1.0, 1.0])).expect("is near");
    assert!(pendulum::<f32>(2.0).position_residual(0.0, &q).amax() <= 2.0 * f32::EPSILON);
    assert!(pendulum::<f32>(2.0).velocity_residual(0.0, &q, &z).amax() <= 8.0 * f32::EPSILON);

    // One lane is there already, the other is far.
    let (x, y) = (Lanes([0.0, 3.0]), Lanes([-1.0, 4.0]));
    let zero = Lanes([0.0; 2]);
    let (q, _) = pendulum::<Lanes<f64, 2>>(2.0)
        .project(zero, &SVector::from([x, y]), &SVector::from([zero, zero]))
        .expect("each lane by itself");
    assert_eq!([q[0].0[0], q[1].0[0]], [0.0, -1.0]);
    assert!((q[0].0[1] - 0.6).abs() <= f64::EPSILON && (q[1].0[1] - 0.8).abs() <= f64::EPSILON);
}

#[test]
fn derivatives_are_projected_too() {
    let (zero, system) = (dual(0.0, 0.0), pendulum::<crate::testing::dual::TestDual>(2.0));
    // Values satisfy both levels exactly; derivatives do not: (x, y)·(dx, dy) = −0.5.
    let (q, z) = (SVector::from([dual(0.0, 0.3), dual(-1.0, 0.5)]), SVector::from([dual(2.0, 0.7), dual(0.0, 0.0)]));
    let (q, z) = system.project(zero, &q, &z).expect("satisfied");
    assert_eq!([q[0], q[1]], [dual(0.0, 0.3), dual(-1.0, 0.0)]);
    // d(x u + y v) = 0.3·2 − dv.
    assert_eq!([z[0], z[1]], [dual(2.0, 0.7), dual(0.0, 0.6)]);

    // From far away the derivative of the result is that of q/|q|, for which a correction at the settled values is
    // needed.
    let q = SVector::from([dual(3.0, 1.0), dual(4.0, 0.0)]);
    let (q, _) = system.project(zero, &q, &SVector::from([zero, zero])).expect("is found");
    assert!((q[0].rate - 0.128).abs() < 1e-15 && (q[1].rate + 0.096).abs() < 1e-15, "{q:?}");
}

#[test]
fn multipliers_are_the_forces_of_the_constraints() {
    // Through the lowest point at 3 m/s the string pulls with m (g + v²/l), upwards; Jᵀ = (0, −2).
    let system = pendulum::<f64>(2.0);
    let (q, z) = (SVector::from([0.0, -1.0]), SVector::from([3.0, 0.0]));
    let [multiplier] = system.multipliers(0.0, &q, &z, &()).data.0[0];
    let tension = 2.0 * (crate::testing::constrained::GRAVITY + 9.0);
    assert!((-2.0 * multiplier - tension).abs() <= 4.0 * f64::EPSILON * tension, "{multiplier}");
}

#[test]
fn constraints_without_a_common_point_are_named() {
    // The circle and x = 2: y² = −3. Corrections wander for ever.
    let apart = on_both(circle(), line(|_, [x, _]| x - 2.0, |_, _, [u, _]| u));
    let rest = SVector::zeros();
    let error = apart.project(0.0, &SVector::from([0.6, -0.8]), &rest).expect_err("is not there");
    assert_eq!((error.level, error.failure), (ConstraintLevel::Position, ProjectionFailure::NotConverged));
    // Nowhere are both residuals below (5 − √13)/2: there |x² − 1| = |x − 2|, with y = 0.
    assert!(error.residual >= (5.0 - 13.0_f64.sqrt()) / 2.0 - 1e-12, "{error:?}");
    // On the circle, and 1.4 from the line.
    assert!((error.given - 1.4).abs() < 1e-15, "{error:?}");
    let text = error.to_string();
    assert!(text.contains("corrections of the position do not settle") && text.contains("contradict"), "{text}");

    // x = 2 and x = 0: equal rows.
    let parallel = on_both(line(|_, [x, _]| x, |_, _, [u, _]| u), line(|_, [x, _]| x - 2.0, |_, _, [u, _]| u));
    let error = parallel.project(0.0, &SVector::from([0.6, -0.8]), &rest).expect_err("is not there");
    assert_eq!((error.level, error.failure), (ConstraintLevel::Position, ProjectionFailure::NonFinite));
    assert!(error.to_string().contains("depend on one another"), "{error}");

    // Same place, different velocities.
    let torn = on_both(
        line(|_, [x, _]| x, |_, _, [u, _]| u),
        Constraint { level: ConstraintLevel::Velocity, ..line(|_, [x, _]| x, |_, _, [u, _]| u - 1.0) },
    );
    let error = torn.project(0.0, &SVector::from([0.0, -0.8]), &rest).expect_err("is not there");
    assert_eq!((error.level, error.failure), (ConstraintLevel::Velocity, ProjectionFailure::NonFinite));
}

/// The gradient of a square vanishes where it holds, so that no force holds it there: that is said wherever the search
/// begins, and of no place where the constraint fails.
#[test]
fn squares_are_told_from_constraints_out_of_reach() {
    let square = |position, velocity, row| Hand::<f64, 2, 1> {
        constraints: [Constraint {
            level: ConstraintLevel::Position,
            position,
            velocity,
            row,
            bias: |_, _, [u, _]| 2.0 * u * u,
        }],
        ..pendulum::<f64>(1.0)
    };
    let one = square(
        |_, [x, _]| (x - 1.0) * (x - 1.0),
        |_, [x, _], [u, _]| 2.0 * (x - 1.0) * u,
        |_, [x, _]| [2.0 * (x - 1.0), 0.0],
    );
    let both =
        square(|_, [x, y]| x * x + y * y, |_, [x, y], [u, v]| 2.0 * (x * u + y * v), |_, [x, y]| [2.0 * x, 2.0 * y]);
    let rest = SVector::zeros();
    for (system, starts) in [
        (one, [[1.0, 0.0], [0.0, 0.0], [1.5, 0.3], [-7.0, 0.3]]),
        (both, [[0.0, 0.0], [1.0, 0.0], [1.5, 0.3], [-7.0, 0.3]]),
    ] {
        for start in starts {
            let error = system.project(0.0, &SVector::from(start), &rest).expect_err("nothing holds it");
            assert_eq!(
                (error.level, error.failure),
                (ConstraintLevel::Position, ProjectionFailure::Singular),
                "{start:?}"
            );
            assert!(
                error.residual <= f64::EPSILON
                    && error.given == system.position_residual(0.0, &SVector::from(start)).amax()
            );
            let text = error.to_string();
            assert!(text.contains("the constraints hold") && text.contains("gradient that vanishes"), "{text}");
        }
    }
    // Nowhere zero, whatever its gradient is at its least.
    let never = square(|_, [x, _]| x * x + 1.0, |_, [x, _], [u, _]| 2.0 * x * u, |_, [x, _]| [2.0 * x, 0.0]);
    for start in [0.0, 1.0, 1.5] {
        let error = never.project(0.0, &SVector::from([start, 0.0]), &rest).expect_err("is not there");
        assert!(error.failure != ProjectionFailure::Singular && error.residual >= 1.0, "{error:?}");
    }
}

/// `sin x + x/20 − ½` has one real zero beyond hills that do not reach it.
fn waves() -> Hand<f64, 2, 1> {
    let position = |_, [x, _]: [f64; 2]| x.sin() + 0.05 * x - 0.5;
    Hand {
        constraints: [Constraint {
            level: ConstraintLevel::Position,
            position,
            velocity: |_, [x, _], [u, _]| (x.cos() + 0.05) * u,
            row: |_, [x, _]| [x.cos() + 0.05, 0.0],
            bias: |_, [x, _], [u, _]| x.sin() * u * u,
        }],
        ..pendulum::<f64>(1.0)
    }
}

#[test]
fn success_means_that_only_rounding_is_left() {
    let system = waves();
    let (mut found, mut refused) = (0, 0);
    for k in 0..4000 {
        let q = SVector::from([-20.0 + 0.01 * f64::from(k), 0.3]);
        match system.project(0.0, &q, &SVector::from([1.0, 2.0])) {
            Ok((q, z)) => {
                found += 1;
                // ½ε of sin x ≤ 1, of x/20 ≤ 1 and of their sums, and of x itself times the slope 1.05.
                let rounding = f64::EPSILON * (2.0 + q[0].abs());
                assert!(system.position_residual(0.0, &q).amax() <= rounding, "{q}");
                assert!(system.velocity_residual(0.0, &q, &z).amax() <= 4.0 * f64::EPSILON, "{z}");
            }
            Err(error) => {
                refused += 1;
                assert_eq!(error.failure, ProjectionFailure::NotConverged);
                assert!(error.residual > 1e-3, "{error:?}");
            }
        }
    }
    // From −9.275 whole corrections go round the hill for ever, and ended before where the residual is −1.3.
    assert!(system.project(0.0, &SVector::from([-9.275, 0.3]), &SVector::zeros()).is_ok());
    assert!(found >= 3900, "{found} found, {refused} refused");
}

#[test]
fn nothing_undefined_passes() {
    let system = pendulum::<f64>(2.0);
    let rest = SVector::zeros();
    // No direction to go.
    let error = system.project(0.0, &SVector::zeros(), &rest).expect_err("has no nearest point");
    assert_eq!(error.failure, ProjectionFailure::NonFinite);
    assert_eq!(error.residual, 1.0);
    for bad in [f64::NAN, f64::INFINITY] {
        let error = system.project(0.0, &SVector::from([bad, 0.0]), &rest).expect_err("is refused");
        assert_eq!((error.level, error.failure), (ConstraintLevel::Position, ProjectionFailure::NonFinite));
        let error =
            system.project(0.0, &SVector::from([0.0, 1.0]), &SVector::from([bad, 0.0])).expect_err("is refused");
        assert_eq!((error.level, error.failure), (ConstraintLevel::Velocity, ProjectionFailure::NonFinite));
    }
    // Also where no constraint looks.
    let error = skate().project(0.0, &SVector::from([f64::NAN, 0.0, 0.0]), &SVector::zeros()).expect_err("is refused");
    assert_eq!(error.failure, ProjectionFailure::NonFinite);
}
