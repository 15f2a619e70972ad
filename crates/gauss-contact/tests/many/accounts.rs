//! The energy of steps with impacts: none comes from nowhere, and what a step errs by is in its report.

use gauss_contact::{ContactErrorKind, ContactRun, ContactStepper, ContactSteps, InMode, Mode, StepScheme};
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::prelude::*;

use crate::common::numbers;

/// A box on its corners.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(hull, position = pose.position, rotation = pose.rotation, mass = m,
        inertia = [m * (b * b + c * c) / 12, m * (a * a + c * c) / 12, m * (a * a + b * b) / 12]),
    contact(floor, point = hull.position, edges = [a, b, c], friction = mu, restitution = e),
)]
struct Hull {
    m: f64,
    a: f64,
    b: f64,
    c: f64,
    mu: f64,
    e: f64,
    #[gauss(gravity)]
    g: f64,
}

/// Two rods on a hinge, whose mass matrix changes with the angle between them.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, a, b),
    body(one, position = [x, y, 0], rotation = rotation_z(a), mass = m, center_of_mass = [0.25, 0, 0],
        inertia_about_center_of_mass = [0, m / 48, m / 48]),
    body(two, parent = one, position = [0.5, 0, 0], rotation = rotation_z(b), mass = 3 * m,
        center_of_mass = [0.25, 0, 0], inertia_about_center_of_mass = [0, m / 16, m / 16]),
    point(tip, body = two, at = [0.5, 0, 0]),
    contact(foot, point = [x, y, 0], plane = [0, 1, 0], friction = mu, restitution = e),
    contact(knee, point = two.position, plane = [0, 1, 0], friction = mu, restitution = e),
    contact(hand, point = tip, plane = [0, 1, 0], friction = mu, restitution = e),
)]
struct Rods {
    m: f64,
    mu: f64,
    e: f64,
    #[gauss(gravity)]
    g: Vector3<f64>,
}

/// All that steps gain in 2 s, as a part of a scale of energy. A step with an impact that is made as a whole gains no
/// more than it tells.
fn gains<K: ContactSystem<Scalar = f64, Input = ()>>(
    kernel: &K,
    (q, z): (K::Configuration, K::Speeds),
    (h, scheme, scale): (f64, StepScheme, f64),
) -> f64 {
    let mut stepper = ContactStepper::new(kernel, 0.0, q, z).unwrap().scheme(scheme);
    let mut gains = 0.0;
    while stepper.time() < 2.0 {
        let energy =
            |stepper: &ContactStepper<'_, K>| kernel.energy(stepper.time(), stepper.configuration(), stepper.speeds());
        let before = energy(&stepper);
        // Two spikes on one spot may have no solution; that is said.
        let Ok(report) = stepper.step(h, &()) else { break };
        let gained = energy(&stepper) - before;
        gains += gained.max(0.0) / scale;
        // Rates of energy are differences: half of the digits of what weight does in the step.
        let told = report.unexplained != 0.0 && report.parts == 0;
        assert!(!told || gained <= report.unexplained + 1e-8 * scale, "{gained:e} {report:?}");
    }
    gains
}

