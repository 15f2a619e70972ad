//! Suslov's problem: a body about a fixed point that does not turn about e₃ of its own.

use gauss_runtime::prelude::*;
use gauss_tests::laws::{Time, constrained_laws, corresponds, laws, least};
use gauss_tests::nonholonomic::rigid_state;
use gauss_tests::trajectory::{Run, reference, rotation};
use proptest::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(attitude: Rotation),
    speeds(w: Vector3),
    kinematics(attitude = w),
    body(rotation = attitude),
    constraint(velocity = w.z),
)]
struct WithMultiplier {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    j: Matrix3<f64>,
}

#[derive(GaussDynamics)]
#[gauss(
    coordinates(attitude: Rotation),
    speeds(w1, w2, w3),
    kinematics(attitude = [w1, w2, w3]),
    body(spider, rotation = attitude),
    constraint(velocity = dot(spider.angular_velocity, spider.rotation * [0, 0, 1])),
    independent(w1, w2),
)]
struct Eliminated {
    #[gauss(body)]
    spider: RigidBody<f64>,
}

#[derive(GaussDynamics)]
#[gauss(
    coordinates(attitude: Rotation),
    speeds(w1, w2),
    kinematics(attitude = [w1, w2, 0]),
    body(rotation = attitude)
)]
struct OwnSpeeds {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    j: Matrix3<f64>,
}

/// In Euler angles with their rates for speeds.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(phi, theta, psi),
    body(rotation = rotation_z(phi) * rotation_x(theta) * rotation_z(psi)),
    constraint(velocity = rate(psi) + cos(theta) * rate(phi)),
)]
struct EulerAngles {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    j: Matrix3<f64>,
}

fn inertia() -> Matrix3<f64> {
    Matrix3::new(1.0, 0.0, 0.3, 0.0, 1.5, -0.2, 0.3, -0.2, 2.0)
}

fn with_multiplier() -> WithMultiplierKernel {
    WithMultiplier { m: 1.0, j: inertia() }.kernel().unwrap()
}

fn own_speeds() -> OwnSpeedsKernel {
    OwnSpeeds { m: 1.0, j: inertia() }.kernel().unwrap()
}

fn euler_angles() -> EulerAnglesKernel {
    EulerAngles { m: 1.0, j: inertia() }.kernel().unwrap()
}

fn eliminated() -> EliminatedKernel {
    let spider = RigidBody { mass: 1.0, center_of_mass: Vector3::zeros(), inertia: inertia() };
    Eliminated { spider }.kernel().unwrap()
}

/// The angles (φ, θ, ψ) of R = R_z(φ) R_x(θ) R_z(ψ) and their rates.
fn angles(rotation: &UnitQuaternion<f64>, w: [f64; 3]) -> (SVector<f64, 3>, SVector<f64, 3>) {
    let r = rotation.to_rotation_matrix().into_inner();
    let (theta, psi) = (r[(2, 2)].acos(), r[(2, 0)].atan2(r[(2, 1)]));
    let (s, c) = psi.sin_cos();
    let precession = (w[0] * s + w[1] * c) / theta.sin();
    let rates = [precession, w[0] * c - w[1] * s, w[2] - precession * theta.cos()];
    (SVector::from([r[(0, 2)].atan2(-r[(1, 2)]), theta, psi]), SVector::from(rates))
}

/// The other way round.
fn of_angles(q: &SVector<f64, 3>, rates: &SVector<f64, 3>) -> (UnitQuaternion<f64>, Vector3<f64>) {
    let axes = [Vector3::z_axis(), Vector3::x_axis(), Vector3::z_axis()];
    let turns: Vec<_> = (0..3).map(|k| UnitQuaternion::from_axis_angle(&axes[k], q[k])).collect();
    let ((s, c), (sine, cosine)) = (q[2].sin_cos(), q[1].sin_cos());
    let [precession, nutation, spin]: [f64; 3] = (*rates).into();
    let about = [precession * sine * s + nutation * c, precession * sine * c - nutation * s];
    (turns[0] * turns[1] * turns[2], Vector3::new(about[0], about[1], precession * cosine + spin))
}

