//! Jumps at a zero: a particle under weight that bounces off floors of every height, slope and restitution.

use nalgebra::SVector;
use std::string::ToString;
use std::vec::Vec;

use crate::integrate::drive::each::Each;
use crate::integrate::drive::search::Function;
use crate::integrate::{
    Adaptive, Control, Crossing, Fixed, IntegrationErrorKind, JumpMistake, Sample, Simulation, Trajectory,
};
use crate::testing::coasting::Coasting;

type Pair = SVector<f64, 2>;
type Particle = Coasting<Pair>;

const G: f64 = 9.81;
/// Two roundings.
const UNIT: f64 = f64::EPSILON;

fn particle() -> Particle {
    Coasting { push: Pair::from([0.0, -G]), drag: 0.0 }
}

fn pair(x: f64, y: f64) -> Pair {
    Pair::from([x, y])
}

/// Bound of the depth of an impact below the floor: zeros are found to four roundings of the time, or of a step up to
/// the end of the run, and a little more for roundings of the numbers.
fn depth(speed: f64, end: f64, size: f64) -> f64 {
    8.0 * UNIT * speed * end + 16.0 * UNIT * size
}

/// Runs over a floor to 10 s: Ok and above it, or `Zeno` where impacts pile up.
fn bounce<C: Control<Particle>>(control: C, floor: f64, kept: f64, drift: f64) {
    const END: f64 = 10.0;
    let system = particle();
    let run = Simulation::new(&system)
        .event(Crossing::Falling, |_, q: &Pair, _| q[1] - floor)
        .then(|state| state.z[1] *= -kept)
        .control(control);
    let (path, error) = run.attempt(pair(0.0, floor + 1.0), pair(drift, 0.0), 0.0..END);
    let name = std::format!("floor {floor}, kept {kept}, drift {drift}");
    let size = floor.abs() + drift.abs() * END + 1.0;
    let fastest = path.iter().map(|state| state.z[1].abs()).fold(0.0, f64::max);
    let lowest = path.iter().map(|state| state.q[1] - floor).fold(f64::INFINITY, f64::min);
    // Depths of impacts are not added up but for the roundings of as many sums.
    let allowed = depth(fastest, END, size) * if kept < 1.0 { 1.0 } else { path.events().len() as f64 };
    assert!(lowest >= -allowed, "{name}: {lowest:e}, {allowed:e}");
    assert!(path.events().len() < 1000, "{name}: {}", path.events().len());
    let rests = (2.0 / G).sqrt() * (1.0 + kept) / (1.0 - kept);
    if kept >= 1.0 || rests > END {
        assert!(error.is_none() && path.last().t == END, "{name}: {error:?}");
        return;
    }
    let error = error.expect("piles up");
    assert!(matches!(error.kind, IntegrationErrorKind::Zeno { event: 0, .. }), "{name}: {error}");
    // What is left to come when a flight is lower than 5.3 times 16 roundings: 2v/g and so on, from a height v²/2g; in
    // each impact the time of a fall of some depth is gained or lost.
    let height = 6.0 * 16.0 * UNIT * size + 2.0 * allowed;
    let left = 2.0 * (2.0 * height / G).sqrt() / (1.0 - kept);
    assert!((error.time - rests).abs() < left + 1e-9, "{name}: {:e}, {left:e}", error.time - rests);
}

#[test]
fn a_ball_that_bounces_stays_above_every_floor_or_the_run_says_where_it_rests() {
    for floor in [0.0, 1.7, -0.3, 1e3] {
        for kept in [0.0, 0.2, 0.5, 0.8, 0.9, 1.0, 1.05] {
            for drift in [0.0, 0.3] {
                bounce(Adaptive::new(1e-6, 1e-6), floor, kept, drift);
                bounce(Adaptive::new(1e-10, 1e-10), floor, kept, drift);
                bounce(Fixed::new(0.01), floor, kept, drift);
                bounce(Fixed::new(3.0), floor, kept, drift);
            }
        }
    }
}

/// A ground y = ground(x), given with its slope, and the part of the normal velocity that is kept.
fn reflect(state: &mut Sample<Particle>, slope: f64, kept: f64) {
    let normal = pair(-slope, 1.0).normalize();
    state.z -= normal * ((1.0 + kept) * normal.dot(&state.z));
}

