//! Events of an oscillator against its closed form, their order, their ends, and the search by itself.

use core::f64::consts::{FRAC_PI_2, PI};

use nalgebra::SVector;
use std::vec::Vec;

use super::*;
use crate::integrate::tests::slope;
use crate::integrate::{
    Classical4, Crossing, Fixed, IntegrationErrorKind, Observer, RunPart, RungeKutta, Sample, Simulation,
};
use crate::system::Smoothness;
use crate::testing::oscillator::{ForceLaw, Oscillator};

/// No force beside the spring: x = sin t from (0, 1).
struct Nothing;

impl ForceLaw for Nothing {
    const SMOOTHNESS: Smoothness = Smoothness::Smooth;
    fn force(_: f64, _: f64) -> f64 {
        0.0
    }
}

type One = SVector<f64, 1>;

const SPRING: Oscillator<Nothing> = Oscillator::new(0.0);

fn undriven(_: f64, _: &One, _: &One) -> f64 {
    0.0
}

fn origin() -> (One, One) {
    (SVector::from([0.0]), SVector::from([1.0]))
}

#[test]
fn events_are_as_accurate_as_the_method_and_lie_on_zero() {
    let (q0, z0) = origin();
    let mut points = Vec::new();
    for h in [0.2, 0.1, 0.05, 0.025] {
        let run = Simulation::new(&SPRING).input(undriven).event(Crossing::Any, |_, _, z: &One| z[0]);
        let run = run.control(Fixed::by(RungeKutta(Classical4), h));
        let trajectory = run.run(q0, z0, 0.0..20.0).expect("runs");
        assert_eq!(trajectory.events().len(), 6);
        let mut worst = 0.0_f64;
        for (n, sample) in trajectory.events_of(0).enumerate() {
            worst = worst.max((sample.t - (n as f64 + 0.5) * PI).abs());
            // Four roundings of the time, at an acceleration of 1, and those of the sums of the step.
            assert!(sample.z[0].abs() < 8.0 * f64::EPSILON * sample.t, "{}", sample.z[0]);
        }
        points.push((h, worst));
    }
    let order = slope(&points);
    assert!((order - 4.0).abs() < 0.2, "{order}: {points:?}");

    let run = Simulation::new(&SPRING).input(undriven).event(Crossing::Any, |_, _, z: &One| z[0]);
    let trajectory = run.adaptive(1e-12, 1e-12).momentum_form().run(q0, z0, 0.0..20.0).expect("runs");
    for (n, sample) in trajectory.events_of(0).enumerate() {
        // Global error: some 400 steps of local errors of at most 1e-12.
        assert!((sample.t - (n as f64 + 0.5) * PI).abs() < 4e-10);
    }
}

#[test]
fn several_in_one_step_come_in_order_both_ways_and_by_direction() {
    let (q0, z0) = origin();
    let above = |level: f64| move |_: f64, q: &One, _: &One| q[0] - level;
    let run = Simulation::new(&SPRING)
        .input(undriven)
        .event(Crossing::Any, above(0.3))
        .event(Crossing::Rising, above(0.1))
        .event(Crossing::Falling, above(0.2))
        .event(Crossing::Any, above(0.4))
        .event(Crossing::Any, above(0.4));
    let forward = run.fixed_step(0.5).run(q0, z0, 0.0..3.1).expect("runs");
    let seen: Vec<_> = forward.events().iter().map(|event| event.number).collect();
    // On the way up in the first step, on the way down in the last ones; 0.1 not then, 0.2 only then.
    assert_eq!(seen, [1, 0, 3, 4, 3, 4, 0, 2]);
    assert!(forward.events().windows(2).all(|pair| pair[0].sample.t <= pair[1].sample.t));
    // Steps of length ½ have local errors of h⁵/120 = 3e-4.
    assert!((forward.events()[0].sample.t - 0.1_f64.asin()).abs() < 3e-4);

    let end = forward.last();
    let backward = run.fixed_step(0.5).run(end.q, end.z, 3.1..0.0).expect("runs");
    let seen: Vec<_> = backward.events().iter().map(|event| event.number).collect();
    // Backwards x rises through 0.1 and 0.3 first; the fall of 0.2 is then the one near t = 0.
    assert_eq!(seen, [1, 0, 3, 4, 3, 4, 0, 2]);
    assert!(backward.events().windows(2).all(|pair| pair[0].sample.t >= pair[1].sample.t));
}

