//! The energy of runs in which inputs, forces, drives and frames that move give energy too.

use gauss_contact::{ContactErrorKind, ContactStepper, StepScheme};
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::prelude::*;

use crate::common::numbers;

const SCHEMES: [StepScheme; 2] = [StepScheme::Midpoint, StepScheme::MoreauJean];
const H: f64 = 0.01;

/// Two masses on a spring between stops that give way without loss, and a wall behind one: stops set in within a step.
/// An input pushes one, and the frame goes to and fro.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y),
    particle(mass = 1, position = [x, far * sin(t), 0]),
    particle(mass = r, position = [y, 0, 0]),
    spring(coil, along = y - x, length = 0.2, stiffness = k),
    stop(left, along = x, least = 0, stiffness = s, width = 0.01),
    stop(right, along = y, most = 1, stiffness = s, width = 0.01),
    contact(wall, gap = 1.05 - y, restitution = 1),
    input(push),
    drive(x = push),
)]
struct Soft {
    r: f64,
    k: f64,
    s: f64,
    far: f64,
}

/// The largest energy of a run under an input, as a part of that at the start, and why it ended before its steps.
fn largest<K: ContactSystem<Scalar = f64>>(
    kernel: &K,
    (q, z): (K::Configuration, K::Speeds),
    (scheme, h, steps): (StepScheme, f64, u32),
    input: impl Fn(f64, &K::Configuration, &K::Speeds) -> K::Input,
) -> (f64, Option<ContactErrorKind>) {
    let mut stepper = ContactStepper::new(kernel, 0.0, q, z).unwrap().scheme(scheme);
    let start = kernel.energy(0.0, &q, &z);
    let mut most = start;
    for _ in 0..steps {
        let (t, q, z) = (stepper.time(), stepper.configuration(), stepper.speeds());
        most = kernel.energy(t, q, z).max(most);
        let held = input(t + 0.5 * h, q, z);
        if let Err(error) = stepper.step(h, &held) {
            return (most / start, Some(error.kind));
        }
    }
    (most / start, None)
}

/// Energy that stops give for setting in within a step comes from nowhere, whatever else could give some.
#[test]
fn what_nothing_gives_is_told_beside_inputs_and_frames_that_move() {
    let (mut number, mut told) = (numbers(41), [0; 2]);
    for n in 0..48 {
        let phase = 0.1 + 0.35 * (1.0 + number());
        let stiffness = |phase: f64| (phase / H) * (phase / H);
        let (r, s) = (10.0_f64.powf(2.0 * number()), stiffness(phase * 3.0_f64.powf(number())));
        let (k, far) = (0.1 * r / (1.0 + r) * stiffness(phase), [0.0, 0.01][n % 2]);
        let kernel = Soft { r, k, s, far }.kernel().unwrap();
        let (q, z) = ([0.35 + 0.05 * number(), 0.55].into(), [5.0 * number(), 5.0 * number()].into());
        for (told, scheme) in told.iter_mut().zip(SCHEMES) {
            let (most, ended) = largest(&kernel, (q, z), (scheme, H, 30_000), |_, _, _| [0.0].into());
            let (refused, stiff) = match ended {
                Some(ContactErrorKind::EnergyFromNowhere { .. }) => (true, false),
                Some(ContactErrorKind::StiffSprings { .. }) => (false, scheme == StepScheme::MoreauJean),
                _ => (false, false),
            };
            assert!(ended.is_none() || refused || stiff, "{n} {scheme:?}: {ended:?}");
            // As much again as there was, and what a step may gain.
            assert!(most <= 2.5, "{n} {scheme:?} {phase} {r} {s}: {most} {ended:?}");
            *told += usize::from(refused);
        }
    }
    assert!(told.iter().all(|told| *told > 0), "{told:?}");
}

/// A block on the ground, with a damper, on a belt that goes to and fro.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y),
    particle(mass = m, position = [x, 0, y]),
    spring(strut, along = x, stiffness = k, damping = c),
    contact(belt, gap = y, slip = rate(x) - v * sin(3 * t), friction = 0.4, restitution = 0.5),
    input(push),
    drive(x = push),
)]
struct Block {
    m: f64,
    k: f64,
    c: f64,
    v: f64,
    #[gauss(gravity)]
    g: f64,
}