#[test]
fn every_way_gives_the_reference() {
    let name = "suslov";
    let start = rotation(&reference(name)["initial"]["R"]);
    let observe = |rotation: &UnitQuaternion<f64>, omega: [f64; 3]| {
        rigid_state(&Isometry3::from_parts(Translation3::identity(), *rotation), Vector3::zeros(), omega.into())
    };
    let (two, three) = (SVector::from([1.2, -0.5]), SVector::from([1.2, -0.5, 0.0]));
    let full = |_: f64, q: &UnitQuaternion<f64>, z: &Vector3<f64>| observe(q, [z[0], z[1], z[2]]);
    let reduced = |_: f64, q: &UnitQuaternion<f64>, z: &SVector<f64, 2>| observe(q, [z[0], z[1], 0.0]);
    Run { name, system: &with_multiplier(), start: (start, three) }.agrees(1.0, full);
    Run { name, system: &eliminated(), start: (start, two) }.agrees(1.0, reduced);
    Run { name, system: &own_speeds(), start: (start, two) }.agrees(1.0, reduced);
    let start = angles(&start, [1.2, -0.5, 0.0]);
    Run { name, system: &euler_angles(), start }.agrees(1.0, |_, q, z| {
        let (rotation, omega) = of_angles(q, z);
        observe(&rotation, omega.into())
    });
}

#[test]
fn the_motion_goes_from_one_steady_rotation_to_the_other() {
    // Steady rotations have I₁₃ω₁ + I₂₃ω₂ = 0; the one with e₃ × (I₁₃, I₂₃)·ω of one sign repels, the other attracts.
    let kernel = eliminated();
    let start = SVector::from([1.2, -0.5]);
    let rotation = UnitQuaternion::identity();
    let late = |end: f64| {
        let run = Simulation::new(&kernel).adaptive(1e-12, 1e-14).run_to_end(rotation, start, 0.0..end).unwrap();
        (0.3 * run.z[0] - 0.2 * run.z[1], kernel.energy(run.t, &run.q, &run.z), run.z)
    };
    let energy = kernel.energy(0.0, &rotation, &start);
    let (forward, after, final_speeds) = late(80.0);
    let (backward, before, first_speeds) = late(-80.0);
    // It decays like e^{−kt} with k = I₁₃ω₂/I₁₁ − I₂₃ω₁/I₂₂ = 0.38: e^{−30} is left of it, and the errors of the run.
    assert!(forward.abs() < 1e-9 && backward.abs() < 1e-9, "{forward:e} {backward:e}");
    assert!((after - energy).abs() < 1e-10 && (before - energy).abs() < 1e-10);
    assert!((final_speeds + first_speeds).amax() < 1e-8, "{first_speeds} {final_speeds}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn laws_agreement_and_the_moment_of_the_constraint(
        turn in prop::array::uniform3(-1.5..1.5), z in prop::array::uniform2(-3.0..3.0),
    ) {
        let rotation = UnitQuaternion::from_scaled_axis(Vector3::from(turn) + Vector3::new(0.1, 1.7, 0.0));
        let (two, three) = (SVector::from(z), Vector3::new(z[0], z[1], 0.0));
        let (full, reduced, own) = (with_multiplier(), eliminated(), own_speeds());
        laws(&full, 0.0, &rotation, &three, Time::Absent);
        constrained_laws(&full, 0.0, &rotation, &three);
        laws(&reduced, 0.0, &rotation, &two, Time::Absent);
        laws(&own, 0.0, &rotation, &two, Time::Absent);
        least(&reduced, 0.0, &rotation, &two);
        least(&own, 0.0, &rotation, &two);

        let rate = full.acceleration(0.0, &rotation, &three, &());
        // Euler's equations with a moment about e₃ alone.
        let moment = inertia() * rate + three.cross(&(inertia() * three));
        let close = |a: f64, b: f64| (a - b).abs() <= 1e-13;
        prop_assert!(close(moment.x, 0.0) && close(moment.y, 0.0) && close(rate.z, 0.0), "{moment} {rate}");
        for lambda in [full.multipliers(0.0, &rotation, &three, &())[0], reduced.multipliers(0.0, &rotation, &two, &())[0]] {
            prop_assert!(close(lambda, moment.z), "{lambda} {moment}");
        }
        for other in [reduced.acceleration(0.0, &rotation, &two, &()), own.acceleration(0.0, &rotation, &two, &())] {
            prop_assert!(close(other[0], rate.x) && close(other[1], rate.y), "{other} {rate}");
        }

        let euler = euler_angles();
        let (q, rates) = angles(&rotation, [z[0], z[1], 0.0]);
        prop_assume!(q[1].sin() > 0.3);
        laws(&euler, 0.0, &q, &rates, Time::Absent);
        constrained_laws(&euler, 0.0, &q, &rates);
        corresponds(&euler, &full, 0.0, (&q, &rates), |_, q, z| of_angles(q, z));
        let turned = euler.multipliers(0.0, &q, &rates, &())[0];
        // Divided by sin θ up to twice, with rates of angles up to ten.
        prop_assert!((turned - moment.z).abs() <= 1e-11, "{turned} {moment}");
    }
}
