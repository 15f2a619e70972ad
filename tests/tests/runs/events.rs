//! Events and jumps of the state at them, against closed forms.

use std::f64::consts::{PI, TAU};

use gauss_batch::{Batch, States};
use gauss_runtime::integrate::Fixed;
use gauss_runtime::prelude::*;
use gauss_tests::watchdog::within;

/// A particle above a floor.
#[derive(GaussDynamics)]
#[gauss(taylor, coordinates(height), particle(mass = 1, position = [0, 0, height]))]
struct Ball {
    #[gauss(gravity)]
    g: f64,
}

/// x = sin t from (0, 1).
#[derive(GaussDynamics)]
#[gauss(taylor, coordinates(x), particle(mass = 1, position = [x, 0, 0]), spring(along = x, stiffness = k, damping = 0))]
struct Spring {
    k: f64,
}

/// A point on a ring, as a constraint.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y),
    particle(mass = 1, position = [x, y, 0]),
    constraint(position = x * x + y * y - 1),
)]
struct Ring {
    #[gauss(gravity)]
    g: f64,
}

/// A body with its velocity in its own axes, or in those of the observer.
macro_rules! body {
    ($name:ident, $chart:ident) => {
        #[derive(GaussDynamics)]
        #[gauss(motion = free, chart = $chart, taylor)]
        struct $name<T> {
            #[gauss(mass)]
            mass: T,
            #[gauss(inertia)]
            inertia: Vector3<T>,
            #[gauss(gravity)]
            g: T,
        }

        impl $name<f64> {
            fn thrown() -> Self {
                Self { mass: 2.0, inertia: Vector3::new(0.3, 0.4, 0.5), g: G }
            }
        }
    };
}
body!(InItsAxes, left_invariant);
body!(InSpace, hybrid);

type One = SVector<f64, 1>;

fn one(x: f64) -> One {
    One::from([x])
}

const G: f64 = 9.81;

fn ball() -> BallKernel {
    Ball { g: G }.kernel().expect("a ball")
}

fn spring() -> SpringKernel {
    Spring { k: 1.0 }.kernel().expect("a spring")
}

fn floor(_: f64, q: &One, _: &One) -> f64 {
    q[0]
}

/// Times of the impacts of a ball that falls from 1 m and keeps a part of its speed.
fn impacts(kept: f64) -> impl Iterator<Item = f64> {
    let fall = (2.0 / G).sqrt();
    (0..).scan((fall, 2.0 * fall), move |(t, flight), _| {
        let now = *t;
        *flight *= kept;
        *t += *flight;
        Some(now)
    })
}

#[test]
fn a_ball_bounces_by_every_method() {
    let kernel = ball();
    let run = Simulation::new(&kernel).event(Crossing::Falling, floor).then(|state| state.z[0] *= -0.7);
    let (q, z) = (one(1.0), one(0.0));
    for path in [
        run.adaptive(1e-10, 1e-10).run(q, z, 0.0..2.3).expect("runs"),
        run.momentum_form().adaptive(1e-10, 1e-10).run(q, z, 0.0..2.3).expect("runs"),
        run.fixed_step(0.01).run(q, z, 0.0..2.3).expect("runs"),
        // One step would do for the whole flight, and for several.
        run.fixed_step(1.0).run(q, z, 0.0..2.3).expect("runs"),
        run.control(Fixed::by(Collocation::order_4(), 0.1)).run(q, z, 0.0..2.3).expect("runs"),
        run.taylor(1e-12, 1e-12).run(q, z, 0.0..2.3).expect("runs"),
        run.adaptive(1e-10, 1e-10).every(7).run(q, z, 0.0..2.3).expect("runs"),
    ] {
        let found: Vec<f64> = path.events_of(0).map(|state| state.t).collect();
        let expected: Vec<f64> = impacts(0.7).take_while(|t| *t < 2.3).collect();
        assert_eq!(found.len(), expected.len(), "{found:?} {expected:?}");
        for (a, b) in found.iter().zip(&expected) {
            // Bounded by tolerances of 1e-10 and a rounding of times in each step.
            assert!((a - b).abs() < 1e-9, "{found:?} {expected:?}");
        }
        assert_eq!((path.summary().jumps, path.stopped_by(), path.last().t), (found.len() as u64, None, 2.3));
        // Two samples at each impact: before and after.
        let pairs: Vec<_> = path.samples().windows(2).filter(|pair| pair[0].t == pair[1].t).collect();
        assert_eq!(pairs.len(), found.len());
        for pair in pairs {
            assert!(pair[1].z[0] == -0.7 * pair[0].z[0] && pair[1].p == pair[1].z && pair[0].q == pair[1].q);
        }
        // Between them too: at an impact the state after it, never below the floor, of the energy of the flight.
        let mut before = f64::INFINITY;
        for n in 0..=230 {
            let state = path.at((0.01 * f64::from(n)).min(2.3)).expect("inside");
            let energy = kernel.energy(state.t, &state.q, &state.z);
            assert!(state.q[0] > -1e-12 && energy < before + 1e-9, "{state:?}");
            before = energy;
        }
        assert!(path.at(found[0]).expect("inside").z[0] > 0.0);
    }
}

