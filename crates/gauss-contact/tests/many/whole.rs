//! The energy of steps that are whole on springs: those by `MoreauJean`, which follow ωh up to 1 and refuse the rest.

use gauss_contact::{ContactErrorKind, ContactLanes, ContactStepper, ContactSteps, StepScheme};
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::dual::Dual;
use gauss_runtime::prelude::*;

use crate::common::numbers;

use super::springs::{Row, Walls};

const H: f64 = 0.01;
/// Part by which energy is more than at the start, to and fro: the quarter of the kinetic energy that a step is off by.
const TO_AND_FRO: f64 = 1.0 / 3.0;

/// A mass on a spring, between two walls.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x),
    particle(mass = 1, position = [x, 0, 0]),
    spring(coil, along = x - 0.3, stiffness = k),
    contact(left, gap = x + far, restitution = 1),
    contact(right, gap = 1 + far - x, restitution = 1),
)]
struct One<T> {
    k: T,
    far: T,
}

/// A mass on a spring that a drive makes: no potential energy.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y),
    particle(mass = 1, position = [x, y, 0]),
    drive(x = -k * x),
    contact(far, gap = y),
)]
struct Held {
    k: f64,
}

/// Two masses on a spring between stops that give way without loss, and a wall behind one.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y),
    particle(mass = 1, position = [x, 0, 0]),
    particle(mass = r, position = [y, 0, 0]),
    spring(coil, along = y - x, length = 0.2, stiffness = k),
    stop(left, along = x, least = 0, stiffness = s, width = 0.01),
    stop(right, along = y, most = 1, stiffness = s, width = 0.01),
    contact(wall, gap = 1.05 - y, restitution = 1),
)]
struct Soft {
    r: f64,
    k: f64,
    s: f64,
}

/// A marble on a floor.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(marble, position = pose.position, rotation = pose.rotation, mass = 1e-5, inertia = 4e-6 * r * r),
    contact(floor, point = marble.position, radius = r, friction = 0.5),
)]
struct Marble {
    r: f64,
    #[gauss(gravity)]
    g: f64,
}

/// The largest energy of some steps of 10 ms as a part of that at the start, or why and when they ended.
fn largest<K: ContactSystem<Scalar = f64, Input = ()>>(
    kernel: &K,
    (q, z): (K::Configuration, K::Speeds),
    steps: u32,
) -> Result<f64, (ContactErrorKind, f64)> {
    let mut stepper = ContactStepper::new(kernel, 0.0, q, z).unwrap().scheme(StepScheme::MoreauJean);
    let start = kernel.energy(0.0, &q, &z);
    let mut most = start;
    for _ in 0..steps {
        stepper.step(H, &()).map_err(|error| (error.kind, most / start))?;
        most = kernel.energy(0.0, stepper.configuration(), stepper.speeds()).max(most);
    }
    Ok(most / start)
}

/// A number between 0.05 and 8, each octave as often as the others.
fn between(number: &mut impl FnMut() -> f64) -> f64 {
    0.05 * 160.0_f64.powf(0.5 + 0.5 * number())
}

fn stiffness(phase: f64) -> f64 {
    (phase / H) * (phase / H)
}

/// Either energy goes to and fro, or springs are too stiff; the phase of the stiffest is at most `phase`.
fn check(name: &str, phase: f64, made: Result<f64, (ContactErrorKind, f64)>) {
    match made {
        Ok(most) => assert!(most <= 1.0 + TO_AND_FRO + 1e-3, "{name} {phase}: {most}"),
        Err((ContactErrorKind::StiffSprings { phase: found, step }, most)) => {
            assert!(phase > 1.0 && step == H && found <= phase * (1.0 + 1e-6), "{name} {phase}: {found}");
            assert!(most <= 1.0 + TO_AND_FRO + 1e-3, "{name} {phase}: {most}");
        }
        Err((error, _)) => panic!("{name} {phase}: {error}"),
    }
}

