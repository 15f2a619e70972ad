//! Bad input and hard places: a clear answer or a right one, never a wrong one in silence.

use gauss_runtime::chart::{ChartError, convert};
use gauss_runtime::error::Rule;
use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(motion = fixed_point)]
struct Body {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
}

#[derive(GaussDynamics)]
#[gauss(chart = jet(euler_zyx), motion = fixed_point)]
struct Angles {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
}

#[derive(GaussDynamics)]
struct OffCentre {
    #[gauss(mass)]
    mass: f64,
    #[gauss(center_of_mass)]
    center: Vector3<f64>,
    #[gauss(inertia)]
    inertia: Matrix3<f64>,
    #[gauss(gravity)]
    g: f64,
}

const INERTIA: [f64; 3] = [1.0, 2.0, 2.5];

#[test]
fn a_chart_near_its_singularity_is_right_or_refused() {
    let body = Body { mass: 1.0, inertia: Vector3::from(INERTIA) }.kernel().expect("a body");
    let angles = Angles { mass: 1.0, inertia: Vector3::from(INERTIA) }.kernel().expect("a body");
    let mut refused = Vec::new();
    for distance in [0.0, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-3, 1e-2, 0.1] {
        let q = Vector3::new(0.0, std::f64::consts::FRAC_PI_2 - distance, 0.0);
        let z = Vector3::new(1.0, 0.5, 0.2);
        let run = Simulation::new(&angles).adaptive(1e-13, 1e-14).max_steps(200_000).run(q, z, 0.0..1.0);
        let (end, excess) = match run {
            Err(error) => {
                assert!(
                    matches!(
                        error.kind,
                        IntegrationErrorKind::SingularChart { .. }
                            | IntegrationErrorKind::StepTooSmall { .. }
                            | IntegrationErrorKind::TooManySteps { .. }
                    ),
                    "{error}"
                );
                refused.push(distance);
                continue;
            }
            Ok(path) => (angles.pose(1.0, &path.last().q), path.summary().excess),
        };
        let start = body.configuration(&angles.pose(0.0, &q)).expect("a rotation");
        let omega = body.speeds(0.0, &start, &angles.body_twist(0.0, &q, &z));
        let truth = Simulation::new(&body).adaptive(1e-12, 1e-12).run(start, omega, 0.0..1.0).expect("no singularity");
        // Some 1e-11 a step over some hundreds of steps, a hundred times the tolerance because estimates of order 8 are
        // optimistic this near; and rounding of the angles divided by the distance.
        let allowed = 1e-8 + 1e3 * f64::EPSILON / distance;
        // Where rounding is more than the tolerance the run says so: accelerations are up to 1/distance² of what rounds
        // them.
        let allowed = if excess > 0.0 { allowed + 8.0 * f64::EPSILON / (distance * distance) } else { allowed };
        let error = end.rotation.angle_to(&truth.last().q);
        assert!(error < allowed, "{error:e} rad at {distance:e} from gimbal lock, allowed {allowed:e}");
    }
    assert!(refused.starts_with(&[0.0, 1e-12, 1e-10, 1e-8]), "gimbal lock must be refused: {refused:?}");
    assert!(refused.iter().all(|d| *d < 1e-3), "a milliradian away is regular: {refused:?}");
}

#[test]
fn steps_over_a_singularity_are_refused() {
    let angles = Angles { mass: 1.0, inertia: Vector3::from(INERTIA) }.kernel().expect("a body");
    // θ̇ carries the body straight through θ = π/2 within one step.
    let (q, z) = (Vector3::new(0.0, 1.5, 0.0), Vector3::new(0.0, 2.0, 0.0));
    let error = Simulation::new(&angles).fixed_step(0.1).run(q, z, 0.0..1.0).expect_err("it passes gimbal lock");
    assert!(matches!(error.kind, IntegrationErrorKind::SingularChart { .. }), "{error}");
    // The regularity is the cosine of the middle angle, up to its sign.
    for theta in [-1.0, 0.0, 0.3, 1.57, 2.0] {
        let regularity = angles.regularity(0.0, &Vector3::new(0.4, theta, -0.7));
        assert!((regularity.abs() - f64::cos(theta).abs()).abs() < 1e-15, "{regularity} at {theta}");
    }
}

