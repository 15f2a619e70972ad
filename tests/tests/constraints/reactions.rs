//! Reactions of joints, against sums of forces of inertia that are written here link by link (Newton, Euler), against
//! Pinocchio, and in closed form.

use std::fs;
use std::path::Path;

use gauss_runtime::frames::{FrameMotion, FramePose};
use gauss_runtime::prelude::*;
use serde_json::Value;

const G: f64 = 9.81;
const EPSILON: f64 = f64::EPSILON;

/// Force and torque of what moves, by Newton and Euler, with the pole where it is said; observer's axes.
#[derive(Clone, Copy)]
struct Wrench {
    force: Vector3<f64>,
    torque: Vector3<f64>,
    at: Vector3<f64>,
}

impl Wrench {
    fn pushed(force: Vector3<f64>, at: Vector3<f64>) -> Self {
        Self { force, torque: Vector3::zeros(), at }
    }

    fn turned(torque: Vector3<f64>) -> Self {
        Self { force: Vector3::zeros(), torque, at: Vector3::zeros() }
    }

    /// What is left of the sum about the origin of a frame, in its axes.
    fn sum<'a>(all: impl IntoIterator<Item = &'a Self>, pose: &FramePose<f64>) -> Vector6<f64> {
        let [mut force, mut torque] = [Vector3::zeros(); 2];
        for own in all {
            force += own.force;
            torque += own.torque + (own.at - pose.translation.vector).cross(&own.force);
        }
        let [f, m] = [force, torque].map(|v| pose.rotation.inverse() * v);
        Vector6::new(f.x, f.y, f.z, m.x, m.y, m.z)
    }
}

/// What has to act on a body for it to move so, beside its weight: m (a_G − g) at G, and I_G ω̇ + ω × I_G ω.
fn needed<const N: usize>(
    motion: &FrameMotion<f64, SMatrix<f64, 6, N>>,
    rates: &SVector<f64, N>,
    (mass, center, central): (f64, Vector3<f64>, Vector3<f64>),
) -> Wrench {
    let acceleration = motion.acceleration(rates);
    let part = |v: &Vector6<f64>, from: usize| Vector3::new(v[from], v[from + 1], v[from + 2]);
    let (a, alpha, omega) = (part(&acceleration, 0), part(&acceleration, 3), part(&motion.twist, 3));
    let of_center = a + alpha.cross(&center) + omega.cross(&omega.cross(&center));
    let spin = central.component_mul(&alpha) + omega.cross(&central.component_mul(&omega));
    let turned = motion.pose.rotation;
    let force = mass * (turned * of_center + G * Vector3::z());
    Wrench { force, torque: turned * spin, at: turned * center + motion.pose.translation.vector }
}

/// Equal up to roundings of the terms: some fifty products go into each number.
fn close(found: &Vector6<f64>, expected: &Vector6<f64>, what: &str) {
    let bound = 256.0 * EPSILON * (1.0 + expected.amax());
    assert!((found - expected).amax() <= bound, "{what}: {found:?}, expected {expected:?}");
}

/// A post that turns, a slanted arm on it, a box that is welded to the arm, a slide in the box; a motor between post
/// and arm, friction in the arm's hinge, a push on the slide, a spring from the arm to a fixed point.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(turn, lift, way),
    input(motor = "N m", push: Vector3 = "N"),
    body(post, position = [0.1, 0.2, 0.3], rotation = rotation_z(turn), mass = 3, center_of_mass = [0.02, 0.01, 0.2], inertia_about_center_of_mass = [0.05, 0.06, 0.02]),
    body(arm, parent = post, position = [0.05, 0, 0.4], rotation = rotation_x(0.3) * rotation_y(lift), mass = 2, center_of_mass = [0.3, 0.02, -0.01], inertia_about_center_of_mass = [0.01, 0.08, 0.07]),
    body(case, parent = arm, position = [0.6, 0.05, 0], rotation = rotation_z(0.7), mass = 0.5, center_of_mass = [0.05, 0, 0.03], inertia_about_center_of_mass = [0.003, 0.002, 0.001]),
    body(slide, parent = case, position = [0, 0.04, way], rotation = rotation_y(-0.4), mass = 0.4, center_of_mass = [0.01, 0.02, 0], inertia_about_center_of_mass = [0.001, 0.002, 0.003]),
    torque(drive, body = arm, value = [0, motor, 0], reaction = post),
    friction(hinge, along = lift, viscous = 0.7),
    force(shove, body = slide, at = [0, 0, 0.1], value = push),
    point(hook, body = arm, at = [0.2, 0, 0.1]),
    potential = 0.5 * k * dot(hook, hook),
    frames(post, arm, case, slide),
    reactions(post, arm, case, slide),
)]
struct Machine {
    k: f64,
    #[gauss(gravity)]
    g: f64,
}

