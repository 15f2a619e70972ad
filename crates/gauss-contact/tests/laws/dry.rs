//! Dry friction of a given bound: joints, belts, brakes, clutches; friction of two axes.

use std::f64::consts::PI;

use gauss_contact::{ContactErrorKind, ContactRun, EventKind, Mode};
use gauss_runtime::prelude::*;

use crate::common::{V, numbers};

/// A mass on a spring on a floor.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x),
    particle(mass = 1, position = [x, 0, 0]),
    potential = x * x / 2,
    dry_friction(x, bound = f),
)]
struct Oscillator {
    f: f64,
}

#[test]
fn an_oscillator_rests_where_its_spring_cannot_move_it() {
    let kernel = Oscillator { f: 1.0 }.kernel().unwrap();
    let run = ContactRun::new(&kernel).adaptive(1e-12, 1e-12).run([12.0].into(), [6.0].into(), 0.0..30.0).unwrap();
    // About the centres ∓1 by turns: √205 → turns at −1 + √205, then 2 less each time.
    assert_eq!(run.events().len(), 8, "{:?}", run.events());
    assert!(run.events()[..7].iter().all(|event| matches!(event.kind, EventKind::Reverses(_))));
    assert_eq!(run.events()[7].kind, EventKind::Sticks);
    let end = run.last().unwrap();
    // Eight parts, of 30 steps at most, each of local errors of 1e-12 · 14.
    assert!((end.q[0] - (15.0 - 205.0_f64.sqrt())).abs() < 8.0 * 30.0 * 14e-12, "{}", end.q[0]);
    // It stays to the last bit, held by the force of its spring.
    assert_eq!((end.z[0], run.at(29.0).unwrap().q), (0.0, end.q));
    assert!((run.forces(29.0).unwrap()[0] - end.q[0]).abs() <= 4.0 * f64::EPSILON);
}

#[test]
fn a_bound_is_a_number_that_is_not_negative() {
    assert!(Oscillator { f: -1.0 }.kernel().unwrap_err().to_string().contains('f'));
    let kernel = Belt { k: 10.0, speed: 0.3, f: 1.0, fall: 2.0 }.kernel().unwrap();
    // So fast that the bound 1 − 2 |s| is negative.
    let error = ContactRun::new(&kernel).adaptive(1e-9, 1e-9).run([0.0].into(), [2.0].into(), 0.0..1.0);
    let error = error.err().unwrap();
    assert!(matches!(error.kind, ContactErrorKind::InvalidFriction { friction } if friction < 0.0), "{error}");
    assert_eq!((error.contact, error.time), (Some("belt"), 0.0));
}

/// A mass on a belt, held by a spring; friction is weaker the faster it slips.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x),
    particle(mass = 1, position = [x, 0, 0]),
    potential = k * x * x / 2,
    dry_friction(belt, slip = rate(x) - speed, bound = f - fall * abs(rate(x) - speed)),
)]
struct Belt {
    k: f64,
    speed: f64,
    f: f64,
    fall: f64,
}

#[test]
fn a_block_on_a_belt_has_the_period_of_its_closed_form() {
    let (k, v, f, fall) = (10.0, 0.3, 1.0, 0.5);
    let kernel = Belt { k, speed: v, f, fall }.kernel().unwrap();
    // From where it begins to slip, x = f/k, ẋ = v: ẍ − c ẋ + k x = f − c v, a growing oscillation, until ẋ = v again.
    let (growth, start) = (0.5 * fall, fall * v / k);
    let omega = (k - growth * growth).sqrt();
    let sine = (v - growth * start) / omega;
    let place = |t: f64| (growth * t).exp() * (start * (omega * t).cos() + sine * (omega * t).sin());
    let speed = |t: f64| {
        let (s, c) = (omega * t).sin_cos();
        (growth * t).exp() * (v * c + (growth * sine - omega * start) * s)
    };
    let (mut low, mut high) = (PI / omega, 2.0 * PI / omega);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if speed(middle) < v { low = middle } else { high = middle }
    }
    let sticks = low;
    let period = sticks + (start - place(sticks)) / v;

    let run = ContactRun::new(&kernel).adaptive(1e-12, 1e-12).run([0.0].into(), [v].into(), 0.0..20.0).unwrap();
    let slips: Vec<f64> =
        run.events().iter().filter(|e| matches!(e.kind, EventKind::Slides(_))).map(|e| e.time).collect();
    assert!(slips.len() >= 5, "{:?}", run.events());
    assert!((slips[0] - f / (k * v)).abs() < 1e-11, "{}", slips[0]);
    for pair in slips.windows(2) {
        // Some thirty steps with errors of 1e-12; the rate of the force at a slip is k v = 3.
        assert!((pair[1] - pair[0] - period).abs() < 1e-10, "{} {period}", pair[1] - pair[0]);
    }
    // While it sticks it goes with the belt to the last bit.
    let (mut stuck, mut sliding) = (0, 0);
    for sample in run.segments().iter().flat_map(|part| part.trajectory().iter().map(|s| (part.modes()[0], s.z[0]))) {
        match sample {
            (Mode::Sticks, z) => {
                assert_eq!(z, v);
                stuck += 1;
            }
            _ => sliding += 1,
        }
    }
    assert!(stuck > 5 && sliding > 5);
}