#[test]
fn infinitely_many_bounces_end_with_a_reason_where_they_pile_up() {
    let error = within(60, "a ball that comes to rest", || {
        let kernel = ball();
        let run = Simulation::new(&kernel).event(Crossing::Falling, floor).then(|state| state.z[0] *= -0.5);
        let (path, error) = run.adaptive(1e-9, 1e-9).attempt(one(1.0), one(0.0), 0.0..10.0);
        // The sum of all flights.
        let rests = (2.0 / G).sqrt() * (1.0 + 2.0 * 0.5 / (1.0 - 0.5));
        assert!((path.last().t - rests).abs() < 1e-8 && path.last().q[0].abs() < 1e-12, "{:?}", path.last());
        assert!(path.events().len() > 30 && path.events().len() < 100, "{}", path.events().len());
        // The remedy: to end before.
        let run = run.until(Crossing::Falling, |_, q: &One, z: &One| 0.5 * z[0] * z[0] + G * q[0] - 1e-6);
        let end = run.adaptive(1e-9, 1e-9).run_to_end(one(1.0), one(0.0), 0.0..10.0).expect("ends");
        // ½v² = 1e-6 after an impact, and not before it.
        let speed = end.z[0] / 1e-6_f64.sqrt();
        assert!(end.stopped_by == Some(1) && end.t < rests && (0.5..1.5).contains(&speed), "{end:?}");
        error.expect("never reaches 10 s")
    });
    assert!(matches!(error.kind, IntegrationErrorKind::Zeno { event: 0, .. }), "{error}");
    assert!(error.to_string().contains("end the run with `until` before"), "{error}");
}

#[test]
fn a_jump_that_does_not_lead_away_is_told() {
    within(60, "a ball that sticks", || {
        let kernel = ball();
        let run = Simulation::new(&kernel).event(Crossing::Falling, floor);
        let sticks = run.then(|state| state.z[0] = 0.0);
        for error in [
            sticks.adaptive(1e-9, 1e-9).attempt(one(1.0), one(0.0), 0.0..10.0).1,
            sticks.fixed_step(0.01).attempt(one(1.0), one(0.0), 0.0..10.0).1,
        ] {
            let error = error.expect("does not reach the end");
            assert!(matches!(error.kind, IntegrationErrorKind::Zeno { event: 0, .. }), "{error}");
            assert!((error.time - (2.0 / G).sqrt()).abs() < 1e-8, "{error}");
        }
        // What goes on through zero is told too, where it is not said to be a gate that brakes.
        let brakes = |state: &mut Sample<BallKernel>| state.z[0] *= 0.5;
        let error = run.then(brakes).adaptive(1e-10, 1e-10).run(one(1.0), one(0.0), 0.0..1.0).expect_err("goes on");
        assert!(matches!(error.kind, IntegrationErrorKind::NotTurnedBack { event: 0, .. }), "{error}");
        let gate = run.then_through(brakes).adaptive(1e-10, 1e-10).run(one(1.0), one(0.0), 0.0..1.0);
        let path = gate.expect("runs");
        let (fall, left) = ((2.0 / G).sqrt(), 1.0 - (2.0 / G).sqrt());
        let below = -0.5 * G * fall * left - 0.5 * G * left * left;
        assert!(path.events().len() == 1 && (path.last().q[0] - below).abs() < 1e-9, "{:?}", path.last());
    });
}

