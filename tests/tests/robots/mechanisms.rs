//! Mechanisms of MJCF files against clauses that say the same, and against MuJoCo: joints that follow others, points
//! and places in common, ranges, classes and weights that are held.

use gauss_runtime::prelude::*;

use super::EPSILON;

#[derive(GaussDynamics)]
#[gauss(mjcf = "robots/linkage.xml", inputs = actuators, limits = none)]
struct Linkage;

/// The same in clauses: one rotor for the armature, the joints that share a body as one rotation.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(yaw, pitch, socket: Rotation),
    input(turn, servo, pull),
    body(
        arm,
        position = [0, 0, 0.9] + rotation_y(pi / 2) * rotation_z(yaw) * rotation_y(pitch - pi / 18) * [-0.1, 0, 0],
        rotation = rotation_y(pi / 2) * rotation_z(yaw) * rotation_y(pitch - pi / 18)
    ),
    body(
        bob, parent = arm, position = [0.6, 0, 0], rotation = socket, mass = 0.5, center_of_mass = [0.1, 0, 0.05],
        inertia_about_center_of_mass = [1e-3, 1e-4, 0, 2e-3, 0, 2e-3]
    ),
    body(cart, position = [5.2 + yaw / 2, 0, 0], mass = 1.2, inertia = [1.3, 1.0, 0.5]),
    body(rotor, rotation = rotation_z(pitch), mass = 0.0, inertia = [0, 0, 0.02]),
    spring(along = pitch, stiffness = 3.0, length = pi / 6),
    damping = 0.05 * (1.25 * rate(yaw) * rate(yaw) + rate(pitch) * rate(pitch))
        + 0.15 * dot(socket.body_angular_velocity, socket.body_angular_velocity),
    define(tie = yaw / 2 - pitch),
    spring(along = tie, stiffness = 4.0, length = 0.1, damping = 0.2),
    define(
        of_servo = 3 * servo - 3 * (2 * pitch) - 0.4 * rate(2 * pitch),
        of_tendon = 5 * pull + 0.5 - tie - 0.1 * rate(tie)
    ),
    drive(yaw = turn + 0.5 * of_tendon, pitch = 2 * of_servo - of_tendon),
    gravity = 9.81
)]
struct LinkageInClauses {
    #[gauss(body)]
    arm: RigidBody<f64, AboutCenterOfMass<f64>>,
}

#[test]
fn a_mechanism_of_many_joints() {
    let turn = UnitQuaternion::from_quaternion(Quaternion::new(0.9, 0.1, -0.2, 0.3));
    let r = *turn.to_rotation_matrix().matrix();
    let inertia = r * Matrix3::from_diagonal(&Vector3::new(0.01, 0.02, 0.025)) * r.transpose();
    let arm = RigidBody::about_center_of_mass(2.0, Vector3::new(0.3, 0.0, 0.0), inertia);
    let (clauses, file) = (LinkageInClauses { arm }.kernel().unwrap(), Linkage.kernel().unwrap());
    assert_eq!(size_of_val(&file), 0);
    for k in 1..6 {
        let part = |n: i32| (f64::from(n * k)).sin();
        let q = (UnitQuaternion::from_euler_angles(part(1), part(2), part(3)), SVector::from([part(4), part(5)]));
        let z = SVector::from([part(6), part(7), part(8), part(9), part(10)]);
        let input = LinkageInput { turn: part(11), servo: part(12), pull: part(13) }.input();
        let [a, b] = [file.mass_matrix(0.0, &q), clauses.mass_matrix(0.0, &q)];
        assert!((a - b).amax() <= 200.0 * EPSILON * b.amax(), "{a} {b}");
        let condition = b.norm() * b.try_inverse().unwrap().norm();
        let [a, b] = [file.acceleration(0.0, &q, &z, &input), clauses.acceleration(0.0, &q, &z, &input)];
        assert!((a - b).amax() <= 500.0 * EPSILON * condition * b.amax(), "{a} {b}");
    }
    let bent = LinkageState::bent();
    assert_eq!((bent.yaw, bent.pitch, bent.pitch_dot), (0.1, 0.2, 2.0));
    assert_eq!(bent.socket, UnitQuaternion::from_quaternion(Quaternion::new(0.5, 0.5, 0.5, 0.5)));
    assert_eq!(bent.socket_omega, Vector3::new(3.0, 4.0, 5.0));
    // At first all is as the file has it: turned by their references joints turn nothing.
    assert_eq!(LinkageState::start().pitch, 10.0_f64.to_radians());
}

#[derive(GaussDynamics)]
#[gauss(mjcf = "robots/loop.xml")]
struct Loop;