/// Two discs on one axle with a brake between them; a motor on the first.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(a, b),
    speeds(w1, w2),
    kinematics(a = w1, b = w2),
    body(first, rotation = rotation_z(a), mass = 1, inertia = [1, 1, i1]),
    body(second, rotation = rotation_z(b), mass = 1, inertia = [1, 1, i2]),
    input(motor, press),
    drive(a = motor),
    dry_friction(brake, slip = w1 - w2, bound = mu * press),
)]
struct Brake {
    i1: f64,
    i2: f64,
    mu: f64,
}

#[test]
fn a_brake_stops_the_relative_motion_of_two_discs() {
    let (i1, i2, mu, press) = (0.7, 0.3, 0.4, 5.0);
    let kernel = Brake { i1, i2, mu }.kernel().unwrap();
    let (w1, w2, f) = (30.0, -10.0, mu * press);
    let stops = (w1 - w2) / (f * (1.0 / i1 + 1.0 / i2));
    let together = (i1 * w1 + i2 * w2) / (i1 + i2);
    let run = ContactRun::new(&kernel).input(move |_, _: &V<2>, _: &V<2>| V::from([0.0, press])).adaptive(1e-11, 1e-11);
    let run = run.run(V::zeros(), [w1, w2].into(), 0.0..2.0 * stops).unwrap();
    let [event] = run.events() else { panic!("{:?}", run.events()) };
    assert_eq!(event.kind, EventKind::Sticks);
    // Both speeds are lines: roundings of some steps.
    assert!((event.time - stops).abs() < 1e-12 * stops, "{} {stops}", event.time);
    let end = run.last().unwrap();
    assert!(end.z[0] == end.z[1] && (end.z[0] - together).abs() < 1e-12 * w1, "{} {together}", end.z);
    // Locked, the motor turns both; from the torque on that the brake passes on to the second disc it slips.
    let motor = |t: f64, _: &V<2>, _: &V<2>| V::from([t, press]);
    let run =
        ContactRun::new(&kernel).input(motor).adaptive(1e-11, 1e-11).run(V::zeros(), V::zeros(), 0.0..10.0).unwrap();
    let [event] = run.events() else { panic!("{:?}", run.events()) };
    let slips = f * (i1 + i2) / i2;
    assert!(
        event.kind == EventKind::Slides([1.0, 0.0, 0.0]) && (event.time - slips).abs() < 1e-10,
        "{event:?} {slips}"
    );
    assert!((run.forces(5.0).unwrap()[0] + 5.0 * i2 / (i1 + i2)).abs() < 1e-13);
}

/// A free wheel: a dry friction of half the clutch's strength, and a torque of the same size in the direction in which
/// it locks.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(a, b),
    body(inner, rotation = rotation_z(a), mass = 1, inertia = [2, 2, 2]),
    body(outer, rotation = rotation_z(b), mass = 1, inertia = [3, 3, 3]),
    input(motor),
    drive(a = motor),
    dry_friction(clutch, slip = rate(b) - rate(a), bound = strength / 2),
    drive(locks, a = -strength / 2, b = strength / 2),
)]
struct FreeWheel {
    strength: f64,
}