#[test]
fn where_a_run_ended_and_by_what() {
    let kernel = spring();
    let run = Simulation::new(&kernel)
        .event(Crossing::Falling, |_, _, z: &One| z[0])
        .until(Crossing::Falling, |_, q: &One, _| q[0])
        .adaptive(1e-11, 1e-11);
    let short = run.run(one(0.0), one(1.0), 0.0..1.0).expect("runs");
    assert_eq!((short.stopped_by(), short.events().len(), short.last().t), (None, 0, 1.0));
    let long = run.run(one(0.0), one(1.0), 0.0..10.0).expect("runs");
    assert_eq!((long.stopped_by(), long.events().len()), (Some(1), 2));
    assert!((long.last().t - PI).abs() < 1e-9);
    let end = run.run_to_end(one(0.0), one(1.0), 0.0..10.0).expect("runs");
    assert_eq!((end.stopped_by, end.t, end.q, end.z), (Some(1), long.last().t, long.last().q, long.last().z));
    assert_eq!(end.summary, *long.summary());
    // The state that it ends with is the one after the jump, where there is one.
    let latch = Simulation::new(&kernel).until(Crossing::Falling, |_, _, z: &One| z[0]).then(|state| state.q[0] = 2.0);
    let path = latch.adaptive(1e-11, 1e-11).run(one(0.0), one(1.0), 0.0..10.0).expect("runs");
    assert_eq!((path.stopped_by(), path.last().q[0], path.summary().jumps), (Some(0), 2.0, 1));
    assert!((path.events()[0].sample.q[0] - 1.0).abs() < 1e-9);
    let end = latch.adaptive(1e-11, 1e-11).run_to_end(one(0.0), one(1.0), 0.0..10.0).expect("runs");
    assert_eq!((end.stopped_by, end.q[0]), (Some(0), 2.0));
}

#[test]
fn a_latch_holds_and_a_run_is_handed_over_to_another_kernel() {
    // At its turning point a mass loads a second spring: another kernel goes on from there.
    let (soft, stiff) = (spring(), Spring { k: 4.0 }.kernel().expect("a spring"));
    let turn = |_: f64, _: &One, z: &One| z[0];
    let there = Simulation::new(&soft).until(Crossing::Falling, turn).taylor(1e-14, 1e-14);
    let turned = there.run_to_end(one(0.0), one(1.0), 0.0..10.0).expect("turns");
    assert_eq!(turned.stopped_by, Some(0));
    let back = Simulation::new(&stiff).until(Crossing::Falling, |_, q: &One, _| q[0]).taylor(1e-14, 1e-14);
    let end = back.run_to_end(turned.q, turned.z, turned.t..20.0).expect("comes back");
    // A quarter of one period, then a quarter of the other; it comes back with twice the speed.
    assert!((end.t - 0.25 * TAU - 0.125 * TAU).abs() < 1e-12 && (end.z[0] + 2.0).abs() < 1e-12, "{end:?}");
}

