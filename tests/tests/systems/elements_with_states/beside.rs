//! States beside constraints, contacts, charts, reactions and in packs.

use super::*;
use gauss_batch::{Batch, States};
use gauss_contact::{ContactErrorKind, ContactRun, ContactStepper};
use gauss_runtime::chart::{ChartError, MotionRule, convert};

/// A ball that bounces, and a filter of its height.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(h),
    particle(mass = 1, position = [0, 0, h]),
    contact(floor, gap = h, restitution = 0.5),
    states(seen = (h - seen) / tau, hits = abs(rate(h)))
)]
struct Ball {
    tau: f64,
    #[gauss(gravity)]
    g: f64,
}

/// Dropped from 1: it falls for √(2/g), rises with half the speed to a quarter, so `hits`, the way, is 1, then 1.5.
#[test]
fn states_go_on_through_impacts() {
    let (g, tau) = (2.0, 0.3);
    let kernel = Ball { tau, g }.kernel().unwrap();
    let start = BallState { h: 1.0, seen: 1.0, ..Default::default() };
    let run = ContactRun::new(&kernel).adaptive(1e-11, 1e-11).run(start.q(), start.z(), 0.0..2.0).unwrap();
    // Falls 1 s at 2 m/s²; rises with 1 m/s for half a second, and falls again for as long.
    let end = run.last().expect("a sample");
    let end = BallState::of(&end.q, &end.z);
    assert!((end.hits - 1.5).abs() < 1e-9, "{end:?}");
    // ẏ = (h − y)/τ under h = a + b s + c s² from y₀: the particular solution is
    // p(s) = a − b τ + 2 c τ² + (b − 2 c τ) s + c s².
    let filtered = |[a, b, c]: [f64; 3], y: f64, s: f64| {
        let p = |s: f64| a - b * tau + 2.0 * c * tau * tau + (b - 2.0 * c * tau) * s + c * s * s;
        p(s) + (y - p(0.0)) * f64::exp(-s / tau)
    };
    let at_impact = filtered([1.0, 0.0, -g / 2.0], 1.0, 1.0);
    let expected = filtered([0.0, 1.0, -g / 2.0], at_impact, 1.0);
    assert!((end.seen - expected).abs() < 1e-9, "{end:?} {expected}");
}

#[test]
fn steps_of_one_length_refuse_states() {
    let kernel = Ball { tau: 0.3, g: 2.0 }.kernel().unwrap();
    let start = BallState { h: 1.0, ..Default::default() };
    let refused = ContactStepper::new(&kernel, 0.0, start.q(), start.z()).expect_err("there are states");
    assert_eq!(refused.kind, ContactErrorKind::States { states: 2 });
    assert!(refused.to_string().contains("elements of the scene have 2 states"), "{refused}");
}

/// A pendulum in the plane by a constraint, a motor that lags; in coordinates of a rod, and with the constraint solved.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y),
    particle(mass = m, position = [x, 0, y]),
    constraint(position = x * x + y * y - 1),
    states(torque = (1 - torque) / lag, swept = x * rate(y) - y * rate(x)),
    force(at = [x, 0, y], value = [-torque * y, 0, torque * x])
)]
struct Tethered {
    m: f64,
    lag: f64,
    #[gauss(gravity)]
    g: f64,
}

#[derive(GaussDynamics)]
#[gauss(
    coordinates(a),
    frame(arm, rotation = rotation_y(a)),
    reactions(bob),
    body(bob, parent = arm, position = [0, 0, -1], mass = m, inertia = 0),
    states(torque = (1 - torque) / lag),
    torque(body = arm, value = [0, -torque, 0])
)]
struct Hinged {
    m: f64,
    lag: f64,
    #[gauss(gravity)]
    g: f64,
}

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, a),
    speeds(u, v, w),
    kinematics(x = u, y = v, a = w),
    independent(w),
    particle(mass = m, position = [x, 0, y]),
    frame(arm, rotation = rotation_y(a)),
    body(disk, parent = arm, mass = 0.1, inertia = 0.001),
    constraint(position = x + sin(a)),
    constraint(position = y + cos(a)),
    states(torque = (1 - torque) / lag, work = torque * w),
    drive(a = -torque)
)]
struct Solved {
    m: f64,
    lag: f64,
    #[gauss(gravity)]
    g: f64,
}