/// Steps of 1 ms and of 1/60 s, without friction and without loss, which is the hardest, with neither, and with both.
#[test]
fn impacts_gain_little_and_tell_it() {
    let mut number = numbers(4711);
    for n in 0..48 {
        let mut part = || 0.5 + 0.5 * number();
        let (scheme, h) = ([StepScheme::Midpoint, StepScheme::MoreauJean][n % 2], [1e-3, 1.0 / 60.0][n / 2 % 2]);
        let (mu, e) = [(0.0, 1.0), (0.0, part()), (part(), 0.0), (part(), 0.9 * part())][n / 4 % 4];
        let m = 10.0_f64.powi([-6, 0, 6][n / 16]);
        let name = format!("{n}: {scheme:?}, h {h}, μ {mu}, e {e}");

        let (a, b, c) = (0.1 + 0.3 * part(), 0.1 + 0.3 * part(), 0.1 + 0.3 * part());
        let hull = Hull { m, a, b, c, mu, e, g: 9.81 }.kernel().unwrap();
        let pose = Isometry3::new(Vector3::new(0.0, 0.0, 0.7), Vector3::from_fn(|_, _| 3.0 * part()));
        let z = SVector::from_fn(|i, _| if i < 3 { 2.0 } else { 10.0 } * (2.0 * part() - 1.0));
        let of_hull = gains(&hull, (pose, z), (h, scheme, hull.energy(0.0, &pose, &z)));

        let rods = Rods { m, mu, e, g: Vector3::new(0.0, -9.81, 0.0) }.kernel().unwrap();
        let q = SVector::from([0.0, 1.3, 6.0 * part(), 4.0 * part()]);
        let z = SVector::from_fn(|i, _| if i < 2 { 1.0 } else { 4.0 } * (2.0 * part() - 1.0));
        let of_rods = gains(&rods, (q, z), (h, scheme, rods.energy(0.0, &q, &z).max(m * 4.0 * 9.81 * 1.3)));

        // Steps without a memory are not made in parts: they tell.
        if scheme == StepScheme::Midpoint {
            // An impact gains a thousandth of what is left at most, or is confined to a sixteenth of a step; in the air
            // speeds are off by a millionth a step.
            assert!(of_hull < 1e-2, "{name}: {of_hull}");
            // Rods gain in the air as well where they turn by ωh a step, with ω of 10 to 40 rad/s.
            let bound = if h > 1e-2 { 0.5 } else { 0.05 };
            assert!(of_rods < bound, "{name}: {of_rods}");
        }
    }
}

/// A body before a wall that comes, or on a belt that goes.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x), particle(mass = 1, position = [x, 0, 0]),
    contact(wall, gap = x - v * t, restitution = 0.5),
)]
struct Pushed {
    v: f64,
}

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y), particle(mass = 1, position = [x, 0, y]), gravity = 10,
    contact(belt, gap = y, slip = rate(x) - v, friction = 0.3, restitution = 0.2),
)]
struct OnABelt {
    v: f64,
}

/// A paddle that a constraint drives, by its place or by its speed.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, h), particle(mass = 1, position = [x, 0, 0]), particle(mass = m, position = [h, 0, 0]),
    constraint(position = h - 3 * t), contact(paddle, gap = x - h, restitution = 0.5),
)]
struct ByPlace {
    m: f64,
}

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, h), particle(mass = 1, position = [x, 0, 0]), particle(mass = m, position = [h, 0, 0]),
    constraint(velocity = rate(h) - 3), contact(paddle, gap = x - h, restitution = 0.5),
)]
struct BySpeed {
    m: f64,
}

/// A drive gives the energy that bodies get from surfaces which it moves: no step is refused for it.
#[test]
fn walls_belts_and_paddles_that_are_driven_give_energy() {
    for h in [1e-2, 1e-3, 1e-4] {
        for scheme in [StepScheme::Midpoint, StepScheme::MoreauJean] {
            // It is struck when the wall is there, at 0.1, and leaves at v(1 + e): off by where in a step that is.
            let kernel = Pushed { v: 3.0 }.kernel().unwrap();
            let run = ContactSteps::new(&kernel, h).scheme(scheme);
            let run = run.run([0.1].into(), [0.0].into(), 0.0..0.5).unwrap();
            let (q, z) = { run.samples.last().map(|step| (step.state.q, step.state.z)).unwrap() };
            assert!((z[0] - 4.5).abs() < 1e-9 && (q[0] - 2.2).abs() < 5.0 * h, "{h} {scheme:?}: {q} {z}");
            let kernel = OnABelt { v: 5.0 }.kernel().unwrap();
            let run = ContactSteps::new(&kernel, h).scheme(scheme);
            let run = run.run([0.0, 0.05].into(), [0.0, 0.0].into(), 0.0..2.5).unwrap();
            let z = run.samples.last().unwrap().state.z;
            assert!((z[0] - 5.0).abs() < 1e-9 && z[1].abs() < 1e-9, "{h} {scheme:?}: {z}");
            for m in [1e-3, 1.0] {
                let kernel = ByPlace { m }.kernel().unwrap();
                let run = ContactSteps::new(&kernel, h).scheme(scheme);
                let run = run.run([0.1, 0.0].into(), [0.0, 3.0].into(), 0.0..0.5).unwrap();
                assert!((run.samples.last().unwrap().state.z[0] - 4.5).abs() < 1e-9, "{h} {scheme:?} {m}");
                let kernel = BySpeed { m }.kernel().unwrap();
                let run = ContactSteps::new(&kernel, h).scheme(scheme);
                let run = run.run([0.1, 0.0].into(), [0.0, 3.0].into(), 0.0..0.5).unwrap();
                assert!((run.samples.last().unwrap().state.z[0] - 4.5).abs() < 1e-9, "{h} {scheme:?} {m}");
            }
        }
    }
}

