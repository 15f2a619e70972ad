//! First touches of what flies fast and far: none is missed, whatever the step.

use gauss_contact::{ContactRun, EventKind};
use gauss_runtime::prelude::*;

/// Two balls without weight, in a plane.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, u, w),
    particle(mass = m, position = [x, y, 0]),
    particle(mass = n, position = [u, w, 0]),
    frame(first, position = [x, y, 0]),
    frame(second, position = [u, w, 0]),
    contact(pair, point = first.position, radius = r, other = second.position, other_radius = r),
)]
struct Pair {
    m: f64,
    n: f64,
    r: f64,
}

/// A particle that may meet a post, in a plane.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y),
    particle(mass = m, position = [x, y, 0]),
    contact(post, gap = sqrt(x * x + y * y) - rho, restitution = 0.5),
)]
struct Post {
    m: f64,
    rho: f64,
}

/// A ball as a body, which spins, and a wall of stakes: a bump on flat ground.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(ball, position = pose.position, rotation = pose.rotation, mass = m, inertia = 0.4 * m * r * r),
    frame(stake, position = [0, 0, 0]),
    contact(stake, point = ball.position, radius = r, other = stake.position, other_radius = r, friction = 0.3,
        along = [0, 0, 1]),
)]
struct Spinning {
    m: f64,
    r: f64,
}

/// A particle, and a wall that comes for a moment.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x),
    particle(mass = m, position = [x, 0, 0]),
    contact(wall, gap = x - a * exp(-(t - t0) * (t - t0) / (w * w))),
)]
struct Comes {
    m: f64,
    a: f64,
    t0: f64,
    w: f64,
}

/// A rotor that comes by a stop, nearly.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(theta),
    particle(mass = m, position = [cos(theta), 0, sin(theta)]),
    contact(stop, gap = c - cos(theta - 2.5)),
)]
struct Rotor {
    m: f64,
    c: f64,
}

/// A rod whose ends may touch a floor.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, z, turn),
    body(rod, position = [x, 0, z], rotation = rotation_y(turn), mass = 1, inertia = 0.08),
    point(front, body = rod, at = [0.5, 0, 0]),
    point(back, body = rod, at = [-0.5, 0, 0]),
    contact(first, point = front),
    contact(second, point = back),
    gravity = 9.81,
)]
struct Whirling {}

const G: f64 = 9.81;
const DISTANCES: [f64; 5] = [0.4, 1.5, 5.0, 40.0, 300.0];
const SPEEDS: [f64; 4] = [0.02, 3.0, 10.0, 250.0];
const TOLERANCES: [f64; 4] = [1e-3, 1e-6, 1e-9, 1e-12];
/// Distances at which the line of the flight passes by the centre, over the distance at which it touches.
const ASIDE: [f64; 7] = [0.0, 0.3, 0.9, 0.999, 1.001, 1.1, 3.0];

/// The time at which something first comes as near as `reach` to a line's foot `aside` of it, from so far away.
fn touch(distance: f64, aside: f64, reach: f64, speed: f64) -> Option<f64> {
    (aside < reach).then(|| (distance - (reach * reach - aside * aside).sqrt()) / speed)
}

/// A touch is found to roundings of the time, times what the gap makes of them where it is nearly grazed.
fn same(found: Option<f64>, wanted: Option<f64>, (span, grazes): (f64, f64)) -> bool {
    match (found, wanted) {
        (Some(found), Some(wanted)) => (found - wanted).abs() <= 1e-11 * span / grazes,
        (None, None) => true,
        _ => false,
    }
}