#[test]
fn slopes_and_hills_turn_a_ball_back_as_floors_do() {
    type Ground = (fn(f64) -> f64, fn(f64) -> f64);
    let grounds: [Ground; 3] = [
        (|x| 0.7 - 0.4 * x, |_| -0.4),
        (|x| 2.0 + 0.3 * (2.0 * x).sin(), |x| 0.6 * (2.0 * x).cos()),
        (|x| 0.25 * x * x - 1.0, |x| 0.5 * x),
    ];
    let system = particle();
    for (n, (ground, slope)) in grounds.into_iter().enumerate() {
        for kept in [0.0, 0.5, 0.9, 1.0] {
            let run = Simulation::new(&system)
                .event(Crossing::Falling, |_, q: &Pair, _| q[1] - ground(q[0]))
                .then(|state| reflect(state, slope(state.q[0]), kept))
                .control(Adaptive { largest_step: Some(0.02), ..Adaptive::new(1e-9, 1e-9) });
            let (path, error) = run.attempt(pair(0.1, ground(0.1) + 1.0), pair(0.7, 0.0), 0.0..20.0);
            let name = std::format!("ground {n}, kept {kept}");
            let speed = path.iter().map(|state| state.z.norm()).fold(0.0, f64::max);
            let lowest = path.iter().map(|state| state.q[1] - ground(state.q[0])).fold(f64::INFINITY, f64::min);
            let size = path.iter().map(|state| state.q.norm()).fold(3.0, f64::max);
            // As on floors, with the slopes of the ground in the bargain.
            let allowed = depth(4.0 * speed, 20.0, 4.0 * size) * path.events().len() as f64;
            assert!(lowest >= -allowed, "{name}: {lowest:e}, {allowed:e}");
            match error {
                None => assert!(kept == 1.0 && path.last().t == 20.0, "{name}: {:?}", path.last()),
                Some(error) => {
                    assert!(kept < 1.0 && matches!(error.kind, IntegrationErrorKind::Zeno { .. }), "{name}: {error}");
                }
            }
            assert!(path.events().len() < 2000, "{name}: {}", path.events().len());
        }
    }
}

#[test]
fn a_jump_of_the_wrong_velocity_is_told_and_a_gate_is_passed() {
    let system = particle();
    let start = (pair(0.0, 1.0), pair(2.0, 0.0));
    let falls = |_: f64, q: &Pair, _: &Pair| q[1] - 0.1 * q[0];
    let run = Simulation::new(&system).event(Crossing::Falling, falls);
    // The velocity along the level alone, a brake, a push, one along the slope and one nearly so: none of them leads
    // back.
    let jumps: [fn(&mut Sample<Particle>); 6] = [
        |s| s.z[0] *= -0.5,
        |s| s.z[1] *= 0.5,
        |s| s.z[1] -= 1.0,
        |s| s.z *= 0.1,
        |s| s.z += pair(1.0, 0.1),
        |s| s.z += pair(1e-6, 1e-7 * (1.0 + 1e-6)),
    ];
    for (n, jump) in jumps.into_iter().enumerate() {
        let (path, error) = run.then(jump).adaptive(1e-9, 1e-9).attempt(start.0, start.1, 0.0..5.0);
        let error = error.expect("does not lead back");
        let IntegrationErrorKind::NotTurnedBack { event: 0, before, after } = error.kind else {
            panic!("{n}: {error}")
        };
        let (last, mut next) = (*path.last(), *path.last());
        jump(&mut next);
        let of = |state: &Sample<Particle>| state.z[1] - 0.1 * state.z[0];
        assert!(error.time == path.events()[0].sample.t && path.events().len() == 1);
        assert!((after - of(&last)).abs() < 1e-7 && before < 0.0 && after < 0.0, "{n}: {error}");
        assert!(error.to_string().contains("then_through"), "{error}");
        let path = run.then_through(jump).adaptive(1e-9, 1e-9).run(start.0, start.1, 0.0..5.0).expect("passes");
        assert!(path.events().len() == 1 && path.last().q[1] < -50.0);
    }
    // What no velocity turns back passes: at a time, at a turning point; at a place by its own word, or where no state
    // changes.
    let switched = core::cell::Cell::new(false);
    let run = Simulation::new(&system)
        .event(Crossing::Rising, |t, _, _| t - 0.25)
        .then(|s| s.z[0] += 1.0)
        .event(Crossing::Rising, |_, q: &Pair, _| q[0] - 1.0)
        .then_through(|s| s.z[1] += 5.0)
        .event(Crossing::Falling, |_, _, z: &Pair| z[1])
        .then(|s| s.q[1] += 1.0)
        .event(Crossing::Rising, |_, q: &Pair, _| q[0] - 1.5)
        .then(|_| switched.set(true));
    for step in [0.1, 1.0] {
        switched.set(false);
        let path = run.fixed_step(step).run(start.0, pair(2.0, 1.0), 0.0..2.0).expect("passes");
        let seen: std::vec::Vec<_> = path.events().iter().map(|event| event.number).collect();
        assert_eq!(seen, [2, 0, 1, 3, 2]);
        assert!(switched.get());
    }
    // A gate may turn back, too.
    let run = Simulation::new(&system).event(Crossing::Falling, |_, q: &Pair, _| q[1]).then_through(|s| s.z[1] *= -0.5);
    let error = run.adaptive(1e-9, 1e-9).attempt(start.0, start.1, 0.0..1.3).1;
    assert_eq!(error, None);
}

