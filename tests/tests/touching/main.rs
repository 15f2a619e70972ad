//! Runs with contacts of kernels that are derived: groups, inputs, constraints, gaps that depend on time.

mod by_hand;
mod contacts;
#[path = "../common/dual.rs"]
mod dual;
mod ellipsoids;
mod history;
mod published;
mod random;
mod shapes;

use std::f64::consts::FRAC_PI_2;

use gauss_batch::{Batch, States};
use gauss_contact::{ContactRun, EventKind, Mode};
use gauss_runtime::integrate::{Adams, Collocation, Fixed, IntegrationErrorKind};
use gauss_runtime::prelude::*;

/// A homogeneous ball on a plane.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(ball, position = pose.position, rotation = pose.rotation, mass = m, inertia = 0.4 * m * r * r),
    contact(table, point = ball.position, radius = r, friction = mu, restitution = e),
)]
struct Ball {
    m: f64,
    r: f64,
    mu: f64,
    e: f64,
    #[gauss(gravity)]
    g: f64,
}

const BALL: Ball = Ball { m: 0.17, r: 0.028, mu: 0.2, e: 0.0, g: 9.81 };

#[test]
fn a_sliding_ball_begins_to_roll() {
    let kernel = BALL.kernel().unwrap();
    let start = Isometry3::translation(0.0, 0.0, BALL.r);
    let (v, along) = (2.0, Vector3::new(0.6, -0.8, 0.0));
    // (u, ω) in body axes, which are those of the observer at the start.
    let z = SVector::from([v * along.x, v * along.y, 0.0, 0.0, 0.0, 0.0]);
    let run = ContactRun::new(&kernel).adaptive(1e-11, 1e-11).run(start, z, 0.0..1.0).unwrap();
    let sticks: Vec<_> = run.events().iter().filter(|event| event.kind == EventKind::Sticks).collect();
    let [sticks] = sticks[..] else { panic!("{:?}", run.events()) };
    // 2v/(7μg), where the slip of v falls under friction at 7/2 μg; the tolerance of speeds, 3e-11, over that rate.
    let rolls = 2.0 * v / (7.0 * BALL.mu * BALL.g);
    assert!((sticks.time - rolls).abs() < 1e-10, "{:e}", sticks.time - rolls);
    let end = run.last().unwrap();
    let velocity = end.q.rotation * Vector3::new(end.z[0], end.z[1], end.z[2]);
    assert!((velocity - 5.0 / 7.0 * v * along).amax() < 1e-9, "{velocity}");
    assert!((end.q.translation.z - BALL.r).abs() <= 4.0 * f64::EPSILON * BALL.r);
    // Rolling, friction does nothing.
    let forces = *run.forces(0.9).unwrap();
    let weight = BALL.m * BALL.g;
    assert!((forces - SVector::from([weight, 0.0, 0.0])).amax() < 1e-12 * weight, "{forces}");
}

#[test]
fn a_dropped_ball_comes_to_rest() {
    let kernel = Ball { e: 0.9, ..BALL }.kernel().unwrap();
    let run = ContactRun::new(&kernel).adaptive(1e-10, 1e-10);
    let run = run.run(Isometry3::translation(0.0, 0.0, BALL.r + 1.0), SVector::zeros(), 0.0..9.0).unwrap();
    let rest = run.events().iter().find_map(|event| match event.kind {
        EventKind::Rests { remaining, .. } => Some(event.time + remaining),
        _ => None,
    });
    // √(2h/g)(1 + e)/(1 − e); each of 220 impacts is found to some roundings of its time, and of the gap over its rate.
    assert!((rest.unwrap() - 8.578_949_178_728_9).abs() < 1e-9, "{rest:?}");
    let end = run.last().unwrap();
    assert_eq!((end.z.amax(), run.modes(8.9).unwrap()), (0.0, &[Mode::Sticks][..]));
}

/// A pendulum between two stops, turned by a motor.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(a),
    particle(mass = 2, position = [l * sin(a), 0, -l * cos(a)]),
    input(motor),
    drive(a = motor),
    range(a, from = -most, to = most, restitution = e),
)]
struct Between {
    l: f64,
    most: f64,
    e: f64,
    #[gauss(gravity)]
    g: f64,
}