#[test]
fn a_machine_by_newton_and_euler() {
    let k = 12.0;
    let kernel = Machine { k, g: G }.kernel().unwrap();
    let state = MachineState { turn: 0.4, lift: -0.7, way: 0.15, turn_dot: 1.3, lift_dot: -0.9, way_dot: 0.6 };
    let (q, z) = (state.q(), state.z());
    let (motor, push) = (2.5, Vector3::new(1.0, -2.0, 0.5));
    let input = MachineInput { motor, push }.input();
    let rates = kernel.acceleration(0.0, &q, &z, &input);
    let motions = kernel.frames(0.0, &q, &z);
    use MachineFrame::{arm, case, post, slide};
    let v = Vector3::new;
    let of_post = needed(&motions[post], &rates, (3.0, v(0.02, 0.01, 0.2), v(0.05, 0.06, 0.02)));
    let of_arm = needed(&motions[arm], &rates, (2.0, v(0.3, 0.02, -0.01), v(0.01, 0.08, 0.07)));
    let of_case = needed(&motions[case], &rates, (0.5, v(0.05, 0.0, 0.03), v(0.003, 0.002, 0.001)));
    let of_slide = needed(&motions[slide], &rates, (0.4, v(0.01, 0.02, 0.0), v(0.001, 0.002, 0.003)));
    // What acts from elsewhere is taken away.
    let at = |frame: MachineFrame, x: Vector3<f64>| {
        let pose = motions[frame].pose;
        pose.rotation * x + pose.translation.vector
    };
    let drive = Wrench::turned(motions[arm].pose.rotation * (motor * Vector3::y()));
    let against = Wrench::turned(-drive.torque);
    let shove = Wrench::pushed(-(motions[slide].pose.rotation * push), at(slide, v(0.0, 0.0, 0.1)));
    let hook = at(arm, v(0.2, 0.0, 0.1));
    let spring = Wrench::pushed(k * hook, hook);
    let found = kernel.reactions(0.0, &q, &z, &input);
    let slides = [of_slide, shove];
    let cases = [of_case, of_slide, shove];
    let arms = [of_arm, of_case, of_slide, shove, spring, against];
    let all = [of_post, of_arm, of_case, of_slide, shove, spring];
    close(&found[MachineJoint::slide], &Wrench::sum(&slides, &motions[slide].pose), "slide");
    close(&found[MachineJoint::case], &Wrench::sum(&cases, &motions[case].pose), "case");
    close(&found[MachineJoint::arm], &Wrench::sum(&arms, &motions[arm].pose), "arm");
    close(&found[MachineJoint::post], &Wrench::sum(&all, &motions[post].pose), "post");
    // Along hinges there is what acts on their rates: nothing, and friction.
    let [of_post, of_arm] = [MachineJoint::post, MachineJoint::arm].map(|joint| found[joint]);
    assert!(of_post[5].abs() < 256.0 * EPSILON * of_post.amax(), "{of_post}");
    assert!((of_arm[4] + 0.7 * state.lift_dot).abs() < 256.0 * EPSILON * of_arm.amax(), "{of_arm}");
    assert_eq!(kernel.reaction(MachineJoint::arm, 0.0, &q, &z, &input), of_arm);
    // At other accelerations the sums are of these.
    let other = SVector::from([0.3, -2.0, 1.0]);
    let of_slide = needed(&motions[slide], &other, (0.4, v(0.01, 0.02, 0.0), v(0.001, 0.002, 0.003)));
    let found = kernel.reactions_at(0.0, &q, &z, &other, &input);
    close(&found[MachineJoint::slide], &Wrench::sum(&[of_slide, shove], &motions[slide].pose), "slide");
}