#[test]
fn constraints_leave_states_alone() {
    let (m, lag, g, t) = (0.8, 0.6, 9.81, 2.0);
    let hinged = Hinged { m, lag, g }.kernel().unwrap();
    let a = 0.7_f64;
    let start = HingedState { a, ..Default::default() };
    let end = Simulation::new(&hinged).adaptive(1e-12, 1e-12).run_to_end(start.q(), start.z(), 0.0..t).unwrap();
    let alone = HingedState::of(&end.q, &end.z);

    let tethered = Tethered { m, lag, g }.kernel().unwrap();
    let start = TetheredState { x: -a.sin(), y: -a.cos(), ..Default::default() };
    let end = Simulation::new(&tethered).adaptive(1e-12, 1e-12).run_to_end(start.q(), start.z(), 0.0..t).unwrap();
    let end = TetheredState::of(&end.q, &end.z);
    // The tolerance over 2 units of a motion that is regular.
    let near = |found: f64, expected: f64| assert!((found - expected).abs() < 1e-9, "{found} for {expected}");
    near(end.x, -alone.a.sin());
    near(end.y, -alone.a.cos());
    near(end.torque, alone.torque);
    near(end.swept, a - alone.a);
    // Restored constraints move no state, though the rate of one depends on the speeds.
    let off = TetheredState { x: 0.9, y: 0.8, torque: 0.1, swept: 0.2, x_dot: 1.0, ..Default::default() };
    let (q, _) = tethered.project(0.0, &off.q(), &off.z()).unwrap();
    assert_eq!([q[2], q[3]], [0.1, 0.2]);
    assert!((q[0].hypot(q[1]) - 1.0).abs() < 1e-15);

    let solved = Solved { m, lag, g }.kernel().unwrap();
    let start = SolvedState { x: -a.sin(), y: -a.cos(), a, ..Default::default() };
    let run = Simulation::new(&solved).adaptive(1e-12, 1e-12).run_to_end(start.q(), start.z(), 0.0..t).unwrap();
    let end = SolvedState::of(&run.q, &run.z);
    // Work of −torque is what the energy grew by.
    let energy = |q: &_, z: &_| solved.energy(0.0, q, z);
    near(-end.work, energy(&run.q, &run.z) - energy(&start.q(), &start.z()));
}

/// The force in the joint of a bob is m (a − g), whatever turns the arm.
#[test]
fn reactions_know_of_states() {
    let (m, lag, g) = (0.8, 0.6, 9.81);
    let kernel = Hinged { m, lag, g }.kernel().unwrap();
    let (q, z) = (SVector::from([0.7, 2.5]), SVector::from([1.1]));
    let found = kernel.reaction(HingedJoint::bob, 0.0, &q, &z, &());
    let acceleration = kernel.acceleration(0.0, &q, &z, &())[0];
    // m a' = −torque − m g sin(a) about the hinge: the torque is on the frame, so nothing of it acts on the bob but by
    // the joint.
    assert!((acceleration - (-2.5 / m - g * 0.7_f64.sin())).abs() < 1e-13, "{acceleration}");
    let along = found.fixed_rows::<3>(0).norm();
    let radial = 1.1_f64.powi(2) + g * 0.7_f64.cos();
    let expected = m * radial.hypot(acceleration + g * 0.7_f64.sin());
    assert!((along - expected).abs() < 1e-12, "{along} {expected}");
}

/// One body in a chart, with the filter of a gyroscope.
#[derive(GaussDynamics)]
#[gauss(chart = left_invariant, states(gyro = (body.body_angular_velocity.z - gyro) / tau), torque(value = [0, 0, -k * gyro]))]
struct Damped<T> {
    #[gauss(mass)]
    mass: T,
    #[gauss(inertia)]
    inertia: Vector3<T>,
    tau: T,
    k: T,
}