#[test]
fn a_one_way_clutch_drives_and_lets_go() {
    let kernel = FreeWheel { strength: 1e3 }.kernel().unwrap();
    // The motor drives both, then brakes the inner one alone: the outer one runs on.
    let motor = |t: f64, _: &V<2>, _: &V<2>| SVector::<f64, 1>::from([5.0 * (1.0 - t)]);
    let run = ContactRun::new(&kernel).input(motor).adaptive(1e-12, 1e-12);
    let run = run.run(V::zeros(), V::zeros(), 0.0..2.0).unwrap();
    let [event] = run.events() else { panic!("{:?}", run.events()) };
    assert!(matches!(event.kind, EventKind::Slides([1.0, ..])) && (event.time - 1.0).abs() < 1e-10, "{event:?}");
    let end = run.last().unwrap();
    // Together ∫5 (1 − t)/5 dt = ½; then the inner one loses ∫5 (t − 1)/2 dt = 5/4.
    assert!((end.z - V::from([0.5 - 1.25, 0.5])).amax() < 1e-10, "{}", end.z);
    let half = run.at(0.5).unwrap().z;
    assert_eq!(half[0], half[1]);
}

/// A puck on a table with friction of two axes, pulled by a force.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y),
    particle(mass = m, position = [x, y, 0]),
    input(pull_x, pull_y),
    drive(x = pull_x, y = pull_y),
    dry_friction(table, slip = [rate(x), rate(y)], bound = [along, across]),
)]
struct Puck {
    m: f64,
    along: f64,
    across: f64,
}

#[test]
fn a_puck_slides_straight_on_and_stops() {
    let (m, f) = (0.3, 0.6);
    let kernel = Puck { m, along: f, across: f }.kernel().unwrap();
    let free = |_: f64, _: &V<2>, _: &V<2>| V::zeros();
    let run = ContactRun::new(&kernel).input(free).adaptive(1e-10, 1e-10);
    let run = run.run(V::zeros(), [1.2, -1.6].into(), 0.0..3.0).unwrap();
    let [event] = run.events() else { panic!("{:?}", run.events()) };
    // A slip of two tangents ends where its speed is below 1e-10 · 3.
    assert!(event.kind == EventKind::Sticks && (event.time - 2.0 * m / f).abs() < 1e-9, "{event:?}");
    let end = run.last().unwrap();
    let way = m * 4.0 / (2.0 * f);
    assert!((end.q - V::from([0.6 * way, -0.8 * way])).amax() < 1e-9 && end.z.amax() == 0.0, "{} {}", end.q, end.z);
}

#[test]
fn friction_of_two_axes_is_an_ellipse() {
    let (along, across) = (2.0, 1.0);
    let kernel = Puck { m: 1.0, along, across }.kernel().unwrap();
    // Of ẍ/ÿ = (f₁/f₂)² ẋ/ẏ: ẋ is as ẏ to the power of (f₁/f₂)².
    let free = |_: f64, _: &V<2>, _: &V<2>| V::zeros();
    let run = ContactRun::new(&kernel).input(free).adaptive(1e-12, 1e-12);
    let run = run.run(V::zeros(), [3.0, 2.0].into(), 0.0..1.0).unwrap();
    for s in run.iter() {
        let wanted = 3.0 * (s.z[1] / 2.0).powi(4);
        assert!((s.z[0] - wanted).abs() < 1e-10, "{} {wanted}", s.z[0]);
    }
    // A pull that grows at the angle whose cosine is 0.6 moves it where the ellipse ends, along its normal there.
    let pull = |t: f64, _: &V<2>, _: &V<2>| V::from([0.6 * t, 0.8 * t]);
    let run = ContactRun::new(&kernel).input(pull).adaptive(1e-9, 1e-9);
    let run = run.run(V::zeros(), V::zeros(), 0.0..1.5).unwrap();
    let [event] = run.events() else { panic!("{:?}", run.events()) };
    let slides = 1.0 / f64::hypot(0.6 / along, 0.8 / across);
    assert!((event.time - slides).abs() < 1e-9, "{event:?} {slides}");
    let EventKind::Slides([x, y, _]) = event.kind else { panic!("{event:?}") };
    assert!((y / x - (0.8 / 0.6) * (along / across).powi(2)).abs() < 1e-8, "{x} {y}");
    // Nothing would hold it along an axis without friction.
    let wheel = Puck { m: 1.0, along: 0.0, across }.kernel().unwrap();
    let error = ContactRun::new(&wheel).input(free).adaptive(1e-9, 1e-9).run(V::zeros(), V::zeros(), 0.0..1.0);
    assert!(matches!(error.err().unwrap().kind, ContactErrorKind::InvalidFriction { friction: 0.0 }));
}

