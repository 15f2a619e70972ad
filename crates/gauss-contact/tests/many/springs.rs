//! The energy of what swings undamped in steps, from slow springs to those that a step cannot follow.

use gauss_contact::{ContactErrorKind, ContactLanes, ContactStepper, ContactSteps, StepScheme};
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::prelude::*;

use crate::common::numbers;

const SCHEMES: [StepScheme; 2] = [StepScheme::Midpoint, StepScheme::MoreauJean];
const H: f64 = 0.01;
/// The part by which steps whose forces are not taken at the mean place are off, to and fro: (ωh)²/8 up to ωh = 0.3,
/// at each end of the swing.
const TO_AND_FRO: f64 = 2.0 * 0.09 / 8.0;

/// A mass on a spring, far from the only thing to touch.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x),
    particle(mass = m, position = [x, 0, 0]),
    spring(coil, along = x, stiffness = k),
    contact(far, gap = x + 1e9),
)]
struct Swing<T> {
    m: T,
    k: T,
}

/// A plate on three springs with dampers, which comes to rest.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, z, a),
    body(plate, position = [x, 0, z], rotation = rotation_y(a), mass = 1, inertia = 0.1),
    point(left, body = plate, at = [-0.5, 0, -0.1]),
    point(right, body = plate, at = [0.5, 0, -0.1]),
    spring(one, from = [-0.5, 0, 0], to = left, stiffness = k, length = 0.5, damping = c),
    spring(two, from = [0.5, 0, 0], to = right, stiffness = k, length = 0.5, damping = c),
    spring(aside, along = x, stiffness = k, damping = c),
    contact(far, gap = z + 1e3),
)]
struct Plate {
    k: f64,
    c: f64,
    #[gauss(gravity)]
    g: f64,
}

/// Two masses on a spring, between two walls.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y),
    particle(mass = 1, position = [x, 0, 0]),
    particle(mass = r, position = [y, 0, 0]),
    spring(coil, along = y - x, length = 0.2, stiffness = k),
    contact(left, gap = x, restitution = 1),
    contact(right, gap = 1 - y, restitution = 1),
)]
pub struct Walls {
    pub r: f64,
    pub k: f64,
}

/// Three masses in a row, on springs of unlike stiffness.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, z),
    particle(mass = 1, position = [x, 0, 0]),
    particle(mass = 1, position = [y, 0, 0]),
    particle(mass = 1, position = [z, 0, 0]),
    spring(first, along = x, stiffness = a),
    spring(second, along = y - x, stiffness = b),
    spring(third, along = z - y, stiffness = 1),
    contact(far, gap = x + 1e9),
)]
pub struct Row {
    pub a: f64,
    pub b: f64,
}

/// A bead on a ring that a constraint holds, between two walls.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y),
    particle(mass = m, position = [x, 0, y]),
    constraint(position = x * x + y * y - 1),
    contact(right, gap = 0.7 - x, restitution = 1),
    contact(left, gap = x + 0.6, restitution = 1),
)]
struct Ring {
    m: f64,
    #[gauss(gravity)]
    g: f64,
}

/// The largest energy of 2000 steps of 10 ms, and the sum of what they gained and told, as parts of that at the start;
/// or why they ended.
fn largest<K: ContactSystem<Scalar = f64, Input = ()>>(
    kernel: &K,
    (q, z): (K::Configuration, K::Speeds),
    (h, scheme): (f64, StepScheme),
) -> Result<(f64, f64), ContactErrorKind> {
    let mut stepper = ContactStepper::new(kernel, 0.0, q, z).unwrap().scheme(scheme);
    let start = kernel.energy(0.0, &q, &z);
    let (mut most, mut told) = (start, 0.0);
    for _ in 0..2000 {
        told += stepper.step(h, &()).map_err(|error| error.kind)?.unexplained.max(0.0);
        most = kernel.energy(0.0, stepper.configuration(), stepper.speeds()).max(most);
    }
    Ok((most / start, told / start))
}

/// A number between 0.1 and 16, each octave as often as the others.
fn between(number: &mut impl FnMut() -> f64) -> f64 {
    0.1 * 160.0_f64.powf(0.5 + 0.5 * number())
}