macro_rules! slider_crank {
    ($name:ident $(, $clause:tt ($($inside:tt)*))?) => {
        #[derive(GaussDynamics)]
        #[gauss(
            coordinates(crank, rod, piston),
            speeds(w, s, v),
            kinematics(crank = w, rod = s, piston = v),
            body(wheel, rotation = rotation_z(crank), mass = 2, inertia = [0.01, 0.01, 0.02]),
            body(arm, parent = wheel, position = [r, 0, 0], rotation = rotation_z(rod), mass = 0.5,
                 center_of_mass = [l / 2, 0, 0], inertia_about_center_of_mass = [0.003, 0.003, 0.003]),
            body(block, position = [piston, 0, 0], mass = 1, inertia = 0.01),
            point(pin, body = arm, at = [l, 0, 0]),
            constraint(position = pin - block.position),
            frames(wheel, arm, block),
            reactions(wheel, arm, block),
            $($clause($($inside)*),)?
        )]
        struct $name { r: f64, l: f64, #[gauss(gravity)] g: f64 }
    };
}
slider_crank!(Held);
slider_crank!(Solved, independent(w));

/// The pin's force is the multiplier; the frame holds all together, which lies in its plane, with the weight across it.
#[test]
fn a_loop_by_newton_and_euler() {
    let (r, l) = (0.1, 0.3);
    let kernel = Held { r, l, g: G }.kernel().unwrap();
    let solved = Solved { r, l, g: G }.kernel().unwrap();
    let guess = HeldState { crank: 0.7, rod: -1.0, piston: 0.35, w: 20.0, ..Default::default() };
    let (q, z) = kernel.project(0.0, &guess.q(), &guess.z()).unwrap();
    let rates = kernel.acceleration(0.0, &q, &z, &());
    let motions = kernel.frames(0.0, &q, &z);
    let v = Vector3::new;
    let of_wheel = needed(&motions[HeldFrame::wheel], &rates, (2.0, v(0.0, 0.0, 0.0), v(0.01, 0.01, 0.02)));
    let of_arm = needed(&motions[HeldFrame::arm], &rates, (0.5, v(l / 2.0, 0.0, 0.0), v(0.003, 0.003, 0.003)));
    let of_block = needed(&motions[HeldFrame::block], &rates, (1.0, v(0.0, 0.0, 0.0), v(0.01, 0.01, 0.01)));
    let multipliers = kernel.multipliers(0.0, &q, &z, &());
    let pin = v(q[2], 0.0, 0.0);
    let on_arm = Wrench::pushed(-v(multipliers[0], multipliers[1], 0.0), pin);
    let on_block = Wrench::pushed(-on_arm.force, pin);
    let expected = [
        Wrench::sum(&[of_wheel, of_arm, on_arm], &motions[HeldFrame::wheel].pose),
        Wrench::sum(&[of_arm, on_arm], &motions[HeldFrame::arm].pose),
        Wrench::sum(&[of_block, on_block], &motions[HeldFrame::block].pose),
    ];
    let found = kernel.reactions(0.0, &q, &z, &());
    let of_solved = solved.reactions(0.0, &q, &SVector::from([z[0]]), &());
    let condition = {
        let matrix = kernel.mass_matrix(0.0, &q);
        matrix.norm() * matrix.try_inverse().unwrap().norm()
    };
    for (k, expected) in expected.iter().enumerate() {
        let (one, other) = (found[HeldJoint::ALL[k]], of_solved[SolvedJoint::ALL[k]]);
        let bound = 64.0 * EPSILON * condition * (1.0 + expected.amax());
        assert!((one - expected).amax() < bound, "{k}: {one} {expected}");
        // The projection leaves the state on the loop up to its own rounding, which speeds of 20 rad/s make visible.
        assert!((other - expected).amax() < 64.0 * bound, "{k}: {other} {expected}");
    }
    // The block slides without friction, the wheel and the pin turn without.
    assert!(found[HeldJoint::block][0].abs() < 64.0 * EPSILON * condition * found[HeldJoint::block].amax());
}