#[test]
fn a_run_ends_at_its_event() {
    let (q0, z0) = origin();
    let run = Simulation::new(&SPRING)
        .input(undriven)
        .event(Crossing::Falling, |_, _, z: &One| z[0])
        .until(Crossing::Falling, |_, q: &One, _| q[0])
        .event(Crossing::Any, |t, _, _| t - 3.2)
        .event(Crossing::Falling, |_, q: &One, _| q[0]);
    for every in [1, 7] {
        let trajectory = run.adaptive(1e-11, 1e-11).every(every).run(q0, z0, 0.0..100.0).expect("runs");
        let end = trajectory.last();
        assert!((end.t - PI).abs() < 1e-9 && end.q[0] <= 0.0 && end.q[0] > -1e-14, "{end:?}");
        let seen: Vec<_> = trajectory.events().iter().map(|event| event.number).collect();
        // What comes at the same time is told of, what would come later in the step is not.
        assert_eq!(seen, [0, 1, 3]);
        assert_eq!(trajectory.events()[1].sample.t, end.t);
        assert_eq!(trajectory.at(end.t).expect("inside").q, end.q);
        assert!(trajectory.at(3.2).is_err());
        let alone = run.adaptive(1e-11, 1e-11).every(every).run_to_end(q0, z0, 0.0..100.0).expect("runs");
        assert_eq!((alone.t, alone.q, alone.z), (end.t, end.q, end.z));
    }
    // A ball on a spring that bounces at 0: started at its event it goes on, in the one direction that is asked for.
    let bounce = Simulation::new(&SPRING).input(undriven).until(Crossing::Falling, |_, q: &One, _| q[0]);
    let (mut t, mut q, mut z) = (0.0, q0, z0);
    for n in 1..=5 {
        let end = bounce.adaptive(1e-11, 1e-11).run_to_end(q, z, t..100.0).expect("runs");
        assert!((end.t - f64::from(n) * PI).abs() < 1e-9, "{n}: {}", end.t);
        (t, q, z) = (end.t, end.q, -end.z);
    }
}

/// Counts, and keeps the last event.
struct Witness<'a> {
    samples: &'a mut u32,
    events: &'a mut Vec<(usize, f64)>,
}

impl<S: GaussSystem> Observer<S> for Witness<'_> {
    fn see(&mut self, _: &Sample<S>) {
        *self.samples += 1;
    }
    fn event(&mut self, number: usize, sample: &Sample<S>) {
        self.events.push((number, sample.t.lane(0)));
    }
}

#[test]
fn observers_see_events_without_a_trajectory() {
    let (q0, z0) = origin();
    let (mut samples, mut events) = (0, Vec::new());
    let run = Simulation::new(&SPRING).input(undriven).event(Crossing::Any, |_, _, z: &One| z[0]).fixed_step(0.125);
    let witness = Witness { samples: &mut samples, events: &mut events };
    run.observe_by(witness).run_to_end(q0, z0, 0.0..4.0).expect("runs");
    assert_eq!((samples, events.len(), events[0].0), (33, 1, 0));
    assert!((events[0].1 - FRAC_PI_2).abs() < 1e-5);
}