/// The point that both links have at rest is common to them, and the place of a load in that of what carries it; what
/// is free falls.
#[test]
fn a_point_and_a_place_in_common() {
    let kernel = Loop.kernel().unwrap();
    let start = LoopState::start();
    let at = |angles: [f64; 3]| {
        LoopState { left_hinge: angles[0], top_hinge: angles[1], right_hinge: angles[2], ..start }.q()
    };
    // The point, which both links have in one plane; the place, the axes.
    let residual = kernel.position_residual(0.0, &at([0.0; 3]));
    assert_eq!(residual.len(), 8);
    assert!(residual.amax() <= 8.0 * EPSILON, "{residual}");
    // Both cranks turned alike, the coupler stays level.
    let turned = kernel.position_residual(0.0, &at([0.3, -0.3, 0.3]));
    assert!(turned.amax() <= 8.0 * EPSILON, "{turned}");
    // One crank alone: its end moves from 0.2 k₃ to 0.2 (sin, 0, cos).
    let apart = kernel.position_residual(0.0, &at([0.0, 0.0, 0.3]));
    assert!((apart.norm() - 0.4 * 0.15_f64.sin()).abs() <= 8.0 * EPSILON, "{apart}");
    // Moved as one they stay as they are to each other; the load alone does not.
    let moved = Isometry3::new(Vector3::new(1.0, -2.0, 0.5), Vector3::new(0.4, 1.0, -0.2));
    let both = LoopState { flight: moved * start.flight, carried: moved * start.carried, ..start };
    assert!(kernel.position_residual(0.0, &both.q()).amax() <= 32.0 * EPSILON);
    let turn = Isometry3::rotation(Vector3::new(0.0, 0.0, 0.1));
    let alone = LoopState { carried: start.carried * turn, ..start };
    assert!(kernel.position_residual(0.0, &alone.q()).amax() > 0.09);
    let fall = kernel.acceleration(0.0, &at([0.3, -0.3, 0.3]), &SVector::zeros(), &());
    let LoopState { flight_u, flight_omega, carried_u, .. } = LoopState::of(&start.q(), &fall);
    let down = Vector3::new(0.0, 0.0, -1.62);
    assert!((flight_u - down).amax() <= 1e3 * EPSILON && flight_omega.amax() <= 1e3 * EPSILON, "{fall}");
    assert!((start.carried.rotation * carried_u - down).amax() <= 1e3 * EPSILON, "{fall}");
}

#[derive(GaussDynamics)]
#[gauss(mjcf = "robots/servos.xml", inputs = actuators, saturation = clamp)]
struct Servos;

/// What MuJoCo finds (3.3.7 and 4.0.0, `qacc` of `mj_forward`): at the second and the third state controls, forces and
/// the efforts of the shoulder are at their ends, at the last the tendon is slack.
#[test]
fn ranges_classes_and_held_weights() {
    let kernel = Servos.kernel().unwrap();
    let states = [
        (
            [[0.3, -0.4, 0.2], [0.1, 0.2, -0.3]],
            [0.5, 0.2, 0.1, 1.0],
            [1.5413403534508796, 16.694051613873377, 2.8708056863713454],
        ),
        (
            [[0.9, -0.8, 1.2], [-1.1, 0.7, 0.9]],
            [2.5, 3.0, -1.9, 5.0],
            [7.388476536743999, -3.605261107695215, -16.390720891059573],
        ),
        (
            [[-0.7, 0.6, -0.5], [1.3, -0.2, 2.0]],
            [-4.0, -0.1, 0.61, -1.0],
            [12.648635872557664, -24.284727543460065, -3.391266521033782],
        ),
        (
            [[0.2, 0.2, 2.0], [0.0, 0.0, 0.5]],
            [0.7, 1.0, 0.3, 0.25],
            [13.155557445018314, -16.17309694719139, -1.7830963733099763],
        ),
    ];
    for ([q, z], [lift, tug, bend, brake], expected) in states {
        let (q, z, expected) = (SVector::from(q), SVector::from(z), SVector::from(expected));
        let input = ServosInput { lift, tug, bend, brake }.input();
        let found = kernel.acceleration(0.0, &q, &z, &input);
        let mass = kernel.mass_matrix(0.0, &q);
        let condition = mass.norm() * mass.try_inverse().unwrap().norm();
        // Each sums some hundred terms, the largest of which are tens of N m beside some that are left.
        assert!((found - expected).amax() <= 500.0 * EPSILON * condition * expected.amax(), "{found} {expected}");
    }
    // Beyond the range of its control an input changes nothing: exactly, so that derivatives are zero there.
    let [a, b] = [2.0, 3.0].map(|lift| ServosInput { lift, ..Default::default() }.input());
    let (q, z) = (SVector::from([0.1, 0.2, 0.3]), SVector::zeros());
    assert_eq!(kernel.acceleration(0.0, &q, &z, &a), kernel.acceleration(0.0, &q, &z, &b));
}
