//! Friction along one tangent: blocks that slide, stop and stick, bodies that begin to roll, Painlevé's rod.

use std::marker::PhantomData;

use gauss_contact::{ContactErrorKind, ContactRun, EventKind, Impact, Mode};
use gauss_runtime::contact::Contact;
use gauss_runtime::nalgebra::SMatrix;
use gauss_runtime::system::GaussSystem;

use crate::common::{Layout, Scene, V, numbers};

const G: f64 = 9.81;

pub struct Ground;
impl Layout for Ground {
    const CONTACTS: &'static [Contact] = &[Contact::new("ground", 0, 1)];
}

/// A block of mass m at (x, h): gap h, slip ẋ.
fn block(m: f64, weight: [f64; 2], mu: f64) -> Scene<Ground, 2, 1, 2> {
    let rows = SMatrix::<f64, 2, 2>::new(0.0, 1.0, 1.0, 0.0);
    Scene::linear(V::repeat(m), V::from(weight), V::zeros(), rows).friction([mu])
}

#[test]
fn a_block_pushed_up_an_incline_stops_and_sticks_or_slides_back() {
    let (m, angle, v) = (3.0, 0.3_f64, 2.0);
    for mu in [0.5, 0.2] {
        let kernel = block(m, [-m * G * angle.sin(), -m * G * angle.cos()], mu);
        let run = ContactRun::new(&kernel).adaptive(1e-10, 1e-10);
        let run = run.run(V::zeros(), [v, 0.0].into(), 0.0..2.0).expect("runs");
        let up = G * (angle.sin() + mu * angle.cos());
        let [stop] = run.events() else { panic!("{:?}", run.events()) };
        // A step of a parabola, with its roundings.
        assert!((stop.time - v / up).abs() < 64.0 * f64::EPSILON);
        let end = run.last().expect("a sample");
        let top = v * v / (2.0 * up);
        if mu > angle.tan() {
            assert_eq!(stop.kind, EventKind::Sticks);
            assert_eq!(end.z, V::<2>::zeros());
            assert!((end.q[0] - top).abs() < 64.0 * f64::EPSILON && end.q[1] == 0.0);
            // It stays to the last bit.
            assert_eq!(run.at(1.0).expect("inside").q, end.q);
            let [normal, friction] = (*run.forces(1.0).expect("inside")).into();
            assert!((normal - m * G * angle.cos()).abs() < 1e-13 && (friction - m * G * angle.sin()).abs() < 1e-13);
        } else {
            assert!(matches!(stop.kind, EventKind::Reverses([-1.0, ..])), "{stop:?}");
            let (down, t) = (G * (angle.sin() - mu * angle.cos()), 2.0 - v / up);
            assert!((end.q[0] - (top - 0.5 * down * t * t)).abs() < 1e-13, "{}", end.q);
        }
    }
}

#[test]
fn an_oscillator_with_dry_friction_rests_where_its_spring_cannot_move_it() {
    let kernel = block(1.0, [0.0, -1.0], 1.0).force(|_, q, _| V::from([-q[0], -1.0]));
    let run = ContactRun::new(&kernel).adaptive(1e-12, 1e-12);
    let run = run.run([12.0, 0.0].into(), [6.0, 0.0].into(), 0.0..30.0).expect("runs");
    let kinds: Vec<_> = run.events().iter().map(|event| event.kind).collect();
    // About the centres ∓1 by turns: √205 → turns at −1 + √205, then 2 less each time.
    assert!(matches!(kinds.last(), Some(EventKind::Sticks)), "{kinds:?}");
    assert_eq!(kinds.len(), 8);
    let end = run.last().expect("a sample");
    // Eight parts, of 30 steps at most, each of local errors of 1e-12 · 14.
    assert!((end.q[0] - (15.0 - 205.0_f64.sqrt())).abs() < 8.0 * 30.0 * 14e-12, "{}", end.q[0]);
    assert_eq!(end.z, V::<2>::zeros());
}