/// Each impact keeps all but a ten thousandth of the speed: rest is 160,000 impacts away.
#[test]
fn a_run_whose_steps_are_jumps_is_told_so() {
    let system = particle();
    let run = Simulation::new(&system)
        .event(Crossing::Falling, |_, q: &Pair, _| q[1] - 1e3)
        .then(|state| state.z[1] *= -0.9999)
        .adaptive(1e-9, 1e-9)
        .max_steps(3000);
    let (path, error) = run.attempt(pair(0.0, 1e3 + 1e-6), pair(0.0, 0.0), 0.0..100.0);
    let error = error.expect("does not reach the end");
    let IntegrationErrorKind::TooManyJumps { event: 0, jumps, interval } = error.kind else { panic!("{error}") };
    assert_eq!(jumps, path.summary().jumps);
    // A flight of a micrometre.
    let flight = (8e-6 / G).sqrt();
    assert!(jumps > 300 && interval < flight && interval > 0.5 * flight, "{error}");
    assert!(error.to_string().contains("max_steps"), "{error}");
}

/// A flight that begins on zero is seen to end however short it is beside the step.
#[test]
fn short_flights_from_zero_end_where_they_should() {
    let system = particle();
    for floor in [0.0, 1.7] {
        let run = Simulation::new(&system).until(Crossing::Falling, |_, q: &Pair, _| q[1] - floor);
        for speed in [1e-5, 1e-4, 1e-3, 0.01, 0.1, 1.0] {
            for step in [1e-3, 0.1, 1.0] {
                let end = run.fixed_step(step).run_to_end(pair(0.0, floor), pair(0.0, speed), 0.0..5.0).expect("lands");
                let flight = 2.0 * speed / G;
                // The height is rounded as that of the floor is, at this speed; the time by four roundings, and those
                // of a step's sum.
                let allowed = (8.0 * UNIT * floor / speed) + 32.0 * UNIT * step.max(flight);
                assert!((end.t - flight).abs() < allowed, "{floor} {speed} {step}: {:e}", end.t - flight);
            }
        }
    }
    // Backwards as well: thrown by the floor at -v.
    let run = Simulation::new(&system).until(Crossing::Falling, |_, q: &Pair, _| q[1]);
    let end = run.fixed_step(0.5).run_to_end(pair(0.0, 0.0), pair(0.0, -1e-4), 0.0..-5.0).expect("lands");
    assert!((end.t + 2e-4 / G).abs() < 32.0 * UNIT * 0.5);
}

#[test]
fn events_with_one_zero_happen_together() {
    let system = particle();
    for factor in [1.0, 3.0, 0.7, 1e-3] {
        let run = Simulation::new(&system)
            .event(Crossing::Falling, |_, q: &Pair, _| q[1] - 1.7)
            .then(|state| state.z[1] *= -0.5)
            .event(Crossing::Any, |_, q: &Pair, _| factor * (q[1] - 1.7))
            .event(Crossing::Falling, |_, q: &Pair, _| factor * (q[1] - 1.7));
        for control in [Adaptive::new(1e-7, 1e-7), Adaptive::new(1e-10, 1e-10)] {
            let path = run.control(control).run(pair(0.0, 2.7), pair(0.0, 0.0), 0.0..1.3).expect("runs");
            let seen: std::vec::Vec<_> = path.events().iter().map(|event| event.number).collect();
            // Not again when it leaves.
            let count = |number| seen.iter().filter(|seen| **seen == number).count();
            assert_eq!((count(0), count(1), count(2)), (5, 5, 5), "{factor}: {seen:?}");
            // Zeros are found to four roundings of the time or of a step, each by itself.
            let together = |a: f64, b: f64| (a - b).abs() <= 8.0 * UNIT * 1.3;
            let mut threes = path.events().chunks(3);
            assert!(threes.all(|three| three.iter().all(|event| together(event.sample.t, three[0].sample.t))));
        }
        let end = run.until(Crossing::Falling, |_, q: &Pair, _| factor * q[1] - factor * 1.7);
        let end = end.adaptive(1e-9, 1e-9).run_to_end(pair(0.0, 2.7), pair(0.0, 0.0), 0.0..5.0).expect("ends");
        assert!(end.stopped_by == Some(3) && end.z[1] > 0.0, "{factor}: {end:?}");
    }
}