#[test]
fn jumps_and_what_goes_there_and_back_are_found_and_touches_are_not() {
    let (q0, z0) = origin();
    let run = Simulation::new(&SPRING)
        .input(undriven)
        .event(Crossing::Any, |t, _, _| if t < 1.237 { -1.0 } else { 2.0 })
        .event(Crossing::Any, |_, q: &One, _| q[0] - 1.000_001)
        // Twice within one step from 1.5 to 1.6.
        .event(Crossing::Any, |t, _, _| (t - 1.52) * (t - 1.58));
    let trajectory = run.fixed_step(0.1).run(q0, z0, 0.0..3.0).expect("runs");
    let found: Vec<_> = trajectory.events().iter().map(|event| (event.number, event.sample.t)).collect();
    for ((number, t), expected) in found.iter().zip([(0, 1.237), (2, 1.52), (2, 1.58)]) {
        assert!(*number == expected.0 && (t - expected.1).abs() < 2e-15, "{found:?}");
    }
    assert_eq!(found.len(), 3);
    // A start on zero is no event, and neither is what leaves it.
    let run = Simulation::new(&SPRING).input(undriven).event(Crossing::Any, |_, q: &One, _| q[0]);
    assert!(run.fixed_step(0.1).run(q0, z0, 0.0..3.0).expect("runs").events().is_empty());
    // A zero at the very end of a step and of the run is one.
    let run = Simulation::new(&SPRING).input(undriven).event(Crossing::Rising, |t, _, _| t - 3.0);
    assert_eq!(run.fixed_step(0.1).run(q0, z0, 0.0..3.0).expect("runs").events()[0].sample.t, 3.0);
}

/// A function that starts on zero, leaves it and is back within the first step passes zero there; one that only leaves
/// it does not.
#[test]
fn what_starts_on_zero_and_comes_back_within_a_step_is_seen() {
    let (q0, z0) = origin();
    let run = Simulation::new(&SPRING)
        .input(undriven)
        .event(Crossing::Any, |t, _, _| t * (t - 0.07))
        .event(Crossing::Rising, |t, _, _| t * (t - 0.03) * (t - 0.06))
        .event(Crossing::Any, |t, _, _| t * t * (0.02 - t))
        .event(Crossing::Any, |t, _, _| t * (1e-4 - t))
        .event(Crossing::Any, |t, _, _| -t)
        .event(Crossing::Any, |_, q: &One, _| 0.0 * q[0]);
    for end in [1.0, -1.0] {
        let mirrored = run.event(Crossing::Falling, |t: f64, _, _| t.abs() * (0.05 - t.abs()));
        let trajectory = mirrored.fixed_step(0.1).run(q0, z0, 0.0..end).expect("runs");
        let found: Vec<_> = trajectory.events().iter().map(|event| (event.number, event.sample.t)).collect();
        let expected: &[_] =
            if end > 0.0 { &[(3, 1e-4), (2, 0.02), (6, 0.05), (1, 0.06), (0, 0.07)] } else { &[(6, -0.05)] };
        let exact = |(a, b): (&(usize, f64), &(usize, f64))| a.0 == b.0 && (a.1 - b.1).abs() < 1e-15;
        assert!(found.len() == expected.len() && found.iter().zip(expected).all(exact), "{found:?}");
    }
}

#[test]
fn an_event_function_that_is_undefined_stops_the_run() {
    let (q0, z0) = origin();
    let run = Simulation::new(&SPRING).input(undriven).event(Crossing::Any, |t: f64, _, _| (1.0 - t).sqrt());
    let (trajectory, error) = run.fixed_step(0.3).every(2).attempt(q0, z0, 0.0..3.0);
    let error = error.expect("stops");
    assert_eq!(error.kind, IntegrationErrorKind::NonFinite { part: RunPart::Event });
    assert_eq!((error.time, trajectory.last().t), (0.3 * 3.0, 0.3 * 3.0));
    let error = run.fixed_step(0.3).run_to_end(q0, z0, 2.0..3.0).expect_err("stops");
    assert_eq!((error.time, error.kind), (2.0, IntegrationErrorKind::NonFinite { part: RunPart::Event }));
}