#[test]
fn a_zero_at_the_start_is_none_and_the_next_one_is() {
    let kernel = spring();
    for crossing in [Crossing::Any, Crossing::Rising, Crossing::Falling] {
        let run = Simulation::new(&kernel).event(crossing, |_, q: &One, _| q[0]).adaptive(1e-11, 1e-11);
        // It leaves zero upwards, or downwards.
        for (speed, expected) in [(1.0, [PI, 2.0 * PI]), (-1.0, [PI, 2.0 * PI])] {
            let found: Vec<f64> =
                run.run(one(0.0), one(speed), 0.0..7.0).expect("runs").events_of(0).map(|s| s.t).collect();
            let first_falls = speed > 0.0;
            let wanted: Vec<f64> = match crossing {
                Crossing::Any => expected.to_vec(),
                Crossing::Falling => vec![if first_falls { PI } else { 2.0 * PI }],
                Crossing::Rising => vec![if first_falls { 2.0 * PI } else { PI }],
            };
            assert_eq!(found.len(), wanted.len(), "{crossing:?} {found:?}");
            assert!(found.iter().zip(&wanted).all(|(a, b)| (a - b).abs() < 1e-9), "{crossing:?} {found:?}");
        }
    }
}

#[test]
fn touches_poles_and_what_is_faster_than_steps() {
    let kernel = spring();
    let run = Simulation::new(&kernel);
    let count = |function: fn(f64, &One, &One) -> f64| {
        let steps = run.event(Crossing::Any, function).fixed_step(0.3).run(one(0.0), one(1.0), 0.0..6.0).expect("runs");
        let series = run.event(Crossing::Any, function).taylor(1e-12, 1e-12);
        let series = series.run(one(0.0), one(1.0), 0.0..6.0).expect("runs");
        let of = |path: &Trajectory<'_, SpringKernel>| path.events().len();
        (of(&steps), of(&series))
    };
    // A touch from below is none, a little more is two, whatever the steps: sin t = 1 at π/2.
    assert_eq!(count(|_, q, _| q[0] - 1.000_001), (0, 0));
    assert_eq!(count(|_, q, _| q[0] - 0.999_999), (2, 2));
    assert_eq!(count(|_, q, _| q[0] - 0.999_999_999), (2, 2));
    // Twice in a tenth of a second, and four times in a step.
    assert_eq!(count(|t, _, _| (t - 1.51) * (t - 1.61)), (2, 2));
    // Poles: the tangent has two within 6, and the zero between them.
    assert_eq!(count(|t, _, _| (t - 0.1).tan()).0, 2);
    assert_eq!(count(|_, q, _| 1.0 / q[0]), (0, 0));
    // A jump over zero is one.
    assert_eq!(count(|t, _, _| if t < 2.345 { -1.0 } else { 1.0 }), (1, 1));
    // Zero for a while is none when it is left to the same side.
    assert_eq!(count(|_, q, _| q[0].max(0.0)), (1, 1));
}

#[test]
fn several_events_at_one_time() {
    let kernel = ball();
    let run = Simulation::new(&kernel)
        .event(Crossing::Falling, floor)
        .then(|state| state.z[0] *= -0.5)
        .event(Crossing::Falling, |_, q: &One, _| 2.0 * q[0])
        .until(Crossing::Falling, |_, q: &One, z: &One| q[0] + 0.0 * z[0]);
    let path = run.adaptive(1e-10, 1e-10).run(one(1.0), one(0.0), 0.0..5.0).expect("runs");
    let numbers: Vec<_> = path.events().iter().map(|event| event.number).collect();
    assert_eq!((path.stopped_by(), numbers.as_slice()), (Some(2), &[0, 1, 2][..]));
    assert!(path.last().z[0] > 0.0, "after the jump");
}