#[test]
fn a_block_begins_to_slide_where_friction_reaches_its_bound() {
    // Pushed by t: from μ m g on. Then x = (t − t₀)³/6.
    let kernel = block(1.0, [0.0, -1.0], 0.5).force(|t, _, _| V::from([t, -1.0]));
    let run = ContactRun::new(&kernel).adaptive(1e-12, 1e-12).run(V::zeros(), V::zeros(), 0.0..1.5).expect("runs");
    let [slides] = run.events() else { panic!("{:?}", run.events()) };
    assert_eq!(slides.kind, EventKind::Slides([1.0, 0.0, 0.0]));
    assert!((slides.time - 0.5).abs() < 1e-12);
    let end = run.last().expect("a sample");
    assert!((end.q[0] - 1.0 / 6.0).abs() < 1e-10 && (end.z[0] - 0.5).abs() < 1e-10, "{} {}", end.q, end.z);
    assert_eq!(run.modes(0.2).expect("inside"), [Mode::Sticks]);
}

#[test]
fn a_thrown_block_keeps_to_coulombs_law_in_its_impact() {
    // It falls at 2 and slides at 6: the impulse takes μ (1 + e) 2 of the slip.
    for (law, e, wanted) in [
        (Impact::Newton, 0.0, [6.0 - 0.3 * 2.0, 0.0]),
        (Impact::Newton, 0.5, [6.0 - 0.3 * 3.0, 1.0]),
        (Impact::Moreau, 0.5, [6.0 - 0.3 * 3.0, 1.0]),
    ] {
        let kernel = block(1.0, [0.0, 0.0], 0.3).restitution([e]);
        let run = ContactRun::new(&kernel).adaptive(1e-10, 1e-10).law(law);
        let run = run.run([0.0, 1.0].into(), [6.0, -2.0].into(), 0.0..0.6).expect("runs");
        let end = run.last().expect("a sample");
        assert!((end.z - V::<2>::from(wanted)).amax() < 32.0 * f64::EPSILON, "{law:?} {e} {}", end.z);
    }
}

struct Fingers;
impl Layout for Fingers {
    const CONTACTS: &'static [Contact] = &[Contact::new("left", 0, 1), Contact::new("right", 2, 1)];
}

#[test]
fn what_two_fingers_hold_does_not_creep() {
    // Fingers along x at 0 and 3, a block at (1, y) with its weight along y: 20 times the force that is needed.
    let rows = SMatrix::<f64, 4, 4>::from_row_slice(&[
        -1., 0., 1., 0., //
        0., 0., 0., 1., //
        0., 1., -1., 0., //
        0., 0., 0., 1.,
    ]);
    let (m, mu) = (0.7, 0.4);
    let grip = 20.0 * m * G / (2.0 * mu);
    let weight = V::from([grip, -grip, 0.0, -m * G]);
    let kernel: Scene<Fingers, 4, 2, 4> =
        Scene::linear([0.1, 0.1, m, m].into(), weight, V::from([-1.0, -2.0]), rows).friction([mu; 2]);
    let start = V::from([0.0, 3.0, 1.0, 0.3]);
    let run = ContactRun::new(&kernel).adaptive(1e-10, 1e-10).run(start, V::zeros(), 0.0..100.0).expect("holds");
    assert!(run.events().is_empty());
    let end = run.last().expect("a sample");
    assert_eq!((end.q, end.z), (start, V::<4>::zeros()));
    let forces = *run.forces(50.0).expect("inside");
    assert!((forces - V::<4>::from([grip, 0.5 * m * G, grip, 0.5 * m * G])).amax() < 256.0 * f64::EPSILON * grip);
}

/// A rod of mass m and half length s in its plane, (x, y, θ): its lower end at (s cos θ, −s sin θ) from the centre.
pub fn rod(mu: f64) -> Scene<Ground, 3, 1, 2> {
    let (m, s) = (1.0, 1.0);
    Scene {
        mass: [m, m, m * s * s / 3.0].into(),
        force: Box::new(move |_, _, _| V::from([0.0, -m * G, 0.0])),
        potential: Box::new(move |q| m * G * q[1]),
        gaps: Box::new(move |q| V::from([q[1] - s * q[2].sin()])),
        rows: Box::new(move |q| SMatrix::<f64, 2, 3>::new(0.0, 1.0, -s * q[2].cos(), 1.0, 0.0, -s * q[2].sin())),
        gamma: Box::new(move |q, z| V::from([s * q[2].sin(), -s * q[2].cos()]) * (z[2] * z[2])),
        friction: V::from([mu]),
        restitution: V::zeros(),
        layout: PhantomData,
    }
}