/// A top on its point: what holds the point is the force that moves its centre.
#[derive(GaussDynamics)]
#[gauss(motion = fixed_point, chart = left_invariant, reactions(body))]
struct Top {
    #[gauss(mass)]
    mass: f64,
    #[gauss(center_of_mass)]
    center: Vector3<f64>,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
    #[gauss(gravity)]
    g: f64,
}

/// Free bodies are held by nothing.
#[derive(GaussDynamics)]
#[gauss(chart = jet(euler_zyx), reactions(body))]
struct Stone {
    #[gauss(mass)]
    mass: f64,
    #[gauss(center_of_mass)]
    center: Vector3<f64>,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
    #[gauss(gravity)]
    g: f64,
}

#[test]
fn bodies_in_charts() {
    let (mass, center, inertia) = (0.5, Vector3::new(0.0, 0.0, 0.1), Vector3::new(0.02, 0.02, 0.004));
    let top = Top { mass, center, inertia, g: G }.kernel().unwrap();
    let q = UnitQuaternion::from_euler_angles(0.3, 0.5, -0.2);
    let z = Vector3::new(1.0, 2.0, 30.0);
    let alpha = top.acceleration(0.0, &q, &z, &());
    let force = mass * (alpha.cross(&center) + z.cross(&z.cross(&center)) + q.inverse() * (G * Vector3::z()));
    let expected = Vector6::new(force.x, force.y, force.z, 0.0, 0.0, 0.0);
    close(&top.reaction(TopJoint::body, 0.0, &q, &z, &()), &expected, "top");
    let stone = Stone { mass, center, inertia, g: G }.kernel().unwrap();
    let (q, z) = (SVector::from([1.0, 2.0, 3.0, 0.4, 0.5, 0.6]), SVector::from([1.0, -1.0, 2.0, 0.3, -0.2, 0.5]));
    close(&stone.reaction(StoneJoint::body, 0.0, &q, &z, &()), &Vector6::zeros(), "stone");
}

/// A hopper's leg: a hull on a hinge over a foot that may touch the ground.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, lean, bend),
    body(hull, position = [x, 0, y], rotation = rotation_y(lean), mass = 5, inertia = 0.2),
    body(leg, parent = hull, position = [0.02, 0, -0.1], rotation = rotation_y(bend), mass = 1, center_of_mass = [0, 0, -0.2], inertia_about_center_of_mass = 0.02),
    point(foot, body = leg, at = [0.01, 0, -0.4]),
    contact(toe, point = foot, friction = 0.6),
    frames(hull, leg),
    reactions(hull, leg),
)]
struct Hopper {
    #[gauss(gravity)]
    g: f64,
}

#[test]
fn under_contact_forces() {
    let kernel = Hopper { g: G }.kernel().unwrap();
    let (q, z) = (SVector::from([0.3, 0.6, 0.2, -0.5]), SVector::from([0.4, -0.2, 1.0, -2.0]));
    let forces = SVector::<f64, 2>::from([31.0, -7.0]);
    let columns = kernel.contact_response(0.0, &q).columns;
    let rates = kernel.acceleration(0.0, &q, &z, &()) + columns * forces;
    let motions = kernel.frames(0.0, &q, &z);
    let (hull, leg) = (&motions[HopperFrame::hull], &motions[HopperFrame::leg]);
    let of_hull = needed(hull, &rates, (5.0, Vector3::zeros(), Vector3::repeat(0.2)));
    let of_leg = needed(leg, &rates, (1.0, Vector3::new(0.0, 0.0, -0.2), Vector3::repeat(0.02)));
    let frame = kernel.contact_frame(0, 0.0, &q).unwrap();
    let force = forces[0] * frame.normal + forces[1] * frame.tangents()[0];
    let push = Wrench::pushed(-force, frame.point);
    let at = |joint| kernel.reaction_under(joint, 0.0, &q, (&z, &rates), &(), &forces);
    close(&at(HopperJoint::leg), &Wrench::sum(&[of_leg, push], &leg.pose), "leg");
    // The hull moves freely in its plane; out of the plane nothing acts.
    close(&at(HopperJoint::hull), &Wrench::sum(&[of_hull, of_leg, push], &hull.pose), "hull");
    assert!(at(HopperJoint::hull).amax() < 1e-12);
}