#[test]
fn what_swings_undamped_gains_nothing_at_any_stiffness() {
    let mut number = numbers(41);
    // The last two with ωh = 2 from rest, where a step leads from one end of the swing to the middle.
    let fixed = [0.2, 0.5, 1.05, 1.2, 1.4, 1.6, 2.1, 2.5, 4.5, 5.0, 7.0, 10.0, 14.0, 15.5, 2.0];
    for (n, phase) in fixed.iter().map(Some).chain(core::iter::repeat_n(None, 60)).enumerate() {
        let phase = phase.copied().unwrap_or_else(|| between(&mut number));
        let kernel = Swing { m: 1.0, k: (phase / H) * (phase / H) }.kernel().unwrap();
        let state = if n == 14 { (0.02, 0.0) } else { (number(), [0.0, number()][n % 2]) };
        let (most, _) = largest(&kernel, ([state.0].into(), [state.1].into()), (H, StepScheme::Midpoint)).unwrap();
        // Where forces are taken at the mean place energy stays, but for what attempts settle to.
        let allowed = if phase < 0.4 { 2.0 * TO_AND_FRO } else { 1e-2 };
        assert!(most <= 1.0 + allowed, "{phase} {state:?}: {most}");
    }
}

#[test]
fn springs_beyond_sixteen_parts_are_refused() {
    for phase in [100.0, 1e3, 1e4] {
        let kernel = Swing { m: 1.0, k: (phase / H) * (phase / H) }.kernel().unwrap();
        let error = largest(&kernel, ([0.02].into(), [1.0].into()), (H, StepScheme::Midpoint)).unwrap_err();
        assert!(matches!(error, ContactErrorKind::Stiff { speed: 0, .. }), "{phase}: {error}");
    }
}

#[test]
fn springs_of_unlike_stiffness_gain_little_or_are_refused() {
    let (mut number, mut refused) = (numbers(43), 0);
    for _ in 0..40 {
        let [a, b] = [0, 1].map(|_| (between(&mut number) / H).powi(2));
        let [q, z] = [0, 1].map(|_| SVector::from_fn(|_, _| number()));
        match largest(&Row { a, b }.kernel().unwrap(), (q, z), (H, StepScheme::Midpoint)) {
            Ok((most, _)) => assert!(most <= 1.01 + TO_AND_FRO, "{a} {b}: {most}"),
            Err(ContactErrorKind::Stiff { .. }) => refused += 1,
            Err(error) => panic!("{error}"),
        }
    }
    // Two springs of h ω near 16 are faster together.
    assert!(refused < 10, "{refused}");
}

/// The largest energy of two masses of any ratio between walls, and what steps told, for the phase of their spring.
fn between_walls(number: &mut impl FnMut() -> f64, phase: f64) -> Result<(f64, f64), ContactErrorKind> {
    let r = 10.0_f64.powf(2.0 * number());
    let kernel = Walls { r, k: r / (1.0 + r) * (phase / H) * (phase / H) }.kernel().unwrap();
    let (q, z) = ([0.35 + 0.05 * number(), 0.55 + 0.05 * number()].into(), [number(), number()].into());
    largest(&kernel, (q, z), (H, StepScheme::Midpoint))
}

#[test]
fn masses_that_bounce_on_a_spring_gain_little() {
    let mut number = numbers(47);
    for _ in 0..40 {
        // Up to a phase with which the spring throws no mass through the room in a step.
        let phase = 2.0 * between(&mut number) / 16.0;
        let (most, _) = between_walls(&mut number, phase).unwrap();
        // Up to a fifth: it was 10⁵ times as much before.
        assert!(most <= 1.2, "{phase}: {most}");
    }
}

/// Where a spring throws masses through the room within a step, what they gain is told, or refused.
#[test]
fn what_a_step_gains_is_told_or_refused() {
    let (mut number, mut refused) = (numbers(53), 0);
    for _ in 0..40 {
        let phase = 8.0 + 6.0 * number();
        match between_walls(&mut number, phase) {
            Ok((most, told)) => assert!(most <= 1.02 + told, "{phase}: {most} {told}"),
            Err(ContactErrorKind::Stiff { .. } | ContactErrorKind::EnergyFromNowhere { .. }) => refused += 1,
            Err(error) => panic!("{error}"),
        }
    }
    assert!(refused < 35, "{refused}");
}