#[test]
fn two_balls_never_pass_through_one_another() {
    for distance in DISTANCES {
        for speed in SPEEDS {
            for reach in [0.02, 0.2] {
                for aside in ASIDE {
                    for tolerance in TOLERANCES {
                        let kernel = Pair { m: 1.0, n: 2.0, r: 0.5 * reach }.kernel().expect("a scene");
                        let span = 3.0 * distance / speed;
                        let run = ContactRun::new(&kernel).adaptive(tolerance, tolerance);
                        let z = [speed, 0.0, 0.0, 0.0].into();
                        let run = run.run([0.0, 0.0, distance, aside * reach].into(), z, 0.0..span);
                        let name = format!("{distance} {speed} {reach} {aside} {tolerance}");
                        let run = run.unwrap_or_else(|error| panic!("{name}: {error}"));
                        let found = run.events().first().map(|event| event.time);
                        let wanted = touch(distance, aside * reach, reach, speed);
                        let grazes = (1.0 - aside * aside).abs().sqrt().max(0.01);
                        assert!(same(found, wanted, (span, grazes)), "{name}: {found:?} {wanted:?}");
                    }
                }
            }
        }
    }
}

#[test]
fn no_post_is_jumped_over() {
    for distance in DISTANCES {
        for speed in SPEEDS {
            for reach in [0.001, 0.1] {
                for aside in ASIDE {
                    for tolerance in TOLERANCES {
                        let kernel = Post { m: 0.3, rho: reach }.kernel().expect("a scene");
                        // Askew, so that nothing is along an axis.
                        let (sin, cos) = 0.7_f64.sin_cos();
                        let turned = |x: f64, y: f64| [cos * x - sin * y, sin * x + cos * y].into();
                        let span = 7.0 * distance / speed;
                        let run = ContactRun::new(&kernel).adaptive(tolerance, tolerance);
                        let run = run.run(turned(-distance, aside * reach), turned(speed, 0.0), 0.0..span);
                        let name = format!("{distance} {speed} {reach} {aside} {tolerance}");
                        let run = run.unwrap_or_else(|error| panic!("{name}: {error}"));
                        let found = run.events().first().map(|event| event.time);
                        let wanted = touch(distance, aside * reach, reach, speed);
                        // The distance is a root of squares: what is lost beside a small post.
                        let lost = distance / reach;
                        let grazes = (1.0 - aside * aside).abs().sqrt().max(0.01) / (1.0 + 1e-3 * lost);
                        assert!(same(found, wanted, (span, grazes)), "{name}: {found:?} {wanted:?}");
                    }
                }
            }
        }
    }
}

#[test]
fn what_spins_as_if_it_rolled_by_is_met_too() {
    let (r, speed) = (0.05, 10.0);
    for distance in [1.0, 5.0, 60.0] {
        for aside in [0.0, 0.05, 0.09, 0.11] {
            for spin in [0.0, speed / r, -speed / r, 1e3] {
                for tolerance in TOLERANCES {
                    let kernel = Spinning { m: 0.5, r }.kernel().expect("a scene");
                    let pose = Isometry3::translation(-distance, aside, 0.0);
                    let z = [speed, 0.0, 0.0, 0.0, 0.0, spin].into();
                    let run = ContactRun::new(&kernel).adaptive(tolerance, tolerance);
                    let run = run.run(pose, z, 0.0..3.0 * distance / speed);
                    let name = format!("{distance} {aside} {spin} {tolerance}");
                    let run = run.unwrap_or_else(|error| panic!("{name}: {error}"));
                    let found = run.events().iter().find(|event| matches!(event.kind, EventKind::Impact(_)));
                    let wanted = touch(distance, aside, 2.0 * r, speed);
                    // A body that spins is where its steps say, to the tolerance.
                    let near = tolerance.max(1e-11) * 30.0 * distance;
                    let same = match (found, wanted) {
                        (Some(found), Some(wanted)) => (found.time - wanted).abs() < near,
                        (None, None) => true,
                        _ => (aside - 2.0 * r).abs() < near,
                    };
                    assert!(same, "{name}: {found:?} {wanted:?}");
                }
            }
        }
    }
}