#[derive(GaussDynamics)]
#[gauss(
    urdf = "robots/panda.urdf",
    gravity = 9.81,
    reactions(
        panda_joint1,
        panda_joint2,
        panda_joint3,
        panda_joint4,
        panda_joint5,
        panda_joint6,
        panda_joint7_link,
        panda_finger_joint1,
        panda_finger_joint2
    )
)]
struct Panda;

#[derive(GaussDynamics)]
#[gauss(
    urdf = "robots/anymal.urdf", base = floating, gravity = 9.81,
    input(push: Wrench),
    wrench(push, body = base_link, force = push.force, torque = push.torque),
    reactions(LF_HAA, LF_HFE, LF_KFE, LH_HAA, LH_HFE, LH_KFE, RF_HAA, RF_HFE, RF_KFE, RH_HAA, RH_HFE, RH_KFE, base_link),
)]
struct Anymal;

fn read(name: &str) -> Value {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("robots").join(format!("{name}.json"));
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

/// What Pinocchio finds, and the state it does so at.
fn of_pinocchio(name: &str) -> Vec<(Value, Vec<Vector6<f64>>)> {
    let (states, found) = (read(name)["states"].clone(), read("reactions")[name]["states"].clone());
    let rows = |of: &Value| -> Vec<Vector6<f64>> {
        of.as_array().unwrap().iter().map(|row| Vector6::from_vec(numbers(row))).collect()
    };
    let found = found.as_array().unwrap().clone();
    found.iter().zip(states.as_array().unwrap()).map(|(of, state)| (state.clone(), rows(of))).collect()
}

/// Both sum some hundred products along the robot: of the largest reaction that many roundings.
fn same(found: &Vector6<f64>, expected: &Vector6<f64>, largest: f64, what: &str) {
    let error = (found - expected).amax();
    assert!(error <= 500.0 * EPSILON * largest, "{what}: {error:e} of {largest}");
}

#[test]
fn an_arm_as_in_pinocchio() {
    let kernel = Panda.kernel().unwrap();
    for (state, expected) in of_pinocchio("panda") {
        let [q, z, rates] = ["q", "v", "acceleration"].map(|name| SVector::<f64, 9>::from_vec(numbers(&state[name])));
        let tau = SVector::<f64, 9>::from_vec(numbers(&state["tau"]));
        let found = kernel.reactions_at(0.0, &q, &z, &rates, &tau);
        let largest = expected.iter().map(|row| row.amax()).fold(0.0, f64::max);
        for (joint, expected) in PandaJoint::ALL.iter().zip(&expected) {
            same(&found[*joint], expected, largest, joint.name());
        }
    }
}

#[test]
fn a_quadruped_as_in_pinocchio() {
    let kernel = Anymal.kernel().unwrap();
    for (state, expected) in of_pinocchio("anymal") {
        let [q, z, rates, tau] = ["q", "v", "acceleration", "tau"].map(|name| numbers(&state[name]));
        let quaternion = UnitQuaternion::from_quaternion(Quaternion::new(q[6], q[3], q[4], q[5]));
        let pose = Isometry3::from_parts(Vector3::new(q[0], q[1], q[2]).into(), quaternion);
        let q = (pose, SVector::<f64, 12>::from_column_slice(&q[7..]));
        let input = SVector::<f64, 18>::from_iterator(tau[6..].iter().chain(&tau[..6]).copied());
        let [z, rates] = [z, rates].map(SVector::<f64, 18>::from_vec);
        // The accelerations of the base are rates of its components in axes that turn.
        let found = kernel.reactions_at(0.0, &q, &z, &rates, &input);
        let largest = expected.iter().map(|row| row.amax()).fold(0.0, f64::max);
        for (joint, expected) in AnymalJoint::ALL.iter().zip(&expected) {
            same(&found[*joint], expected, largest, joint.name());
        }
        // Nothing holds the base, since the push that moves it acts on it.
        let sum: f64 = largest + SVector::<f64, 6>::from_column_slice(&tau[..6]).amax();
        assert!(found[AnymalJoint::base_link].amax() <= 1e4 * EPSILON * sum, "{}", found[AnymalJoint::base_link]);
    }
}
