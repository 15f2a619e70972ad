//! Robots on tables, walls and ceilings, with tools and loads: against the same robots elsewhere.

use gauss_runtime::prelude::*;

const EPSILON: f64 = f64::EPSILON;
const G: f64 = 9.81;

#[derive(GaussDynamics)]
#[gauss(urdf = "robots/panda.urdf", gravity = [0, 0, -9.81], frames(panda_joint7_link), reactions(panda_joint1))]
struct OnTheGround;

#[derive(GaussDynamics)]
#[gauss(
    urdf = "robots/panda.urdf", base(position = place, rotation = rotation_x(pi) * rotation_z(turn)), gravity = [0, 0, -9.81],
    frames(panda_joint7_link), reactions(panda_joint1),
)]
struct OnTheCeiling {
    place: Vector3<f64>,
    turn: f64,
}

/// The same as it looks from below: with gravity upward.
#[derive(GaussDynamics)]
#[gauss(urdf = "robots/panda.urdf", gravity = [0, 0, 9.81], frames(panda_joint7_link), reactions(panda_joint1))]
struct UpsideDown;

fn state() -> [SVector<f64, 9>; 3] {
    let numbers = |size: f64, step: f64| SVector::from_fn(|k, _| size * (0.3 + step * k as f64).sin());
    [numbers(0.8, 1.1), numbers(1.5, 0.7), numbers(20.0, 1.9)]
}

/// Sums of some hundred products.
fn same<const N: usize>(found: &SVector<f64, N>, expected: &SVector<f64, N>, condition: f64) {
    let error = (found - expected).amax();
    assert!(error <= 500.0 * EPSILON * condition * (1.0 + expected.amax()), "{error:e} of {}", expected.amax());
}

#[test]
fn a_robot_on_a_ceiling_sees_gravity_upward() {
    let place = Vector3::new(0.4, -0.3, 2.5);
    let (ceiling, other) = (OnTheCeiling { place, turn: 0.9 }.kernel().unwrap(), UpsideDown.kernel().unwrap());
    let [q, z, u] = state();
    let matrix = other.mass_matrix(0.0, &q);
    let condition = matrix.norm() * matrix.try_inverse().unwrap().norm();
    same(&ceiling.acceleration(0.0, &q, &z, &u), &other.acceleration(0.0, &q, &z, &u), condition);
    assert!((ceiling.mass_matrix(0.0, &q) - matrix).amax() <= 500.0 * EPSILON * matrix.amax());
    let (found, expected) = (
        ceiling.reaction(OnTheCeilingJoint::panda_joint1, 0.0, &q, &z, &u),
        other.reaction(UpsideDownJoint::panda_joint1, 0.0, &q, &z, &u),
    );
    same(&found, &expected, condition);
    // The hand is where it is on the ground, seen from the ceiling.
    let ground = OnTheGround.kernel().unwrap();
    let turned = UnitQuaternion::from_euler_angles(std::f64::consts::PI, 0.0, 0.0)
        * UnitQuaternion::from_euler_angles(0.0, 0.0, 0.9);
    let hand = ground.pose_of(OnTheGroundFrame::panda_joint7_link, 0.0, &q).translation.vector;
    let found = ceiling.pose_of(OnTheCeilingFrame::panda_joint7_link, 0.0, &q).translation.vector;
    assert!((found - (place + turned * hand)).amax() < 64.0 * EPSILON * 3.0);
}

/// A table that shakes: what is on it feels a gravity that changes.
#[derive(GaussDynamics)]
#[gauss(urdf = "robots/panda.urdf", base(position = [0, 0, size * sin(pace * t)]), gravity = 9.81)]
struct OnAShaker {
    size: f64,
    pace: f64,
}

#[derive(GaussDynamics)]
#[gauss(urdf = "robots/panda.urdf", gravity = g)]
struct Heavy {
    g: f64,
}

#[test]
fn a_base_that_moves_is_a_gravity_that_changes() {
    let (size, pace, t) = (0.02, 30.0, 0.37_f64);
    let shaken = OnAShaker { size, pace }.kernel().unwrap();
    let heavy = Heavy { g: G - size * pace * pace * (pace * t).sin() }.kernel().unwrap();
    let [q, z, u] = state();
    let matrix = heavy.mass_matrix(t, &q);
    let condition = matrix.norm() * matrix.try_inverse().unwrap().norm();
    same(&shaken.acceleration(t, &q, &z, &u), &heavy.acceleration(t, &q, &z, &u), condition);
}