#[test]
fn linear_springs_gain_a_third_or_are_refused() {
    let mut number = numbers(71);
    for n in 0..120 {
        let (phase, x, v) = (between(&mut number), 0.3 + 0.25 * number(), number());
        let far = [0.0, 1e9][n % 2];
        let one = One { k: stiffness(phase), far }.kernel().unwrap();
        check("one", phase, largest(&one, ([x].into(), [v].into()), 2000));

        let r = 10.0_f64.powf(2.0 * number());
        let two = Walls { r, k: r / (1.0 + r) * stiffness(phase) }.kernel().unwrap();
        let (q, z) = ([0.35 + 0.05 * number(), 0.55 + 0.05 * number()].into(), [number(), number()].into());
        check("two", phase, largest(&two, (q, z), 2000));

        let [a, b] = [0, 1].map(|_| stiffness(0.5 * between(&mut number)));
        // No square of ω is more than the largest sum of the entries of a row (S. A. Geršgorin 1931).
        let fastest = H * (a + 2.0 * b).max(2.0 * b + 2.0).sqrt();
        let three = Row { a, b }.kernel().unwrap();
        let [q, z] = [0, 1].map(|_| SVector::from_fn(|_, _| number()));
        check("three", fastest, largest(&three, (q, z), 2000));
    }
}

/// Bounces step after step do not hide from a measure that compares forces of one step with those of the one before.
#[test]
fn what_is_thrown_from_wall_to_wall_in_every_step_is_refused() {
    for phase in [1.01, 1.5, 2.0, 3.9, 4.1, 7.0, 20.0, 1e3] {
        for (x, v) in [(0.05, 0.0), (0.05, -3.0), (0.5, 50.0), (0.9, 0.0)] {
            let one = One { k: stiffness(phase), far: 0.0 }.kernel().unwrap();
            let error = largest(&one, ([x].into(), [v].into()), 2000).unwrap_err().0;
            assert!(matches!(error, ContactErrorKind::StiffSprings { .. }), "{phase} {x} {v}: {error}");
        }
    }
}

#[test]
fn springs_that_are_drives_are_refused_alike() {
    for (phase, ends) in [(0.3, true), (0.95, true), (1.05, false), (1.4, false), (2.5, false), (30.0, false)] {
        let held = Held { k: stiffness(phase) }.kernel().unwrap();
        let mut stepper = ContactStepper::new(&held, 0.0, [0.1, 1.0].into(), [0.0, 0.0].into()).unwrap();
        stepper = stepper.scheme(StepScheme::MoreauJean);
        let made = (0..2000).try_for_each(|_| stepper.step(H, &()).map(|_| ()));
        assert_eq!(made.is_ok(), ends, "{phase} {made:?}");
        let said = made.err().map_or(String::new(), |error| error.to_string());
        assert!(ends || said.contains("`StepScheme::Midpoint`"), "{said}");
    }
}

/// Stops that set in within a step are followed up to the same stiffness, and gain by chance all the same.
#[test]
fn stops_that_give_way_gain_no_more_than_all_there_was() {
    let (mut number, mut stiff, mut gained) = (numbers(41), 0, 0);
    for _ in 0..48 {
        let phase = 0.1 + 0.35 * (1.0 + number());
        let (r, s) = (10.0_f64.powf(2.0 * number()), stiffness(phase * 3.0_f64.powf(number())));
        let soft = Soft { r, k: 0.1 * r / (1.0 + r) * stiffness(phase), s }.kernel().unwrap();
        let (q, z) = ([0.35 + 0.05 * number(), 0.55].into(), [5.0 * number(), 5.0 * number()].into());
        match largest(&soft, (q, z), 30_000) {
            Ok(most) => assert!(most <= 2.0, "{phase} {r} {s}: {most}"),
            Err((ContactErrorKind::StiffSprings { .. }, most)) => {
                assert!(most <= 2.0, "{phase} {r} {s}: {most}");
                stiff += 1;
            }
            Err((ContactErrorKind::EnergyFromNowhere { .. }, most)) => {
                assert!(most <= 2.0, "{phase} {r} {s}: {most}");
                gained += 1;
            }
            Err((error, _)) => panic!("{phase} {r} {s}: {error}"),
        }
    }
    assert!(stiff < 36 && gained > 0, "{stiff} {gained}");
}

/// Weight, as a body that rolls sees it, turns; that is no spring.
#[test]
fn what_rolls_and_turns_is_not_stiff() {
    let mut number = numbers(73);
    for r in [3e-4, 1e-3, 1e-2] {
        for _ in 0..20 {
            let marble = Marble { r, g: 9.81 }.kernel().unwrap();
            // At rest in part, rolling, tossed.
            let v = SVector::from_fn(|i, _| if i < 3 { r } else { 1.0 } * 8.0 * number() * number().signum().max(0.0));
            let q = Isometry3::translation(0.0, 0.0, r * (1.0 + number().max(0.0)));
            let mut stepper = ContactStepper::new(&marble, 0.0, q, v).unwrap().scheme(StepScheme::MoreauJean);
            for n in 0..300 {
                let made = stepper.step(1.0 / 60.0, &());
                assert!(made.is_ok(), "{r} {n} {v:?} {made:?}");
            }
        }
    }
}