fn damped<T: Real>() -> DampedKernel<T> {
    let [mass, a, b, c, tau, k] = [2.0, 0.2, 0.25, 0.4, 0.3, 0.5].map(T::from_f64);
    Damped { mass, inertia: Vector3::new(a, b, c), tau, k }.kernel().unwrap()
}

#[test]
fn a_body_in_a_chart_has_states() {
    let kernel = damped::<f64>();
    let start = DampedState { omega: Vector3::new(0.0, 0.0, 3.0), gyro: 0.5, ..Default::default() };
    let end = Simulation::new(&kernel).adaptive(1e-12, 1e-12).run_to_end(start.q(), start.z(), 0.0..1.5).unwrap();
    let end = DampedState::of(&end.q, &end.z);
    // C ω̇ = −k y, ẏ = (ω − y)/τ.
    let matrix = SMatrix::<f64, 2, 2>::new(0.0, -0.5 / 0.4, 1.0 / 0.3, -1.0 / 0.3);
    let expected = (matrix * 1.5).exp() * SVector::from([3.0, 0.5]);
    assert!((end.omega.z - expected[0]).abs() < 1e-10 && (end.gyro - expected[1]).abs() < 1e-10, "{end:?}");
    // The way back from a pose leaves the state at zero.
    let pose = Isometry3::new(Vector3::new(1.0, -2.0, 0.5), Vector3::new(0.3, 2.0, -1.0));
    let (found, state) = kernel.configuration(&pose).unwrap();
    assert!(found.difference(&pose).max_norm() < 1e-14 && state[0] == 0.0, "{found:?} {state}");
}

/// The same in another chart, and without the filter.
#[derive(GaussDynamics)]
#[gauss(chart = jet(euler_zyx), states(gyro = (body.body_angular_velocity.z - gyro) / tau))]
struct InAngles {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: f64,
    tau: f64,
}

#[derive(GaussDynamics)]
#[gauss(chart = hybrid)]
struct Unfiltered {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: f64,
}

#[test]
fn conversions_carry_states() {
    let (here, there) = (damped::<f64>(), InAngles { mass: 2.0, inertia: 0.3, tau: 0.1 }.kernel().unwrap());
    let pose = Isometry3::new(Vector3::new(1.0, -2.0, 0.5), Vector3::new(0.3, 0.4, -1.0));
    let start = DampedState { pose, omega: Vector3::new(0.1, 0.2, 0.3), gyro: 0.7, ..Default::default() };
    let (q, z) = convert(&here, &start.q(), &start.z(), &there).unwrap();
    let (back, rates) = convert(&there, &q, &z, &here).unwrap();
    // Rounding of angles and back.
    assert!(back.difference(&start.q()).max_norm() < 1e-14 && (rates - start.z()).amax() < 1e-14);
    assert_eq!([q[6], back.1[0]], [0.7, 0.7]);
    let unfiltered = Unfiltered { mass: 2.0, inertia: 0.3 }.kernel().unwrap();
    let refused = convert(&here, &start.q(), &start.z(), &unfiltered).expect_err("a state would be lost");
    assert_eq!(refused, ChartError::Inexpressible { rule: MotionRule::States, value: -1.0 });
}

/// The bits of single runs, in lanes.
#[test]
fn packs_have_states() {
    let (packed, single) = (damped::<Lanes<f64, 4>>(), damped::<f64>());
    let start = |i: usize| {
        let i = i as f64;
        let state = DampedState {
            omega: Vector3::new(0.3, -0.2 * i, 3.0),
            gyro: 0.5 - i,
            pose: Isometry3::translation(i, 0.0, 0.0),
            ..Default::default()
        };
        (state.q(), state.z())
    };
    let mut states = States::<DampedKernel<Lanes<f64, 4>>>::from_fn(6, start);
    let ends = Batch::new(&packed).adaptive(1e-9, 1e-9).run(0.0..1.0, &mut states);
    assert!(ends.iter().all(Result::is_ok));
    for (i, (q, z)) in states.iter().enumerate() {
        let (q0, z0) = start(i);
        let run = Simulation::new(&single).adaptive(1e-9, 1e-9).run_to_end(q0, z0, 0.0..1.0).unwrap();
        assert!(q == run.q && z == run.z, "state {i}");
    }
}