#[test]
fn conversion_refuses_what_it_would_spoil() {
    let body = Body { mass: 1.0, inertia: Vector3::from(INERTIA) }.kernel().expect("a body");
    let angles = Angles { mass: 1.0, inertia: Vector3::from(INERTIA) }.kernel().expect("a body");
    for distance in [1e-12, 1e-9, 1e-6, 1e-3] {
        let q = UnitQuaternion::from_euler_angles(0.3, std::f64::consts::FRAC_PI_2 - distance, -0.2);
        let z = Vector3::new(0.4, -0.2, 0.7);
        match convert(&body, &q, &z, &angles) {
            Err(error) => assert!(matches!(error, ChartError::Singular { .. }) && distance < 1e-7, "{error}"),
            Ok((angle, speeds)) => {
                let back = angles.body_twist(0.0, &angle, &speeds);
                let error = (0..3).map(|k| (back[3 + k] - z[k]).abs()).fold(0.0, f64::max);
                assert!(error < 64.0 * f64::EPSILON / distance, "{error:e} at {distance:e}");
            }
        }
    }
}

fn rules(body: &OffCentre) -> Vec<Rule> {
    body.kernel().err().map(|e| e.violations().iter().map(|v| v.rule).collect()).unwrap_or_default()
}

#[test]
fn no_accepted_parameters_give_a_number_that_is_none() {
    let steiner = |c: Vector3<f64>| Matrix3::identity() * c.norm_squared() - c * c.transpose();
    let lever = Vector3::new(0.1, 0.2, 0.3);
    let bodies = [
        // All mass in one point away from O: nothing is left about the centre of mass.
        (1.0, lever, steiner(lever)),
        (1.0, lever, steiner(lever) + Matrix3::identity() * 1e-17),
        (1.0, Vector3::new(0.0, 0.0, 1.0), Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 1e-17))),
        // Units that leave the range of doubles.
        (1.0, Vector3::new(1e200, 0.0, 0.0), Matrix3::identity()),
        (1.0, Vector3::new(1e150, 0.0, 0.0), Matrix3::identity() * 1e301),
        (1.0, lever * 1e-200, Matrix3::identity() * 1e-310),
        (1e-310, lever, Matrix3::identity()),
        (1.0, lever, Matrix3::identity() * 1e300),
        (1e150, lever, Matrix3::identity() * 1e150),
        (1e-150, lever, Matrix3::identity() * 1e-150),
    ];
    let mut refused = 0;
    for (mass, center, inertia) in bodies {
        let body = OffCentre { mass, center, inertia, g: 9.81 };
        match body.kernel() {
            Err(_) => {
                assert!(!rules(&body).is_empty());
                refused += 1;
            }
            Ok(kernel) => {
                let z = Vector6::new(1.0, -0.5, 0.3, 0.2, 0.4, -0.6);
                let rate = kernel.acceleration(0.0, &Isometry3::identity(), &z, &());
                assert!(rate.iter().all(|a| f64::is_finite(*a)), "{mass:e} {center:?} {inertia:?} gives {rate:?}");
            }
        }
    }
    assert!(refused >= 5, "only {refused} of the bodies were refused");
}

/// x″ = −x by hand: what integrators do with times is seen best where the motion is known.
#[derive(GaussDynamics)]
#[gauss(motion = planar, chart = hybrid)]
struct Puck {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: f64,
    #[gauss(gravity)]
    g: f64,
}

#[test]
fn fixed_steps_end_where_they_should() {
    let puck = Puck { mass: 1.0, inertia: 1.0, g: 0.0 }.kernel().expect("a body");
    for (step, end) in [((1.0 + 3e-10) / 3.0, 1000.0), (0.001 * (1.0 + 9e-10), 1.0), (0.7, 7.0), (0.01, 10.0)] {
        let z = Vector3::new(1.0, 0.0, 0.0);
        let path =
            Simulation::new(&puck).fixed_step(step).run(Isometry2::identity(), z, 0.0..end).expect("straight on");
        let x = path.last().q.translation.x;
        // At unit speed the position is the time: a few roundings a step, of random sign.
        let steps = end / step;
        assert!((x - end).abs() < 8.0 * steps.sqrt() * f64::EPSILON * end, "{x} at {end} with steps of {step}");
        assert_eq!(path.last().t, end);
    }
}

#[test]
fn a_purely_relative_tolerance_starts_from_rest() {
    let puck = Puck { mass: 1.0, inertia: 1.0, g: 2.0 }.kernel().expect("a body");
    let rest = Vector3::zeros();
    let path = Simulation::new(&puck).adaptive(1e-9, 0.0).run(Isometry2::identity(), rest, 0.0..1.0).expect("it falls");
    // y = −g t²/2, which a method of order 5 has exactly.
    assert!((path.last().q.translation.y + 1.0).abs() < 1e-12);
}