#[test]
fn jumps_backwards_in_time_and_on_constraints() {
    // Backwards the ball is thrown up by the floor: it comes down to it with less speed than it leaves.
    let kernel = ball();
    let run = Simulation::new(&kernel).event(Crossing::Falling, floor).then(|state| state.z[0] /= -0.5);
    let fall = (2.0 / G).sqrt();
    let path = run.adaptive(1e-11, 1e-11).run(one(0.0), one(0.0), 0.0..-0.1).expect("runs");
    assert!(path.last().q[0] < 0.0 && path.events().is_empty(), "it left zero at the start");
    let path = run.adaptive(1e-11, 1e-11).run(one(0.25), one(0.0), 2.0 * fall..0.5 * fall).expect("runs");
    assert!((path.last().q[0] - 1.0).abs() < 1e-8 && path.events().len() == 1, "{:?}", path.last());

    // Off the ring velocities are brought back along what the ring pushes: the rest stays.
    let ring = Ring { g: 0.0 }.kernel().expect("a ring");
    let kick = |state: &mut Sample<RingKernel>| state.z = SVector::from([3.0, 3.0]);
    let run = Simulation::new(&ring).event(Crossing::Rising, |_, q, _| q[1]).then_through(kick);
    let run = run.adaptive(1e-10, 1e-10);
    let start = (SVector::from([0.6, -0.8]), SVector::from([0.8, 0.6]));
    let path = run.run(start.0, start.1, 0.0..1.0).expect("runs");
    let at = path.events()[0].sample.t;
    assert!((at - 0.8_f64.atan2(0.6)).abs() < 1e-9);
    let after = path.at(at).expect("inside");
    assert!((after.z[1] - 3.0).abs() < 1e-9 && after.z[0].abs() < 1e-9, "{after:?}");
    assert!(path.iter().all(|s| (s.q.norm() - 1.0).abs() < 1e-14 && s.q.dot(&s.z).abs() < 1e-14));
}

#[test]
fn jumps_to_nowhere_are_errors() {
    let kernel = ball();
    let run = Simulation::new(&kernel).event(Crossing::Falling, floor).then(|state| state.z[0] = f64::NAN);
    let error = run.adaptive(1e-9, 1e-9).run(one(1.0), one(0.0), 0.0..2.0).expect_err("refused");
    assert!(error.to_string().contains("the state after the jump at an event"), "{error}");
    assert!(error.time <= (2.0 / G).sqrt(), "{error}");
}

#[test]
fn a_limit_counts_all_flights_together() {
    let kernel = ball();
    let run = Simulation::new(&kernel).event(Crossing::Falling, floor).then(|state| state.z[0] *= -1.0);
    let error = run.fixed_step(0.1).max_steps(40).run(one(1.0), one(0.0), 0.0..5.0).expect_err("refused");
    assert_eq!(error.kind, IntegrationErrorKind::TooManySteps { limit: 40 });
    let error = run.adaptive(1e-9, 1e-9).max_steps(20).run(one(1.0), one(0.0), 0.0..50.0).expect_err("refused");
    assert_eq!(error.kind, IntegrationErrorKind::TooManySteps { limit: 20 });
    assert!(error.time > 1.0);
}

#[test]
fn jumps_without_end_are_given_up_as_steps_are() {
    let error = within(60, "a ball that bounces for ages", || {
        let kernel = ball();
        let run = Simulation::new(&kernel).event(Crossing::Falling, floor).then(|state| state.z[0] *= -1.0);
        run.adaptive(1e-9, 1e-9).run_to_end(one(1.0), one(0.0), 0.0..1e12).expect_err("a million million bounces")
    });
    assert!(matches!(error.kind, IntegrationErrorKind::TooManySteps { .. }), "{error}");
}

/// How a run over a floor ended: above it all the way to 10 s, or where impacts pile up, or at an impact that does not
/// turn it back.
fn ended<K>(
    path: &Trajectory<'_, K>,
    error: Option<IntegrationError>,
    floor: f64,
    kept: f64,
) -> Option<IntegrationErrorKind>
where
    K: GaussSystem<Scalar = f64, Configuration = Isometry3<f64>>,
{
    // Zeros are found to four roundings of the time, at 4.5 m/s; heights are rounded as the distance from the origin
    // is. With all speed kept, depths are added up.
    let rounding = 8.0 * f64::EPSILON * (4.5 * 10.0 + 2.0 * (floor.abs() + 1.0));
    let allowed = if kept < 1.0 { rounding } else { rounding * path.events().len() as f64 };
    let lowest = path.iter().map(|state| state.q.translation.z - floor).fold(f64::INFINITY, f64::min);
    assert!(lowest >= -allowed, "{floor} {kept}: {lowest:e}, {error:?}");
    assert!(path.events().len() < 500);
    let error = error?;
    let fall = (2.0 / G).sqrt();
    if let IntegrationErrorKind::Zeno { event: 0, .. } = error.kind {
        let rests = fall * (1.0 + kept) / (1.0 - kept);
        // Tolerances of 1e-6 a step of some hundred.
        assert!((error.time - rests).abs() < 1e-4, "{kept}: {} {rests}", error.time);
    } else {
        assert!(matches!(error.kind, IntegrationErrorKind::NotTurnedBack { event: 0, .. }), "{error}");
        assert_eq!(error.time, path.events().last().expect("at an impact").sample.t);
    }
    Some(error.kind)
}