#[test]
fn a_puck_begins_to_slide_under_a_pull_that_turns() {
    let kernel = Puck { m: 1.0, along: 1.0, across: 1.0 }.kernel().unwrap();
    let pull = |t: f64, _: &V<2>, _: &V<2>| V::from([t * t.cos(), t * t.sin()]);
    let end = |tolerance: f64| {
        let run = ContactRun::new(&kernel).input(pull).adaptive(tolerance, tolerance);
        let run = run.run(V::zeros(), V::zeros(), 0.0..2.5).unwrap();
        let [event] = run.events() else { panic!("{:?}", run.events()) };
        let EventKind::Slides(along) = event.kind else { panic!("{event:?}") };
        // It begins at the pull of 1, in its direction.
        assert!((event.time - 1.0).abs() < 1e-9 && (along[0] - 1.0_f64.cos()).abs() < 1e-9);
        run.last().unwrap().z
    };
    // Slips keep to their first direction up to the tolerance: ∫ f ε/|s| dt is ε times its logarithm.
    let best = end(1e-9);
    for tolerance in [1e-6, 1e-7, 1e-8] {
        let error = (end(tolerance) - best).amax();
        assert!(error < 2.0 * tolerance * -f64::ln(tolerance), "{tolerance} {error}");
    }
}

/// A block on a floor with dry friction, and a wall.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y),
    particle(mass = 1, position = [x, y, 0]),
    dry_friction(floor, slip = [rate(x), rate(y)], bound = f),
    range(x, to = 1, restitution = e),
)]
struct Walled {
    f: f64,
    e: f64,
}

#[test]
fn dry_friction_has_no_part_in_an_impact() {
    let (f, e) = (2.0, 0.5);
    let kernel = Walled { f, e }.kernel().unwrap();
    let run = ContactRun::new(&kernel).adaptive(1e-11, 1e-11).run(V::zeros(), [4.0, 0.0].into(), 0.0..3.0).unwrap();
    let [hit, turns, stop] = run.events() else { panic!("{:?}", run.events()) };
    let EventKind::Impact(hit) = hit.kind else { panic!("{hit:?}") };
    let speed = (16.0 - 2.0 * f).sqrt();
    assert!((hit.before[0] + speed).abs() < 1e-10 && (hit.after[0] - e * speed).abs() < 1e-10, "{hit:?}");
    assert!(matches!(turns.kind, EventKind::Reverses(_)) && stop.kind == EventKind::Sticks);
    let end = run.last().unwrap();
    let back = (e * speed).powi(2) / (2.0 * f);
    assert!((end.q - V::from([1.0 - back, 0.0])).amax() < 1e-9 && end.z.amax() == 0.0, "{}", end.q);
}

/// An arm of four links with dry friction in each joint, in the plane.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(a, b, c, d),
    body(one, rotation = rotation_y(a), mass = m1, center_of_mass = [0, 0, -0.2], inertia_about_center_of_mass = 0.02 * m1),
    body(two, parent = one, position = [0, 0, -0.4], rotation = rotation_y(b), mass = m2,
         center_of_mass = [0, 0, -0.2], inertia_about_center_of_mass = 0.02 * m2),
    body(three, parent = two, position = [0, 0, -0.4], rotation = rotation_y(c), mass = m3,
         center_of_mass = [0, 0, -0.2], inertia_about_center_of_mass = 0.02 * m3),
    body(four, parent = three, position = [0, 0, -0.4], rotation = rotation_y(d), mass = m4,
         center_of_mass = [0, 0, -0.2], inertia_about_center_of_mass = 0.02 * m4),
    dry_friction(a, bound = f1),
    dry_friction(b, bound = f2),
    dry_friction(c, bound = f3),
    dry_friction(d, bound = f4),
)]
struct Arm {
    #[gauss(gravity)]
    g: f64,
    m1: f64,
    m2: f64,
    m3: f64,
    m4: f64,
    f1: f64,
    f2: f64,
    f3: f64,
    f4: f64,
}