/// Two links with motors and stops, on a hand that is led to and fro.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(a, b, h),
    particle(mass = 1, position = [h + sin(a), 0, -cos(a)]),
    particle(mass = m, position = [h + sin(a) + sin(a + b), 0, -cos(a) - cos(a + b)]),
    particle(mass = 0.5, position = [h, 0, 0]),
    constraint(position = h - lead * sin(4 * t)),
    range(shoulder, along = a, from = -2, to = 2, restitution = 0.5),
    range(elbow, along = b, from = 0, to = 2.5, restitution = e),
    input(first, second),
    drive(a = first),
    drive(b = second),
)]
struct Arm {
    m: f64,
    e: f64,
    lead: f64,
    #[gauss(gravity)]
    g: f64,
}

/// A ball on the floor that a torque spins.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(ball, position = pose.position, rotation = pose.rotation, mass = m, inertia = 0.4 * m * r * r),
    contact(floor, point = ball.position, radius = r, friction = 0.5, restitution = e),
    input(along, across, about),
    torque(motor, body = ball, value = [along, across, about]),
)]
struct Ball {
    m: f64,
    r: f64,
    e: f64,
    #[gauss(gravity)]
    g: f64,
}

/// Motors that give thousands of times what moves, and take it, are no reason to refuse a run.
#[test]
fn what_motors_give_is_explained_however_long_they_run() {
    let mut number = numbers(97);
    for n in 0..12 {
        let mut part = || 0.5 + 0.5 * number();
        let (scheme, h) = (SCHEMES[n % 2], [1.0 / 60.0, 0.01, 1e-3][n % 3]);
        let (m, omega, steps) = (10.0_f64.powf(4.0 * part() - 2.0), 0.5 / h * part(), 2_000);
        let ok = |name: &str, ended: Option<ContactErrorKind>| {
            let refused = matches!(ended, Some(ContactErrorKind::EnergyFromNowhere { .. }));
            assert!(!refused, "{n} {name} {scheme:?}: {ended:?}");
        };
        // Pushed near the frequency of its spring, and at others; from rest.
        let (k, c) = (m * omega * omega * [0.0, 1.0, 0.3][n % 3], [0.0, 1.0][n % 2] * m * omega * part());
        let block = Block { m, k, c, v: [0.0, 2.0][n / 2 % 2], g: 9.81 }.kernel().unwrap();
        let force = 20.0 * m * part();
        let start = (SVector::from([0.0, [0.0, 0.1][n % 2]]), SVector::zeros());
        let (_, ended) = largest(&block, start, (scheme, h, steps), |t, _, _| [force * (omega * t).sin()].into());
        ok("block", ended);

        let arm = Arm { m, e: part(), lead: [0.0, 0.3][n % 2], g: 9.81 }.kernel().unwrap();
        let (q, speed) = (SVector::from([0.3, 0.5, 0.0]), 4.0 * [0.0, 0.3][n % 2]);
        let torque = 15.0 * (1.0 + m) * part();
        let input = |t: f64, q: &SVector<f64, 3>, z: &SVector<f64, 3>| {
            SVector::from([torque * (5.0 * t).sin() - z[0], torque * (1.0 - q[1]) * (7.0 * t).cos() - 0.1 * z[1]])
        };
        let (_, ended) = largest(&arm, (q, SVector::from([0.0, 0.0, speed])), (scheme, h, steps), input);
        ok("arm", ended);

        let (r, e) = (0.05 + 0.1 * part(), part());
        let ball = Ball { m, r, e, g: 9.81 }.kernel().unwrap();
        let torque = m * r * r * 200.0 * part();
        let input = |t: f64, _: &_, z: &SVector<f64, 6>| {
            let drag = 0.4 * m * r * r;
            let [x, y, z] = [3, 4, 5].map(|i| -drag * z[i]);
            SVector::from([x + torque * (3.0 * t).sin(), y + torque * (2.0 * t).cos(), z + torque])
        };
        let start = (Isometry3::translation(0.0, 0.0, 3.0 * r), SVector::from([1.0, 0.0, 0.0, 0.0, 0.0, 5.0]));
        let (_, ended) = largest(&ball, start, (scheme, h, steps), input);
        ok("ball", ended);
    }
}