const SPINS: [[f64; 3]; 6] =
    [[0.0; 3], [0.0, 0.0, 3.0], [1.0, 0.0, 0.0], [0.3, -2.0, 0.7], [0.0, 9.0, 0.1], [5.0, 5.0, 5.0]];

fn above(floor: f64, [x, y, z]: [f64; 3]) -> (Isometry3<f64>, Vector6<f64>) {
    (Isometry3::translation(0.0, 0.0, floor + 1.0), Vector6::new(0.0, 0.0, 0.0, x, y, z))
}

#[test]
fn bodies_that_spin_do_not_fall_through_floors() {
    let (own, space) = (InItsAxes::thrown().kernel().expect("a body"), InSpace::thrown().kernel().expect("a body"));
    let (mut turned, mut piled_up, mut whole) = (0, 0, 0);
    for (floor, tolerance) in [(0.0, 1e-6), (1.7, 1e-6), (-0.3, 1e-10)] {
        let height = move |_: f64, q: &Isometry3<f64>, _: &Vector6<f64>| q.translation.z - floor;
        for kept in [0.0, 0.5, 0.9, 1.0] {
            for spin in SPINS {
                let (q, z) = above(floor, spin);
                // Along the body's own axis, whatever way it has turned to: mended only by turning the velocity in
                // space.
                let run = Simulation::new(&own).event(Crossing::Falling, height);
                let wrong = run.then(|state| state.z[2] *= -kept).adaptive(tolerance, tolerance);
                let (path, error) = wrong.attempt(q, z, 0.0..10.0);
                let how = ended(&path, error, floor, kept);
                let tilts = spin[0] != 0.0 || spin[1] != 0.0;
                turned += usize::from(matches!(how, Some(IntegrationErrorKind::NotTurnedBack { .. })));
                assert!(tilts || !matches!(how, Some(IntegrationErrorKind::NotTurnedBack { .. })));

                let right = run.then(|state| {
                    let up = state.q.rotation.inverse() * Vector3::z();
                    let v = state.z.fixed_rows::<3>(0).into_owned();
                    state.z.fixed_rows_mut::<3>(0).copy_from(&(v - up * ((1.0 + kept) * up.dot(&v))));
                });
                let run = Simulation::new(&space).event(Crossing::Falling, height);
                // With a push to the spin, which changes nothing of the flight.
                let in_space = run.then(|state| (state.z[2], state.z[3]) = (-kept * state.z[2], state.z[3] + 0.1));
                let mut ends = vec![
                    ended_by(right.adaptive(tolerance, tolerance).attempt(q, z, 0.0..10.0), floor, kept),
                    ended_by(in_space.adaptive(tolerance, tolerance).attempt(q, z, 0.0..10.0), floor, kept),
                    ended_by(in_space.fixed_step(0.05).attempt(q, z, 0.0..10.0), floor, kept),
                ];
                if spin == SPINS[3] && floor == 1.7 && kept == 0.5 {
                    ends.push(ended_by(in_space.taylor(1e-12, 1e-12).attempt(q, z, 0.0..10.0), floor, kept));
                }
                for end in ends {
                    assert_eq!(end.is_none(), kept == 1.0, "{floor} {kept} {spin:?}: {end:?}");
                    assert!(end.is_none_or(|kind| matches!(kind, IntegrationErrorKind::Zeno { .. })), "{end:?}");
                    piled_up += usize::from(end.is_some());
                    whole += usize::from(end.is_none());
                }
            }
        }
    }
    assert!(turned > 30 && piled_up == 3 * (3 * 6 * 3) + 1 && whole == 3 * 6 * 3, "{turned} {piled_up} {whole}");
}