#[test]
fn painleves_rod_has_a_paradox_from_four_thirds_on() {
    for (mu, paradox) in [(1.33, false), (1.337, true)] {
        let kernel = rod(mu);
        let mut seen = 0;
        for n in 1..300 {
            let angle = n as f64 * 0.005;
            // Its end slides towards the side on which the rod leans.
            let run = ContactRun::new(&kernel).adaptive(1e-8, 1e-8);
            let (_, error) = run.attempt([0.0, angle.sin(), angle].into(), [3.0, 0.0, 0.0].into(), 0.0..1e-3);
            match error.map(|error| (error.contact, error.time, error.kind)) {
                None => {}
                // At once, or where the motion leads there.
                Some((Some("ground"), time, ContactErrorKind::Inconsistent)) => seen += usize::from(time == 0.0),
                Some(other) => panic!("{mu} {angle} {other:?}"),
            }
        }
        // p = 1 + 3 cos θ (cos θ − μ sin θ) < 0 about θ = arctan 2.
        assert_eq!(seen > 0, paradox, "{mu}: {seen}");
    }
}

/// An arm of a body at this angle.
fn turned([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sine, cosine) = angle.sin_cos();
    [cosine * x - sine * y, sine * x + cosine * y]
}

/// A rectangle of sides 2 a, 2 b and mass 1 in its plane, (x, y, θ) of its centre, on its two lower corners.
fn rectangle(mu: f64, [a, b]: [f64; 2]) -> Scene<Corners, 3, 2, 4> {
    let corners = [[-a, -b], [a, -b]];
    Scene {
        mass: [1.0, 1.0, (a * a + b * b) / 3.0].into(),
        force: Box::new(|_, _, _| V::from([0.0, -G, 0.0])),
        potential: Box::new(|q| G * q[1]),
        gaps: Box::new(move |q| V::from(corners.map(|corner| q[1] + turned(corner, q[2])[1]))),
        rows: Box::new(move |q| {
            let [[a, b], [c, d]] = corners.map(|corner| turned(corner, q[2]));
            SMatrix::<f64, 4, 3>::from_row_slice(&[0., 1., a, 1., 0., -b, 0., 1., c, 1., 0., -d])
        }),
        gamma: Box::new(move |q, z| {
            let [[a, b], [c, d]] = corners.map(|corner| turned(corner, q[2]));
            V::from([-b, -a, -d, -c]) * (z[2] * z[2])
        }),
        friction: V::from([mu; 2]),
        restitution: V::zeros(),
        layout: PhantomData,
    }
}

pub fn square(mu: f64, a: f64) -> Scene<Corners, 3, 2, 4> {
    rectangle(mu, [a, a])
}

pub struct Corners;
impl Layout for Corners {
    const CONTACTS: &'static [Contact] = &[Contact::new("left", 0, 1), Contact::new("right", 2, 1)];
}