/// The x that makes ½ (x − x₀)ᵀ A (x − x₀) + Σ fᵢ|xᵢ| least, a joint that moves with its friction as a force: one
/// component after the other, exactly, until none changes.
fn least(matrix: &SMatrix<f64, 4, 4>, free: &V<4>, bounds: &V<4>, z: &V<4>) -> V<4> {
    let pull = matrix * free;
    let mut x = V::<4>::zeros();
    for _ in 0..20_000 {
        let before = x;
        for i in 0..4 {
            let force = pull[i] - (matrix.row(i) * x)[0] + matrix[(i, i)] * x[i];
            let force = if z[i] == 0.0 {
                force.signum() * (force.abs() - bounds[i]).max(0.0)
            } else {
                force - bounds[i] * z[i].signum()
            };
            x[i] = force / matrix[(i, i)];
        }
        if (x - before).amax() <= f64::EPSILON * x.amax() {
            break;
        }
    }
    x
}

#[test]
fn joints_of_an_arm_at_rest_give_way_as_the_least_constraint_says() {
    let mut number = numbers(11);
    let (mut sticking, mut sliding, mut moving) = (0, 0, 0);
    for n in 0..300 {
        // Masses over a power of ten, bounds over four.
        let masses: V<4> = V::from_fn(|_, _| 10.0_f64.powf(0.5 * number()));
        let bounds: V<4> = V::from_fn(|_, _| 10.0_f64.powf(2.0 * number()));
        let [m1, m2, m3, m4] = masses.into();
        let [f1, f2, f3, f4] = bounds.into();
        let kernel = Arm { g: 9.81, m1, m2, m3, m4, f1, f2, f3, f4 }.kernel().unwrap();
        let q = V::<4>::from_fn(|_, _| 1.5 * number());
        let z = V::<4>::from_fn(|i, _| if n % 3 == 0 && number() > 0.3 { (1.0 + i as f64) * number() } else { 0.0 });
        let (matrix, free) = (kernel.mass_matrix(0.0, &q), kernel.acceleration(0.0, &q, &z, &()));
        let wanted = least(&matrix, &free, &bounds, &z);
        let run = ContactRun::new(&kernel).adaptive(1e-9, 1e-9);
        let run = run.run(q, z, 0.0..1e-9).unwrap_or_else(|error| panic!("{n} {error}"));
        let forces = *run.forces(0.0).unwrap();
        let found = free + matrix.cholesky().unwrap().solve(&forces);
        let size = wanted.amax().max(free.amax());
        for i in 0..4 {
            // Both solve systems with condition numbers of about 10⁵.
            assert!((found[i] - wanted[i]).abs() <= 1e-9 * size, "{n} {i} {found} {wanted}");
            match run.modes(0.0).unwrap()[i] {
                Mode::Sticks => {
                    assert!(z[i] == 0.0 && wanted[i].abs() <= 1e-9 * size && forces[i].abs() <= bounds[i]);
                    sticking += 1;
                }
                Mode::Slides([along, ..]) => {
                    let moves = if z[i] == 0.0 { wanted[i] } else { z[i] };
                    assert!(along == moves.signum() && forces[i] == -along * bounds[i], "{n} {i}");
                    sliding += 1;
                }
                mode => panic!("{mode:?}"),
            }
            moving += usize::from(z[i] != 0.0);
        }
    }
    assert!(sticking > 300 && sliding > 300 && moving > 100, "{sticking} {sliding} {moving}");
}

#[test]
fn an_arm_that_is_let_go_loses_what_its_joints_take() {
    let kernel =
        Arm { g: 9.81, m1: 2.0, m2: 1.0, m3: 0.7, m4: 0.3, f1: 1.8, f2: 1.0, f3: 0.6, f4: 0.2 }.kernel().unwrap();
    let run = ContactRun::new(&kernel).adaptive(1e-10, 1e-10);
    let run = run.run([1.4, 0.9, -0.8, 0.5].into(), V::zeros(), 0.0..40.0).unwrap();
    let end = run.last().unwrap();
    assert!(run.events().len() > 20 && end.z.amax() == 0.0, "{} {:?}", end.z, run.events());
    // Between two events no joint turns round: friction times way.
    let bounds = V::from([1.8, 1.0, 0.6, 0.2]);
    let ways = run.segments().iter().map(|part| part.trajectory().last().q - part.trajectory().first().q);
    let worn: f64 = ways.map(|way: V<4>| way.abs().dot(&bounds)).sum();
    let start = run.segments()[0].trajectory().first();
    let lost = kernel.potential_energy(0.0, &start.q) - kernel.potential_energy(0.0, &end.q);
    // Some thousand steps of errors of 1e-10.
    assert!((worn - lost).abs() < 1e-7, "{worn} {lost}");
    assert_eq!(run.at(39.0).unwrap().q, end.q);
}