#[test]
fn what_rests_is_met_by_a_wall_that_comes_for_a_moment() {
    for end in [1.0, 10.0, 500.0] {
        for part in [0.01, 0.05, 0.2] {
            for place in [0.3, 0.47, 0.66] {
                for tolerance in TOLERANCES {
                    let (t0, w) = (place * end, part * end);
                    let kernel = Comes { m: 2.0, a: 0.1, t0, w }.kernel().expect("a scene");
                    let run = ContactRun::new(&kernel).adaptive(tolerance, tolerance);
                    let run = run.run([0.07].into(), [0.0].into(), 0.0..end).expect("runs");
                    let wanted = t0 - w * (10.0_f64 / 7.0).ln().sqrt();
                    let found = run.events().first().map(|event| event.time);
                    let same = found.is_some_and(|found| (found - wanted).abs() < 1e-12 * end);
                    assert!(same, "{end} {part} {place} {tolerance}: {found:?} {wanted}");
                }
            }
        }
    }
}

#[test]
fn a_stop_is_met_however_many_turns_a_step_makes() {
    for (speed, end) in [(0.4, 12.0), (10.0, 10.0), (100.0, 10.0)] {
        for margin in [1e-5, 0.01, 0.5] {
            for start in [0.0, 2.5 - std::f64::consts::PI] {
                for tolerance in TOLERANCES {
                    let kernel = Rotor { m: 1.5, c: 1.0 - margin }.kernel().expect("a scene");
                    let run = ContactRun::new(&kernel).adaptive(tolerance, tolerance);
                    let run = run.run([start].into(), [speed].into(), 0.0..end).expect("runs");
                    let wanted = (2.5 - (1.0 - margin).acos() - start) / speed;
                    let found = run.events().first().map(|event| event.time);
                    let same = found.is_some_and(|found| (found - wanted).abs() < 1e-9 / speed);
                    assert!(same, "{speed} {margin} {start} {tolerance}: {found:?} {wanted}");
                }
            }
        }
    }
}

/// A hammer that comes for seven of the 4096 looks at a run, wherever in it.
#[test]
fn what_rests_is_met_by_a_hammer_that_comes_for_some_looks() {
    for end in [1.0, 10.0, 500.0] {
        for place in (0..12_u8).map(|k| (f64::from(k) + 0.45) / 12.0) {
            for tolerance in [1e-3, 1e-9] {
                let (t0, w) = (place * end, 0.001 * end);
                let kernel = Comes { m: 2.0, a: 0.2, t0, w }.kernel().expect("a scene");
                let run = ContactRun::new(&kernel).adaptive(tolerance, tolerance);
                let run = run.run([0.1].into(), [0.0].into(), 0.0..end).expect("runs");
                let (wanted, found) = (t0 - w * 2.0_f64.ln().sqrt(), run.events().first().map(|event| event.time));
                let same = found.is_some_and(|found| (found - wanted).abs() < 1e-12 * end);
                assert!(same, "{end} {place} {tolerance}: {found:?} {wanted}");
            }
        }
    }
}

/// A wall that comes for less than a run is looked at is found as far as looks go, and the run tells that there are no
/// more than these.
#[test]
fn gaps_that_depend_on_the_time_are_told_to_be_sampled() {
    for w in [0.01, 0.05, 0.5] {
        let kernel = Comes { m: 1.0, a: 1.2, t0: 5.3, w }.kernel().expect("a scene");
        let run = ContactRun::new(&kernel).adaptive(1e-9, 1e-9).run([1.0].into(), [0.0].into(), 0.0..10.0);
        let run = run.expect("runs");
        let wanted = 5.3 - w * 1.2_f64.ln().sqrt();
        let found = run.events().first().map(|event| event.time);
        assert!(found.is_some_and(|found| (found - wanted).abs() < 1e-11), "{w}: {found:?} {wanted}");
        let sampled: Vec<(f64, f64)> = run.sampled_gaps().iter().map(|gap| (gap.start, gap.end)).collect();
        assert_eq!(sampled, [(0.0, 10.0)], "{w}");
    }
    // What passes between two looks may be passed, and that is told.
    let kernel = Comes { m: 1.0, a: 1.2, t0: 5.3, w: 1e-5 }.kernel().expect("a scene");
    let run = ContactRun::new(&kernel).adaptive(1e-9, 1e-9).run([1.0].into(), [0.0].into(), 0.0..10.0);
    assert_eq!(run.expect("runs").sampled_gaps().len(), 1);
    // The motion alone is bounded.
    let kernel = Post { m: 1.0, rho: 0.1 }.kernel().expect("a scene");
    let run = ContactRun::new(&kernel).adaptive(1e-9, 1e-9).run([2.0, 0.0].into(), [-1.0, 0.0].into(), 0.0..10.0);
    assert!(run.expect("runs").sampled_gaps().is_empty());
}