#[test]
fn a_jump_sets_what_it_may() {
    let system = particle();
    let start = (pair(0.0, 1.0), pair(0.0, 0.0));
    let run = Simulation::new(&system).event(Crossing::Falling, |_, q: &Pair, _| q[1]);
    let by_speeds = run.then(|s| s.z[1] *= -0.5).adaptive(1e-9, 1e-9);
    let by_momenta = run.then(|s| s.p[1] *= -0.5).adaptive(1e-9, 1e-9);
    let by_both = run.then(|s| *s = Sample { z: -s.z, p: -s.p, ..*s }).adaptive(1e-9, 1e-9);
    let expected = by_speeds.run(start.0, start.1, 0.0..1.0).expect("runs");
    // The mass matrix is the identity.
    assert_eq!(by_momenta.run(start.0, start.1, 0.0..1.0).expect("runs").last().q, expected.last().q);
    let path = by_both.run(start.0, start.1, 0.0..1.0).expect("runs");
    assert!(path.samples().windows(2).any(|two| two[0].t == two[1].t && two[1].z == -two[0].z));
    type Jump = fn(&mut Sample<Particle>);
    let refused: [(Jump, JumpMistake); 3] = [
        (|s| s.t += 1.0, JumpMistake::Time),
        (|s| s.t = f64::NAN, JumpMistake::Time),
        (|s| (s.z[1], s.p[0]) = (4.0, 1.0), JumpMistake::SpeedsAndMomenta),
    ];
    for (jump, mistake) in refused {
        let error = run.then(jump).adaptive(1e-9, 1e-9).run(start.0, start.1, 0.0..1.0).expect_err("refused");
        assert_eq!(error.kind, IntegrationErrorKind::InvalidJump { event: 0, mistake });
    }
}

/// A list has the bits of as many single events, each with its direction, its end and its jump.
#[test]
fn lists_jump_as_single_events_do() {
    let system = particle();
    let floor = |_: f64, q: &Pair, _: &Pair| q[1];
    let gate = |_: f64, q: &Pair, _: &Pair| q[0] - 0.5;
    let far = |_: f64, q: &Pair, _: &Pair| q[0] - 2.0;
    let start = || (pair(0.0, 1.0), pair(0.7, 0.0));
    let singly = Simulation::new(&system)
        .event(Crossing::Falling, floor)
        .then(|state| state.z[1] *= -0.9)
        .event(Crossing::Rising, gate)
        .then_through(|state| state.z[0] += 0.1)
        .until(Crossing::Any, far)
        .adaptive(1e-9, 1e-9);
    let singly = singly.run(start().0, start().1, 0.0..9.0).expect("runs");
    let functions: [Function<'_, Particle>; 3] = [&floor, &gate, &far];
    let marks = [
        (Crossing::Falling, [false, true, false]),
        (Crossing::Rising, [false, true, true]),
        (Crossing::Any, [true, false, false]),
    ];
    let all = functions.into_iter().zip(marks).map(|(function, (crossing, marks))| (function, crossing, marks));
    let jump = |place: usize, state: &mut Sample<Particle>| {
        match place {
            0 => state.z[1] *= -0.9,
            1 => state.z[0] += 0.1,
            _ => return false,
        }
        true
    };
    let listed = Simulation::new(&system).events_by(Each::of(all).then(jump)).adaptive(1e-9, 1e-9);
    let listed = listed.run(start().0, start().1, 0.0..9.0).expect("runs");
    assert!(singly.events().len() > 4 && singly.stopped_by() == Some(2) && listed.stopped_by() == Some(2));
    let bits = |sample: &Sample<Particle>| (sample.t.to_bits(), sample.q.map(f64::to_bits), sample.z.map(f64::to_bits));
    assert!(singly.iter().map(bits).eq(listed.iter().map(bits)));
    let numbers = |run: &Trajectory<'_, Particle>| run.events().iter().map(|event| event.number).collect::<Vec<_>>();
    assert_eq!(numbers(&singly), numbers(&listed));
}