/// Where the body's third axis lies level, or nearly so, turning the velocity along it changes next to nothing of the
/// fall.
#[test]
fn a_level_axis_does_not_turn_a_fall_back() {
    let own = InItsAxes::thrown().kernel().expect("a body");
    let height = |_: f64, q: &Isometry3<f64>, _: &Vector6<f64>| q.translation.z;
    let run = Simulation::new(&own).event(Crossing::Falling, height).then(|state| state.z[2] *= -0.5);
    for off in [0.0, 1e-12, -1e-9, 1e-6, -2e-5, 5e-4, 1e-2, -0.1] {
        let (mut q, z) = above(0.0, [0.0; 3]);
        q.rotation = UnitQuaternion::new(Vector3::x() * (std::f64::consts::FRAC_PI_2 + off));
        for (_, error) in
            [run.adaptive(1e-8, 1e-8).attempt(q, z, 0.0..2.0), run.fixed_step(0.01).attempt(q, z, 0.0..2.0)]
        {
            let kind = error.expect("goes on falling").kind;
            assert!(matches!(kind, IntegrationErrorKind::NotTurnedBack { event: 0, .. }), "{off:e}: {kind:?}");
        }
    }
}

fn ended_by<K>(
    (path, error): (Trajectory<'_, K>, Option<IntegrationError>),
    floor: f64,
    kept: f64,
) -> Option<IntegrationErrorKind>
where
    K: GaussSystem<Scalar = f64, Configuration = Isometry3<f64>>,
{
    ended(&path, error, floor, kept)
}

#[test]
fn runs_in_lanes_pile_up_and_are_told_as_alone() {
    type Pack = Lanes<f64, 4>;
    let number = Pack::splat;
    let alone = InItsAxes::thrown().kernel().expect("a body");
    let packs = InItsAxes { mass: number(2.0), inertia: Vector3::new(0.3, 0.4, 0.5).map(number), g: number(G) };
    let packs = packs.kernel().expect("bodies");
    let starts: Vec<_> = (0..2 * SPINS.len()).map(|n| above(1.7 + 0.1 * n as f64, SPINS[n % SPINS.len()])).collect();
    for kept in [0.0, 0.6, 1.0] {
        let mut states = States::<InItsAxesKernel<Pack>>::from_fn(starts.len(), |n| starts[n]);
        let ends = Batch::new(&packs)
            .adaptive(1e-8, 1e-8)
            .event(Crossing::Falling, |_t, q: &Isometry3<Pack>, _z| q.translation.z - number(1.7))
            .then(|state: &mut Sample<InItsAxesKernel<Pack>>| state.z[2] *= number(-kept))
            .run(0.0..3.0, &mut states);
        for (n, (end, (q, z))) in ends.into_iter().zip(&starts).enumerate() {
            let run = Simulation::new(&alone)
                .event(Crossing::Falling, |_t, q, _z| q.translation.z - 1.7)
                .then(|state| state.z[2] *= -kept)
                .adaptive(1e-8, 1e-8);
            let (path, error) = run.attempt(*q, *z, 0.0..3.0);
            match (end, error) {
                (Ok(end), None) => {
                    assert_eq!((end.time, end.summary), (path.last().t, *path.summary()), "{n}");
                    let times = |found: &mut dyn Iterator<Item = f64>| found.collect::<Vec<_>>();
                    let theirs = times(&mut path.events().iter().map(|event| event.sample.t));
                    assert_eq!(times(&mut end.events.iter().map(|event| event.t)), theirs, "{n}");
                }
                (Err(error), Some(single)) => assert_eq!((error.time, error.kind), (single.time, single.kind), "{n}"),
                (end, error) => panic!("{n}: {end:?}, {error:?}"),
            }
            assert!(states.get(n) == (path.last().q, path.last().z), "{n}");
        }
    }
}