#[test]
fn a_motor_holds_a_pendulum_at_its_stop() {
    let (l, most, g) = (0.5, 0.7, 9.81);
    let kernel = Between { l, most, e: 0.4, g }.kernel().unwrap();
    // What holds it at the stop is 2 l g sin(0.7) = 6.32: at first three times that, from where it falls slowly.
    let motor = |t: f64, _: &SVector<f64, 1>, _: &SVector<f64, 1>| SVector::from([19.0 - t]);
    let run = ContactRun::new(&kernel).input(motor).adaptive(1e-11, 1e-11);
    let run = run.run(SVector::zeros(), SVector::zeros(), 0.0..14.0).unwrap();
    let weight = 2.0 * l * g * most.sin();
    let leaves = run.events().iter().find(|event| event.kind == EventKind::Leaves && event.time > 5.0).unwrap();
    assert_eq!(leaves.name, "a_to");
    assert!((leaves.time - (19.0 - weight)).abs() < 1e-9, "{:e}", leaves.time - (19.0 - weight));
    // Held, it is at the stop, and the stop bears what is left of the motor.
    let held = run.at(8.0).unwrap();
    assert_eq!((held.q[0], held.z[0]), (most, 0.0));
    assert!((run.forces(8.0).unwrap()[1] - (11.0 - weight)).abs() < 1e-12 * weight);
}

macro_rules! crank {
    ($name:ident $(, $clause:tt ($($inside:tt)*))?) => {
        /// A crank, a rod and a piston that hits a stop.
        #[derive(GaussDynamics)]
        #[gauss(
            coordinates(crank, rod, piston),
            speeds(w, s, v),
            kinematics(crank = w, rod = s, piston = v),
            body(wheel, rotation = rotation_z(crank), mass = 2, inertia = [0.01, 0.01, 0.02]),
            body(arm, parent = wheel, position = [r, 0, 0], rotation = rotation_z(rod),
                 mass = 0.5, center_of_mass = [l / 2, 0, 0], inertia_about_center_of_mass = [0, 0.003, 0.003]),
            particle(mass = 1, position = [piston, 0, 0]),
            point(pin, body = arm, at = [l, 0, 0]),
            constraint(position = pin - [piston, 0, 0]),
            range(piston, to = stop, restitution = 0.6),
            $($clause($($inside)*),)?
        )]
        struct $name {
            r: f64,
            l: f64,
            stop: f64,
        }
    };
}
crank!(WithMultipliers);
crank!(Solved, independent(w));

#[test]
fn impacts_under_constraints_are_those_of_the_solved_system() {
    let (r, l, stop) = (0.1, 0.3, 0.37);
    let kernel = WithMultipliers { r, l, stop }.kernel().unwrap();
    let solved = Solved { r, l, stop }.kernel().unwrap();
    let guess = WithMultipliersState { crank: 1.2, rod: -1.5, piston: 0.32, w: -6.0, ..Default::default() };
    let (q, z) = kernel.project(0.0, &guess.q(), &guess.z()).unwrap();
    let whole = ContactRun::new(&kernel).adaptive(1e-11, 1e-11).run(q, z, 0.0..6.0).unwrap();
    let start = SVector::from([z[0]]);
    let reduced = ContactRun::new(&solved).adaptive(1e-11, 1e-11).run(q, start, 0.0..6.0).unwrap();
    assert!(whole.events().len() >= 3, "{:?}", whole.events());
    assert_eq!(whole.events().len(), reduced.events().len());
    for (a, b) in whole.events().iter().zip(reduced.events()) {
        let (EventKind::Impact(a_hit), EventKind::Impact(b_hit)) = (a.kind, b.kind) else { panic!("{a:?} {b:?}") };
        // Two runs of one motion to 1e-11 a step.
        assert!((a.time - b.time).abs() < 1e-8 && (a_hit.impulse[0] / b_hit.impulse[0] - 1.0).abs() < 1e-7);
        assert!((a_hit.after[0] / a_hit.before[0] + 0.6).abs() < 1e-12);
    }
    let (a, b) = (whole.last().unwrap(), reduced.last().unwrap());
    assert!((a.q - b.q).amax() < 1e-7 && (a.z[0] - b.z[0]).abs() < 1e-6);
}

/// Something that lies on a table that goes up and down.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x),
    particle(mass = 3, position = [0, 0, x]),
    contact(table, gap = x - a * sin(t)),
)]
struct Shaken {
    a: f64,
    #[gauss(gravity)]
    g: f64,
}