/// Two brakes on one shaft.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(a),
    body(shaft, rotation = rotation_z(a), mass = 1, inertia = [1, 1, 1]),
    input(motor),
    drive(a = motor),
    dry_friction(front, slip = rate(a), bound = f),
    dry_friction(rear, slip = -2 * rate(a), bound = g),
)]
struct Shaft {
    f: f64,
    g: f64,
}

#[test]
fn brakes_that_depend_on_one_another_hold_together() {
    let (f, g) = (1.0, 1.5);
    let kernel = Shaft { f, g }.kernel().unwrap();
    let motor = |t: f64, _: &SVector<f64, 1>, _: &SVector<f64, 1>| SVector::from([t]);
    let run = ContactRun::new(&kernel).input(motor).adaptive(1e-11, 1e-11);
    let run = run.run(SVector::zeros(), SVector::zeros(), 0.0..5.0).unwrap();
    // Together they hold f + 2 g; then the shaft turns with t − 4, and t − 4 is all that is left of the motor.
    let end = run.last().unwrap();
    assert!((end.z[0] - 0.5).abs() < 1e-10, "{}", end.z);
    assert_eq!((run.at(3.99).unwrap().z[0], run.at(3.99).unwrap().q[0]), (0.0, 0.0));
}

/// A sledge on a plane, with runners.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, z),
    particle(mass = m, position = [x, y, z]),
    contact(snow, point = [x, y, z], friction = [along, across], along = [1, 0, 0]),
)]
struct Sledge {
    m: f64,
    along: f64,
    across: f64,
    #[gauss(gravity)]
    g: f64,
}

#[test]
fn a_sledge_slides_as_a_puck_with_the_bounds_of_its_weight() {
    let (m, g, along, across) = (2.0, 9.81, 0.1, 0.3);
    let sledge = Sledge { m, along, across, g }.kernel().unwrap();
    let puck = Puck { m, along: along * m * g, across: across * m * g }.kernel().unwrap();
    let whole = ContactRun::new(&sledge).adaptive(1e-10, 1e-10);
    let whole = whole.run(SVector::zeros(), [3.0, 1.0, 0.0].into(), 0.0..4.0).unwrap();
    let free = |_: f64, _: &V<2>, _: &V<2>| V::zeros();
    let flat = ContactRun::new(&puck).input(free).adaptive(1e-10, 1e-10).run(V::zeros(), [3.0, 1.0].into(), 0.0..4.0);
    let flat = flat.unwrap();
    assert_eq!((whole.events().len(), flat.events().len()), (1, 1), "{:?}", whole.events());
    for t in [0.5, 1.5, 4.0] {
        let (a, b) = (whole.at(t).unwrap(), flat.at(t).unwrap());
        // Some fifty steps with errors of 1e-10 of numbers up to 5.
        assert!((a.q.xy() - b.q).amax() < 2.5e-8 && (a.z.xy() - b.z).amax() < 2.5e-8, "{t} {} {}", a.q, b.q);
    }
    assert_eq!((whole.last().unwrap().z.amax(), whole.modes(3.9).unwrap()), (0.0, &[Mode::Sticks][..]));
    // Friction is against (μ₁² s₁, μ₂² s₂), but for slips that count as rest: 1e-10 and 1e-10 of 3, over slips near 1.
    let (s, forces) = (whole.at(0.5).unwrap().z, *whole.forces(0.5).unwrap());
    let off = forces[1] / forces[2] - along * along * s[0] / (across * across * s[1]);
    assert!(off.abs() < 1e-8, "{off:e}");
    let size = f64::hypot(forces[1] / along, forces[2] / across);
    assert!((forces[0] - m * g).abs() < 1e-12 && (size - m * g).abs() < 1e-12, "{forces}");
}