#[test]
fn lanes_and_derivatives_are_refused_alike() {
    type Four = Lanes<f64, 4>;
    let phases = [0.3, 1.2, 0.9, 4.5];
    let kernels = phases.map(|phase| One { k: stiffness(phase), far: 1e9 }.kernel().unwrap());
    let wide = One { k: Four::from_fn(|i| stiffness(phases[i])), far: Four::splat(1e9) }.kernel().unwrap();
    let constant = Dual::<2>::constant;
    let dual = phases.map(|phase| One { k: constant(stiffness(phase)), far: constant(1e9) }.kernel().unwrap());
    let new =
        |kernel| ContactStepper::new(kernel, 0.0, [0.02].into(), [1.0].into()).unwrap().scheme(StepScheme::MoreauJean);
    let mut lanes = ContactLanes::of(&wide, kernels.iter().map(new).collect()).unwrap();
    let [mut single, mut followed] = [0, 1].map(|_| kernels.iter().map(new).collect::<Vec<_>>());
    for _ in 0..100 {
        let outcomes = lanes.step(H, &()).to_vec();
        for (lane, stepper) in single.iter_mut().enumerate() {
            let (made, with_slopes) = (stepper.step(H, &()), &mut followed[lane]);
            let slopes = with_slopes.step_with_derivatives::<_, 2, 2, 0, 0>(H, &(), &dual[lane]);
            assert_eq!(outcomes[lane], made, "{lane}");
            assert_eq!(made.is_ok(), phases[lane] <= 1.0, "{lane} {made:?}");
            assert_eq!(slopes.map(|_| ()), made.map(|_| ()), "{lane}");
            let states = [&lanes.steppers()[lane], stepper, with_slopes].map(|at| (*at.configuration(), *at.speeds()));
            assert!(states[1..].iter().all(|state| *state == states[0]), "{lane} {states:?}");
        }
    }
    // What is refused stays where it was.
    assert_eq!(single[1].time(), 0.0);
}

/// Steps with a tolerance are as short as they must be.
#[test]
fn steps_with_a_tolerance_are_shortened_instead() {
    let omega = 300.0;
    let kernel = One { k: omega * omega, far: 1e9 }.kernel().unwrap();
    let steps = ContactSteps::new(&kernel, H).scheme(StepScheme::MoreauJean).adaptive(1e-6, 1e-6);
    let run = steps.run([0.31].into(), [1.0].into(), 0.0..1.0).unwrap();
    let exact = 0.3 + 0.01 * (omega * 1.0_f64).cos() + 1.0 / omega * (omega * 1.0_f64).sin();
    assert!((run.last().unwrap().state.q[0] - exact).abs() < 1e-3);
}

/// The derivation tells what may raise the energy.
#[test]
fn scenes_say_whether_they_keep_their_energy() {
    const { assert!(OneKernel::<f64>::KEEPS_ENERGY && SoftKernel::KEEPS_ENERGY && MarbleKernel::KEEPS_ENERGY) };
    const { assert!(DampedKernel::KEEPS_ENERGY) };
    const { assert!(!HeldKernel::KEEPS_ENERGY && !FedKernel::KEEPS_ENERGY && !ShakenKernel::KEEPS_ENERGY) };
    const { assert!(!PulledKernel::KEEPS_ENERGY) };
}

/// A mass on a spring with a damper.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x),
    particle(mass = 1, position = [x, 0, 0]),
    spring(coil, along = x, stiffness = 10, damping = 1),
    contact(wall, gap = x + 1),
)]
struct Damped {}

/// A mass that an input could push.
#[derive(GaussDynamics)]
#[gauss(coordinates(x), particle(mass = 1, position = [x, 0, 0]), contact(wall, gap = x), input(push), drive(x = push))]
struct Fed {}

/// A mass on a frame that moves.
#[derive(GaussDynamics)]
#[gauss(coordinates(x), particle(mass = 1, position = [x + sin(3 * t), 0, 0]), contact(wall, gap = x))]
struct Shaken {}

/// A mass on a spring that is drawn out in time.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x),
    particle(mass = 1, position = [x, 0, 0]),
    spring(coil, along = x - t, stiffness = 10),
    contact(wall, gap = x + 1),
)]
struct Pulled {}