/// Far from zero times are apart: steps that cannot be told apart are refused by every control, and others are as many
/// as there are.
#[test]
fn steps_that_the_time_does_not_tell_apart_are_refused() {
    let (q0, z0) = origin();
    let run = Simulation::new(&SPRING).input(undriven);
    for (start, step) in [(1e16, 0.01), (-1e16, 1.9), (1e18, 100.0)] {
        for end in [start + 100.0, start - 100.0] {
            let error = run.fixed_step(step).run_to_end(q0, z0, start..end).expect_err("refused");
            assert!(matches!(error.kind, IntegrationErrorKind::TimeTooCoarse { .. }), "{error}");
            assert_eq!(error.time, start);
        }
    }
    // At the distance of the numbers there, or at once.
    for (step, steps) in [(4.0, 25), (100.0, 1), (1e3, 1)] {
        let end = run.fixed_step(step).run_to_end(q0, z0, 1e16..1e16 + 100.0).expect("runs");
        assert_eq!((end.t, end.summary.steps), (1e16 + 100.0, steps));
    }
    let refused = run.adaptive(1e-9, 1e-9).run_to_end(q0, z0, 1e16..1e16 + 100.0).expect_err("refused").kind;
    assert!(matches!(refused, IntegrationErrorKind::TimeTooCoarse { .. }), "{refused}");
}

#[test]
fn a_list_of_functions_has_the_events_of_that_many_calls() {
    let (q0, z0) = origin();
    let above = |level: f64| move |_: f64, q: &One, _: &One| q[0] - level;
    let simulation = || Simulation::new(&SPRING).input(undriven);
    let listed = simulation().event_each(Crossing::Any, [0.2, 0.5].map(above).to_vec());
    let called = simulation().event(Crossing::Any, above(0.2)).event(Crossing::Any, above(0.5));
    let listed = listed.fixed_step(0.5).run(q0, z0, 0.0..3.0).expect("runs");
    let called = called.fixed_step(0.5).run(q0, z0, 0.0..3.0).expect("runs");
    assert_eq!((listed.stopped_by(), listed.last().t), (None, 3.0));
    let [listed, called] =
        [listed, called].map(|run| run.events().iter().map(|e| (e.number, e.sample.t)).collect::<Vec<_>>());
    assert!(listed.len() >= 3 && listed == called);
}

#[test]
fn a_list_of_functions_ends_a_run_as_that_many_calls_do() {
    let (q0, z0) = origin();
    let above = |level: f64| move |_: f64, q: &One, _: &One| q[0] - level;
    let levels = [0.9, 0.3, 0.6];
    let simulation = || Simulation::new(&SPRING).input(undriven).event(Crossing::Any, above(0.2));
    let listed = simulation().until_each(Crossing::Rising, levels.map(above).to_vec()).event(Crossing::Any, above(0.1));
    let listed = listed.fixed_step(0.5).run(q0, z0, 0.0..3.0).expect("runs");
    let called = simulation().until(Crossing::Rising, above(0.9)).until(Crossing::Rising, above(0.3));
    let called = called.until(Crossing::Rising, above(0.6)).event(Crossing::Any, above(0.1));
    let called = called.fixed_step(0.5).run(q0, z0, 0.0..3.0).expect("runs");
    // 0.3 is the third of all, and those before and after the list are numbered with it.
    assert_eq!((listed.stopped_by(), called.stopped_by()), (Some(2), Some(2)));
    let seen: Vec<_> = listed.events().iter().map(|event| event.number).collect();
    assert_eq!(seen, [4, 0, 2]);
    assert_eq!((listed.last().t, listed.last().q), (called.last().t, called.last().q));
    // An empty list ends nothing.
    let none: Vec<fn(f64, &One, &One) -> f64> = Vec::new();
    let run = Simulation::new(&SPRING).input(undriven).until_each(Crossing::Any, none);
    assert_eq!(run.fixed_step(0.5).run(q0, z0, 0.0..3.0).expect("runs").last().t, 3.0);
}