/// A step that is made in parts is its halves: it has no estimate, and is shortened.
#[test]
fn adaptive_steps_on_stiff_springs_keep_their_tolerance() {
    let omega = 100.0;
    let kernel = Swing { m: 1.0, k: omega * omega }.kernel().unwrap();
    let exact = 0.02 * (omega * 1.0_f64).cos() + 1.0 / omega * (omega * 1.0_f64).sin();
    let off = |tolerance: f64| {
        let steps = ContactSteps::new(&kernel, H).adaptive(tolerance, tolerance);
        let run = steps.run([0.02].into(), [1.0].into(), 0.0..1.0).unwrap();
        (run.last().unwrap().state.q[0] - exact).abs()
    };
    // Errors follow the tolerance, whose third root the length of a step is and whose two thirds they are.
    let [coarse, fine] = [1e-5, 1e-8].map(off);
    assert!(coarse < 2e-3 && fine < 2e-5 && fine < coarse / 30.0, "{coarse:e} {fine:e}");
}

#[test]
fn what_rests_on_damped_springs_goes_on() {
    for scheme in SCHEMES {
        let kernel = Plate { k: 400.0, c: 28.0, g: 9.81 }.kernel().unwrap();
        // 20 s, where speeds are rounding after two.
        let (most, _) = largest(&kernel, ([0.01, 0.55, 0.02].into(), [0.0, 0.1, 0.0].into()), (H, scheme)).unwrap();
        assert!(most <= 1.0, "{scheme:?} {most}");
    }
}

#[test]
fn a_bead_that_bounces_on_a_ring_gains_what_it_tells() {
    let mut number = numbers(59);
    for n in 0..16 {
        let h = [1e-3, 1.0 / 60.0][n % 2];
        let (m, v) = (10.0_f64.powi([-6, 0, 6][n % 3]), 4.0 + 3.0 * number());
        let kernel = Ring { m, g: 9.81 }.kernel().unwrap();
        let mut stepper = ContactStepper::new(&kernel, 0.0, [0.0, -1.0].into(), [v, 0.0].into()).unwrap();
        let energy = |q: &_, z: &_| kernel.energy(0.0, q, z);
        let (start, scale) = (energy(stepper.configuration(), stepper.speeds()), 0.5 * m * v * v);
        let (mut most, mut told) = (0.0_f64, 0.0);
        while stepper.time() < 3.0 {
            told += stepper.step(h, &()).unwrap().unexplained.max(0.0);
            most = most.max(energy(stepper.configuration(), stepper.speeds()) - start);
        }
        // A pendulum of ω = 3 rad/s and a way of vh on the circle, to second order, beside what impacts tell.
        let second = (h * v) * (h * v) + (3.0 * h) * (3.0 * h);
        assert!(most < second * scale + told, "{h} {v}: {}", most / scale);
    }
}

#[test]
fn lanes_on_springs_have_the_bits_of_single_steps() {
    let stiffness = [0.3, 1.2, 4.5, 0.1].map(|phase| (phase / H) * (phase / H));
    let kernels = stiffness.map(|k| Swing { m: 1.0, k }.kernel().unwrap());
    let wide =
        Swing { m: Lanes::<f64, 4>::splat(1.0), k: Lanes::<f64, 4>::from_fn(|i| stiffness[i]) }.kernel().unwrap();
    let new = |kernel| ContactStepper::new(kernel, 0.0, [0.02].into(), [1.0].into()).unwrap();
    let mut lanes = ContactLanes::of(&wide, kernels.iter().map(new).collect()).unwrap();
    let mut single: Vec<_> = kernels.iter().map(new).collect();
    for _ in 0..300 {
        assert!(lanes.step(H, &()).iter().all(Result::is_ok));
        for (lane, stepper) in lanes.steppers().iter().zip(&mut single) {
            stepper.step(H, &()).unwrap();
            assert_eq!((lane.configuration(), lane.speeds()), (stepper.configuration(), stepper.speeds()));
        }
    }
}