/// A rod falls and turns by up to some thousand turns in a step of free flight: its tip is met where it first touches,
/// or the run tells that the gap was known by samples there.
#[test]
fn the_tip_of_a_rotor_is_met_or_its_gap_is_told_to_be_sampled() {
    let slow = [
        (30.0, 0.0, 1e-6),
        (300.0, 0.3, 1e-3),
        (300.0, 2.5, 1e-9),
        (3e3, 0.0, 1e-6),
        (3e3, 0.3, 1e-9),
        (3e3, 1.1, 1e-6),
    ];
    let fast = [(7e3, 0.78, 1e-3), (1e4, 1.3, 1e-3), (1e4, 1.365, 1e-6), (3e4, 0.39, 1e-9), (3e4, 1.82, 1e-3)];
    for (speed, turned, tolerance) in slow.into_iter().chain(fast) {
        let kernel = Whirling {}.kernel().expect("a scene");
        let run = ContactRun::new(&kernel).adaptive(tolerance, tolerance);
        let run = run.until(Crossing::Falling, |_, q: &SVector<f64, 3>, _| q[1] - 0.45);
        let run = run.run([0.0, 2.0, turned].into(), [0.0, 0.0, speed].into(), 0.0..0.8).expect("runs");
        let gap = |t: f64| 2.0 - 0.5 * G * t * t - 0.5 * (turned + speed * t).sin().abs();
        // The first zero of the exact motion, by looks a thousandth of a radian apart, where the tip is low enough.
        let (look, [from, until]) = (1e-3 / speed, [1.5_f64, 1.55].map(|height| (2.0 * height / G).sqrt()));
        let mut looks = (0..).map(|n| from + f64::from(n) * look).take_while(|t| *t < until);
        let first = looks.find(|t| gap(*t) < 0.0).expect("it comes down");
        let found = run.events().first().map(|event| event.time);
        let same = found.is_some_and(|found| (found - first).abs() <= 2.0 * look);
        // Steps of some hundred turns are resolved, those of thousands not everywhere.
        let told = speed > 3e3 && run.sampled_gaps().iter().any(|gap| gap.start < first && first < gap.end);
        assert!(same || told, "{speed} {turned} {tolerance}: {found:?} {first}");
    }
}

/// Steps of ten turns resolve the turns.
#[test]
fn the_tip_of_a_rotor_is_met_in_steps_of_ten_turns() {
    for speed in [500.0, 3000.0, 6000.0] {
        for tolerance in [1e-6, 1e-9] {
            let kernel = Whirling {}.kernel().expect("a scene");
            let steps = Adaptive::new(tolerance, tolerance).largest_step(10.0 * std::f64::consts::TAU / speed);
            let run = ContactRun::new(&kernel).control(steps).until(Crossing::Falling, |_, q, _| q[1] - 0.45);
            let run = run.run([0.0, 2.0, 0.3].into(), [0.0, 0.0, speed].into(), 0.0..0.8).expect("runs");
            let gap = |t: f64| 2.0 - 0.5 * 9.81 * t * t - 0.5 * (0.3 + speed * t).sin().abs();
            let found = run.events().first().expect("it touches").time;
            // The first zero of the exact motion, by looks a thousandth of a radian apart.
            let look = 1e-3 / speed;
            let first = (0..).map(|n| f64::from(n) * look).find(|t| gap(*t) < 0.0).expect("it touches");
            assert!((found - first).abs() <= 2.0 * look, "{speed} {tolerance}: {found} {first}");
        }
    }
}