#[test]
fn a_table_that_falls_faster_is_left() {
    let (a, g) = (12.0, 9.81);
    let kernel = Shaken { a, g }.kernel().unwrap();
    let run = ContactRun::new(&kernel).adaptive(1e-12, 1e-12);
    let run = run.run(SVector::zeros(), SVector::from([a]), 0.0..FRAC_PI_2).unwrap();
    let [leaves] = run.events() else { panic!("{:?}", run.events()) };
    // Where a sin t = g.
    let wanted = (g / a).asin();
    assert_eq!(leaves.kind, EventKind::Leaves);
    assert!((leaves.time - wanted).abs() < 1e-10, "{:e}", leaves.time - wanted);
    let force = run.forces(0.5).unwrap()[0];
    assert!((force - 3.0 * (g - a * 0.5_f64.sin())).abs() < 1e-11);
    let (flight, end) = (FRAC_PI_2 - wanted, run.last().unwrap());
    let height = a * wanted.sin() + a * wanted.cos() * flight - 0.5 * g * flight * flight;
    assert!((end.q[0] - height).abs() < 1e-10);
}

/// A point that falls onto a floor.
#[derive(GaussDynamics)]
#[gauss(coordinates(z), particle(mass = 1, position = [0, 0, z]), contact(floor, gap = z))]
struct Falls<T> {
    #[gauss(gravity)]
    g: T,
}

#[test]
fn runs_without_contact_forces_refuse_contacts() {
    const { assert!(FallsKernel::<f64>::HAS_CONTACTS) };
    let kernel = Falls { g: 9.81 }.kernel().unwrap();
    let (q, z) = (SVector::from([1.0]), SVector::from([0.0]));
    let simulation = Simulation::new(&kernel);
    let refusals = [
        simulation.adaptive(1e-9, 1e-9).run(q, z, 0.0..1.0).unwrap_err(),
        simulation.momentum_form().fixed_step(0.1).run_to_end(q, z, 0.0..1.0).unwrap_err(),
        simulation.control(Fixed::by(Collocation::midpoint(), 0.1)).attempt(q, z, 0.0..1.0).1.unwrap(),
        simulation.control(Adams::<_, 10>::new(0.1)).run_to_end(q, z, 0.0..1.0).unwrap_err(),
        simulation.adaptive(1e-9, 1e-9).boxed().run(q, z, 0.0..1.0).unwrap_err(),
        // A form that is chosen later is one with contacts.
        simulation.without_contacts().momentum_form().fixed_step(0.1).run_to_end(q, z, 0.0..1.0).unwrap_err(),
    ];
    for refusal in refusals {
        assert_eq!(refusal.kind, IntegrationErrorKind::Contacts);
        assert!(refusal.to_string().contains("(trait `WithContacts` of the crate `gauss-contact`)"), "{refusal}");
    }
    // On purpose: through the floor, in either form; a parabola is exact to the rounding of a few steps.
    let fallen = 1.0 - 0.5 * 9.81;
    let ends = [
        simulation.without_contacts().adaptive(1e-9, 1e-9).run_to_end(q, z, 0.0..1.0).unwrap(),
        simulation.momentum_form().without_contacts().fixed_step(0.1).run_to_end(q, z, 0.0..1.0).unwrap(),
    ];
    assert!(ends.iter().all(|end| (end.sample.q[0] - fallen).abs() < 1e-13));
}

#[test]
fn ensembles_refuse_contacts() {
    type Four = Lanes<f64, 4>;
    let kernel = Falls { g: Four::splat(9.81) }.kernel().unwrap();
    let fresh = || States::<FallsKernel<Four>>::from_fn(6, |_| (SVector::from([1.0]), SVector::from([0.0])));
    let (mut states, method) = (fresh(), RungeKutta(DormandPrince8));
    let refused = Batch::new(&kernel).advance(&method, 0.1, 0.0..1.0, &mut states).unwrap_err();
    assert_eq!(refused.failures.len(), 6);
    assert!(refused.failures.iter().all(|failure| failure.kind == IntegrationErrorKind::Contacts));
    let ends = Batch::new(&kernel).adaptive(1e-9, 1e-9).run(0.0..1.0, &mut states);
    assert!(ends.iter().all(|end| matches!(end, Err(error) if error.kind == IntegrationErrorKind::Contacts)));
    assert!((0..6).all(|i| states.get(i) == (SVector::from([1.0]), SVector::from([0.0]))));

    let fallen = 1.0 - 0.5 * 9.81;
    let through = |states: &States<FallsKernel<Four>>| (0..6).all(|i| (states.get(i).0[0] - fallen).abs() < 1e-13);
    Batch::new(&kernel).without_contacts().advance(&method, 0.1, 0.0..1.0, &mut states).unwrap();
    assert!(through(&states));
    let mut states = fresh();
    let ends = Batch::new(&kernel).without_contacts().adaptive(1e-9, 1e-9).run(0.0..1.0, &mut states);
    assert!(ends.iter().all(Result::is_ok) && through(&states));
}