/// A gap that has no value beyond a place.
#[derive(GaussDynamics)]
#[gauss(coordinates(x), particle(mass = 1, position = [x, 0, 0]), contact(wall, gap = sqrt(x) + 0.1))]
struct Undefined {}

#[test]
fn gaps_that_are_no_numbers_end_steps() {
    let kernel = Undefined {}.kernel().unwrap();
    let (run, error) = ContactSteps::new(&kernel, 1e-3).attempt([0.5].into(), [-1.0].into(), 0.0..2.0);
    let error = error.unwrap();
    assert_eq!((error.contact, error.kind), (Some("wall"), ContactErrorKind::NonFinite));
    assert!((error.time - 0.5).abs() < 2e-3 && run.samples.last().unwrap().state.q[0] >= 0.0);
}

/// A coin over a table.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(z, a),
    body(coin, position = [0, 0, z], rotation = rotation_x(a), mass = 0.01, inertia = [6e-7, 6e-7, 1.2e-6]),
    contact(table, point = coin.position, rim = 0.01, axis = [0, 0, 1], restitution = 0.3),
    gravity = 9.81,
)]
struct Coin {}

#[test]
fn a_coin_that_falls_flat_is_told_what_to_do() {
    let kernel = Coin {}.kernel().unwrap();
    // At once, and after a fall.
    for (z, a) in [(0.0, 0.0), (0.02, 0.0)] {
        let steps = ContactSteps::new(&kernel, 1e-3).run([z, a].into(), [0.0, 0.0].into(), 0.0..1.0).map(|_| ());
        let run = ContactRun::new(&kernel).adaptive(1e-8, 1e-8).run([z, a].into(), [0.0, 0.0].into(), 0.0..1.0);
        for error in [steps.unwrap_err(), run.map(|_| ()).unwrap_err()] {
            assert_eq!(error.contact, Some("table"), "{z} {a}: {error}");
            assert!(error.to_string().contains("give points on it contacts of their own"), "{error}");
        }
    }
}

/// States of rounding: what lies, by what a step has left of it, is at rest.
#[test]
fn what_rests_to_rounding_has_the_forces_of_rest() {
    let kernel = OnABelt { v: 0.0 }.kernel().unwrap();
    for rate in [0.0, 1e-17, 1e-300, -1e-17, 8e-14, -8e-14] {
        for gap in [0.0, 1e-17, -1e-17, 1e-15] {
            let (q, z): (SVector<f64, 2>, SVector<f64, 2>) = ([0.3, gap].into(), [0.5 * rate, rate].into());
            let rests = InMode::at(&kernel, 0.0, &q, &z, &()).unwrap();
            let forces = rests.contact_forces(0.0, &q, &z, &());
            assert_eq!(rests.modes(), [Mode::Sticks], "{rate} {gap}");
            assert!((forces[0] - 10.0).abs() < 1e-12 && forces[1].abs() < 1e-12, "{rate} {gap}: {forces:?}");
        }
    }
    // What moves by more than that is not at rest: it slides, flies, or strikes.
    let at = |y: f64, z: [f64; 2]| InMode::at(&kernel, 0.0, &[0.3, y].into(), &z.into(), &());
    assert!(matches!(at(0.0, [1e-5, 0.0]).unwrap().modes(), [Mode::Slides(_)]));
    assert_eq!(at(0.0, [0.0, 1e-5]).unwrap().modes(), [Mode::Open]);
    assert_eq!(at(1e-9, [0.0, 0.0]).unwrap().modes(), [Mode::Open]);
    assert!(matches!(at(0.0, [0.0, -1e-5]).unwrap_err().kind, ContactErrorKind::Strikes { .. }));
}