#[test]
fn housners_block_loses_at_each_impact_what_its_angle_says() {
    // Height 1, width ¼; friction enough for no slip, and not so much that one corner alone could jam.
    let corner = [-0.125, -0.5];
    let kernel = rectangle(0.3, [0.125, 0.5]);
    let alpha = 0.25_f64.atan();
    let start = 0.5 * alpha;
    let [x, y] = turned(corner, start);
    let run = ContactRun::new(&kernel).adaptive(1e-12, 1e-12);
    let run = run.run([-x, -y, start].into(), V::zeros(), 0.0..0.72).expect("runs");
    let impact = run.events().iter().find(|event| matches!(event.kind, EventKind::Impact(_))).expect("an impact");
    // The quarter period, from contact.md's closed form; ten digits are given.
    assert!((impact.time - 0.349_171_602).abs() < 1e-9, "{}", impact.time);
    let segment = run.segments().iter().find(|segment| segment.trajectory().first().t >= impact.time).expect("goes on");
    let before = run.segments().iter().rev().find(|s| s.trajectory().last().t <= impact.time).expect("was there");
    let (before, after) = (before.trajectory().last().z[2], segment.trajectory().first().z[2]);
    assert!((before.abs() - 0.799_094_049_28).abs() < 1e-10, "{before}");
    assert!((after / before - 0.911_764_705_882).abs() < 1e-11, "{}", after / before);
    // The next amplitude, where it turns.
    let least = run.iter().map(|state| state.q[2]).fold(0.0, f64::min);
    let turn = run.iter().zip(run.iter().skip(1)).find(|(a, b)| a.t > impact.time && a.z[2] < 0.0 && b.z[2] >= 0.0);
    let (mut a, mut b) = turn.map(|(a, b)| (a.t, b.t)).expect("turns");
    for _ in 0..60 {
        let middle = 0.5 * (a + b);
        if run.at(middle).expect("inside").z[2] < 0.0 { a = middle } else { b = middle }
    }
    let turned = run.at(a).expect("inside").q[2];
    assert!((turned + 0.094_736_793_1).abs() < 1e-9, "{turned} {least}");
    // Energy falls at impacts alone.
    let energies: Vec<f64> = run.iter().map(|s| kernel.energy(s.t, &s.q, &s.z)).collect();
    assert!(energies.windows(2).all(|pair| pair[1] <= pair[0] + 1e-10));
}

#[test]
fn a_block_that_is_dropped_sliding_bounces_to_rest_and_stops() {
    // All impulses of the floor have the same friction: from the first impact on, slip falls by μ times the momentum
    // that bounces and weight have passed on.
    let (e, mu, v) = (0.5, 0.3, 8.0);
    let kernel = block(2.0, [0.0, -2.0 * G], mu).restitution([e]);
    let run = ContactRun::new(&kernel).adaptive(1e-10, 1e-10);
    let run = run.run([0.0, 1.0].into(), [v, 0.0].into(), 0.0..5.0).expect("runs");
    let fall = (2.0 / G).sqrt();
    let rest = run.events().iter().find(|event| matches!(event.kind, EventKind::Rests { .. })).expect("rests");
    let EventKind::Rests { remaining, .. } = rest.kind else { panic!("{rest:?}") };
    assert!((rest.time + remaining - 3.0 * fall).abs() < 1e-12);
    // Vertical momentum is 0 before and after: the floor has given m g t up to t. What is left out of the bounces is
    // accounted for; each of 21 segments has some roundings.
    let state = run.at(2.0).expect("inside");
    assert!((state.z[0] - (v - mu * G * 2.0)).abs() < 21.0 * 16.0 * f64::EPSILON * v, "{}", state.z);
    let stop = run.events().last().expect("stops");
    assert_eq!(stop.kind, EventKind::Sticks);
    assert!((stop.time - v / (mu * G)).abs() < 1e-12, "{}", stop.time);
    assert_eq!(run.last().expect("a sample").z, V::<2>::zeros());
}

#[test]
fn a_square_thrown_flat_along_a_plate_never_leaves_it() {
    let (mu, a, v) = (0.5, 0.1, 6.0);
    let kernel = square(mu, a);
    let run = ContactRun::new(&kernel).adaptive(1e-10, 1e-10);
    let run = run.run([0.0, a, 0.0].into(), [v, 0.0, 0.0].into(), 0.0..2.0).expect("runs");
    assert!(run.iter().all(|state| (state.q[1] - a).abs() < 1e-15 && state.q[2].abs() < 1e-15));
    let end = run.last().expect("a sample");
    assert_eq!(end.z, V::<3>::zeros());
    assert!((end.q[0] - v * v / (2.0 * mu * G)).abs() < 1e-13, "{}", end.q);
    // The corner in front has more of the weight: by the torque of friction, μ m g a.
    let [rear, _, front, _] = (*run.forces(0.5).expect("inside")).into();
    assert!((front - 0.5 * G * (1.0 + mu)).abs() < 1e-13 && (rear - 0.5 * G * (1.0 - mu)).abs() < 1e-13);
}