/// With a tool whose point is a field and a load that may be none.
#[derive(GaussDynamics)]
#[gauss(
    urdf = "robots/panda.urdf", gravity = 9.81,
    body(load, parent = panda_joint7_link, position = grip),
    frame(tip, parent = panda_joint7_link, position = tool),
    frames(tip, load),
    reactions(load),
)]
struct Loaded {
    #[gauss(body)]
    load: RigidBody<f64>,
    grip: Vector3<f64>,
    tool: Vector3<f64>,
}

#[test]
fn loads_and_tools_are_numbers() {
    let (grip, tool) = (Vector3::new(0.0, 0.02, 0.1), Vector3::new(0.01, 0.0, 0.15));
    let empty = RigidBody { mass: 0.0, center_of_mass: Vector3::zeros(), inertia: Matrix3::zeros() };
    let center = Vector3::new(0.01, 0.0, 0.05);
    let carried = RigidBody { mass: 3.0, center_of_mass: center, inertia: Matrix3::from_diagonal_element(0.04) };
    let [free, full] = [empty, carried].map(|load| Loaded { load, grip, tool }.kernel().unwrap());
    let ground = OnTheGround.kernel().unwrap();
    let [q, z, u] = state();
    let matrix = ground.mass_matrix(0.0, &q);
    let condition = matrix.norm() * matrix.try_inverse().unwrap().norm();
    same(&free.acceleration(0.0, &q, &z, &u), &ground.acceleration(0.0, &q, &z, &u), condition);
    assert_eq!(free.reaction(LoadedJoint::load, 0.0, &q, &z, &u), Vector6::zeros());
    // What the load does at rest: its weight at its centre, by the Jacobian of where it is.
    let still = SVector::zeros();
    let held = |kernel: &LoadedKernel| kernel.inverse_dynamics(0.0, &q, &still, &still, &still);
    let motion = &full.frames(0.0, &q, &still)[LoadedFrame::load];
    let turned = motion.pose.rotation.inverse();
    let weight = turned * Vector3::new(0.0, 0.0, -3.0 * G);
    let moment = center.cross(&weight);
    let wrench = Vector6::new(weight.x, weight.y, weight.z, moment.x, moment.y, moment.z);
    same(&(held(&full) - held(&free)), &(-(motion.jacobian.transpose() * wrench)), 1.0);
    // So much holds it at the grip.
    let at_rest = full.reactions_at(0.0, &q, &still, &still, &u)[LoadedJoint::load];
    same(&at_rest, &-wrench, 1.0);
    let tip = full.pose_of(LoadedFrame::tip, 0.0, &q).translation.vector;
    let hand = ground.pose_of(OnTheGroundFrame::panda_joint7_link, 0.0, &q);
    assert!((tip - (hand.translation.vector + hand.rotation * tool)).amax() < 32.0 * EPSILON);
}

/// A gripper whose fixed links are cut: each joint bears what is beyond it and nothing else.
#[derive(GaussDynamics)]
#[gauss(
    mjcf = "robots/welded.xml", base(position = [0, 0, 1], rotation = rotation_y(pi / 2)),
    reactions(hinge, wrist, pole), methods(gravity_torques),
)]
struct Welded;

#[test]
fn fixed_joints_bear_what_is_beyond_them() {
    let kernel = Welded.kernel().unwrap();
    let (q, still) = (SVector::from([0.0]), SVector::from([0.0]));
    let hold = -kernel.acceleration(0.0, &q, &still, &still) * kernel.mass_matrix(0.0, &q)[(0, 0)];
    let found = kernel.reactions(0.0, &q, &still, &hold);
    // The file's x points down, its z along the observer's x.
    let force = |mass: f64| -mass * G;
    same(&found[WeldedJoint::wrist].fixed_rows::<3>(0).into(), &Vector3::new(force(2.0), 0.0, 0.0), 1.0);
    same(&found[WeldedJoint::hinge].fixed_rows::<3>(0).into(), &Vector3::new(force(3.0), 0.0, 0.0), 1.0);
    same(&found[WeldedJoint::pole].fixed_rows::<3>(0).into(), &Vector3::new(force(8.0), 0.0, 0.0), 1.0);
}