#[test]
fn newtons_law_with_friction_is_refused_where_it_creates_energy_and_moreaus_is_not() {
    // A rod that strikes with its lower end, without slip as it would leave (T. R. Kane's paradox).
    let (mut refused, mut made) = (0, 0);
    for n in 0..40 {
        let angle = 0.2 + 0.03 * n as f64;
        let kernel = Scene { restitution: V::from([0.9]), ..rod(0.6) };
        let start = V::from([0.0, angle.sin(), angle]);
        for spin in [-4.0, -1.0, 2.0] {
            let speeds = V::from([0.4, -1.0, spin]);
            let run = |law| ContactRun::new(&kernel).adaptive(1e-9, 1e-9).law(law).attempt(start, speeds, 0.0..1e-6);
            let (_, error) = run(Impact::Newton);
            match error.map(|error| error.kind) {
                None => made += 1,
                Some(ContactErrorKind::EnergyGrows { law: Impact::Newton, before, after }) => {
                    assert!(after > before);
                    refused += 1;
                }
                Some(other) => panic!("{angle} {spin} {other}"),
            }
            let (_, error) = run(Impact::Moreau);
            assert!(error.is_none(), "{angle} {spin} {error:?}");
        }
    }
    assert!(refused > 0 && made > refused, "{refused} {made}");
}

#[test]
fn a_square_that_is_pushed_below_its_friction_sticks_on_both_corners() {
    // Friction of least norm is the same at both, within the bound of the rear one, μ 0.4 m g.
    let kernel = square(0.5, 0.1).force(|_, _, _| V::from([0.2 * G, -G, 0.0]));
    let run = ContactRun::new(&kernel).adaptive(1e-10, 1e-10);
    let run = run.run([0.0, 0.1, 0.0].into(), V::zeros(), 0.0..1.0).expect("stands");
    assert_eq!(run.modes(0.5).expect("inside"), [Mode::Sticks; 2]);
    let end = run.last().expect("a sample");
    assert!(run.events().is_empty() && end.z == V::<3>::zeros() && end.q[0] == 0.0, "{}", end.q);
    let [rear, a, front, b] = (*run.forces(0.5).expect("inside")).into();
    assert!((rear + front - G).abs() < 1e-13 && (a + 0.1 * G).abs() < 1e-13 && (b + 0.1 * G).abs() < 1e-13);
}

#[test]
fn both_corners_of_a_square_are_lifted_at_once() {
    let (mass, a) = (1.0, 0.1);
    let kernel = square(0.5, a).force(move |t, _, _| V::from([0.0, -mass * t.cos(), 0.0]));
    let run = ContactRun::new(&kernel).adaptive(1e-12, 1e-12);
    let run = run.run([0.0, a, 0.0].into(), V::zeros(), 0.0..2.5).expect("runs");
    let quarter = std::f64::consts::FRAC_PI_2;
    let leaves: Vec<f64> =
        run.events().iter().filter(|event| event.kind == EventKind::Leaves).map(|event| event.time).collect();
    assert!(leaves.len() >= 2 && leaves.iter().all(|t| (t - quarter).abs() < 1e-9), "{:?}", run.events());
    let end = run.last().expect("a sample");
    assert!((end.q[1] - a - (2.5_f64.cos() + 2.5 - quarter)).abs() < 1e-9 && end.q[2].abs() < 1e-9, "{}", end.q);
}

#[test]
fn a_block_on_a_table_takes_the_blow_of_a_ball_without_a_move() {
    // Heights of the ball and of the block, and the block's place along the table.
    let rows = SMatrix::<f64, 4, 3>::from_row_slice(&[1., -1., 0., 0., 0., -1., 0., 1., 0., 0., 0., 1.]);
    let masses = [0.7, 0.3, 0.3];
    for e in [0.0, 0.5, 1.0] {
        let weight = V::from([-masses[0] * G, -masses[1] * G, 0.0]);
        let kernel: Scene<Corners, 3, 2, 4> =
            Scene::linear(masses.into(), weight, V::from([-0.1, 0.0]), rows).friction([0.3; 2]).restitution([e; 2]);
        let run = ContactRun::new(&kernel).adaptive(1e-10, 1e-10);
        let run = run.run([0.4, 0.0, 0.0].into(), V::zeros(), 0.0..0.3).expect("runs");
        let end = run.last().expect("a sample");
        assert_eq!((end.q[1], end.q[2], end.z[1], end.z[2]), (0.0, 0.0, 0.0, 0.0), "{e}");
        assert!(run.events().iter().all(|event| event.contact == 0 || matches!(event.kind, EventKind::Impact(_))));
        let EventKind::Impact(hit) = run.events()[0].kind else { panic!("{:?}", run.events()) };
        let speed = (2.0 * G * 0.3).sqrt();
        assert!((hit.impulse[0] - masses[0] * (1.0 + e) * speed).abs() < 64.0 * f64::EPSILON * speed);
    }
}

#[test]
fn squares_that_are_tossed_come_to_rest() {
    let mut number = numbers(3);
    for n in 0..24 {
        let e = [0.0, 0.3, 0.7][n % 3];
        let kernel = Scene { restitution: V::from([e; 2]), ..square(0.25 + 0.25 * number(), 0.1) };
        let start = V::from([0.0, 0.4, 0.7 * number()]);
        let speeds = V::from([2.0 * number(), number(), 5.0 * number()]);
        let run = ContactRun::new(&kernel).adaptive(1e-9, 1e-9).law(Impact::Moreau);
        let run = run.run(start, speeds, 0.0..3.0).unwrap_or_else(|error| panic!("{n} {error}"));
        let energies: Vec<f64> = run.iter().map(|s| kernel.energy(s.t, &s.q, &s.z)).collect();
        // Steps have errors of 1e-9 of their terms, at energies of about 5.
        assert!(energies.windows(2).all(|pair| pair[1] <= pair[0] + 5e-9), "{n}");
        // Gaps end within the resolution of the time, 16 ε 3 s, at speeds of about 5, or are closed to rounding.
        let gaps = run.iter().flat_map(|s| <[f64; 2]>::from((kernel.gaps)(&s.q)));
        assert!(gaps.fold(0.0, f64::min) > -16.0 * f64::EPSILON * 3.0 * 5.0, "{n}");
        // In the end it is on both corners, to the last bit at rest.
        let end = run.last().expect("a sample");
        assert_eq!(end.z, V::<3>::zeros(), "{n}");
        assert_eq!(run.modes(3.0).expect("inside"), [Mode::Sticks; 2], "{n}");
        assert!(run.solves().iter().flat_map(|solve| &solve.residuals).all(|(_, r)| r.coulomb <= r.rounding));
    }
}

#[test]
fn a_block_on_a_belt_sticks_and_slips() {
    // Mass, stiffness and bound of friction 1; a belt so heavy that its speed ½ stays. From rest: x = 1 − cos t to
    // ẋ = ½, then with the belt to x = 1, then x = 1 + ½ sin.
    let rows = SMatrix::<f64, 2, 3>::from_row_slice(&[0., 1., 0., 1., 0., -1.]);
    let mass = V::from([1.0, 1.0, 1e18]);
    let kernel: Scene<Ground, 3, 1, 2> = Scene::linear(mass, V::zeros(), V::zeros(), rows).friction([1.0]);
    let kernel = kernel.force(|_, q, _| V::from([-q[0], -1.0, 0.0]));
    let run = ContactRun::new(&kernel).adaptive(1e-12, 1e-12);
    let run = run.run(V::zeros(), [0.0, 0.0, 0.5].into(), 0.0..5.0).expect("runs");
    let [sticks, slides] = run.events() else { panic!("{:?}", run.events()) };
    let first = std::f64::consts::FRAC_PI_6;
    let second = first + 2.0 * first.cos();
    // Some ten steps of errors of 1e-12; the force at the second one changes by ½ per unit of time.
    assert!(sticks.kind == EventKind::Sticks && (sticks.time - first).abs() < 1e-11, "{sticks:?}");
    assert!(slides.kind == EventKind::Slides([-1.0, 0.0, 0.0]) && (slides.time - second).abs() < 1e-10, "{slides:?}");
    let on = run.at(0.5 * (first + second)).expect("inside");
    assert_eq!(on.z[0], on.z[2]);
    let end = run.last().expect("a sample");
    assert!((end.q[0] - (1.0 + 0.5 * (5.0 - second).sin())).abs() < 1e-10, "{}", end.q);
}
