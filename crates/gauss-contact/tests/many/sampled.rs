//! Controllers that sample, in runs with contacts: from event to event, in steps, in steps that keep a tolerance.

use std::cell::RefCell;

use gauss_contact::{ContactErrorKind, EventKind, WithContacts};
use gauss_runtime::integrate::{RunRecord, SamplingMistake};
use gauss_runtime::prelude::*;

/// A block on a floor that a motor pushes.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y), input(push), particle(mass = 2, position = [x, 0, y]), drive(x = push),
    contact(floor, gap = y, slip = rate(x), friction = 0.4), gravity = 10,
)]
struct Block {}

const PERIOD: f64 = 0.25;

/// Held for a period each: nothing, less than friction holds (8 N), more, nothing.
fn pushes(k: usize) -> f64 {
    [0.0, 6.0, 12.0, 0.0][k % 4]
}

/// The speed and the place at a time, by hand: from the third period on it is pushed by 4 N beyond friction for a
/// period, then slows down by friction until it stops.
fn by_hand(t: f64) -> [f64; 2] {
    let (pushed, slowed) = (2.0, 4.0);
    let (from, to) = (2.0 * PERIOD, 3.0 * PERIOD);
    let fastest = pushed * PERIOD;
    if t < from {
        [0.0, 0.0]
    } else if t < to {
        [pushed * (t - from), 0.5 * pushed * (t - from).powi(2)]
    } else {
        let left = (t - to).min(fastest / slowed);
        [fastest - slowed * left, 0.5 * pushed * PERIOD * PERIOD + fastest * left - 0.5 * slowed * left * left]
    }
}

type Seen = RefCell<Vec<(f64, f64)>>;

/// A law that counts, and remembers when it was asked and where the block was.
fn law(seen: &Seen) -> impl FnMut(f64, &SVector<f64, 2>, &SVector<f64, 2>) -> SVector<f64, 1> {
    move |t, q, _| {
        seen.borrow_mut().push((t, q[0]));
        SVector::from([pushes(seen.borrow().len() - 1)])
    }
}

/// At rest on the floor.
fn rest() -> [SVector<f64, 2>; 2] {
    [SVector::zeros(); 2]
}

fn instants_are_those_of_periods(seen: &Seen, near: f64) {
    let seen = seen.borrow();
    assert_eq!(seen.len(), 4);
    for (k, (t, x)) in seen.iter().enumerate() {
        assert!((t - PERIOD * k as f64).abs() < 1e-15 && (x - by_hand(*t)[1]).abs() < near, "{k}: {t} {x}");
    }
}

#[test]
fn from_event_to_event() {
    let (kernel, seen) = (Block {}.kernel().unwrap(), Seen::default());
    let run = Simulation::new(&kernel).sampled(PERIOD, law(&seen)).adaptive(1e-10, 1e-10).contact_events();
    let run = run.run(rest()[0], rest()[1], 0.0..1.0).unwrap();
    instants_are_those_of_periods(&seen, 1e-9);
    for t in [0.1, 0.3, 0.45, 0.6, 0.74, 0.8, 0.87, 0.9, 0.99] {
        let (state, [speed, place]) = (run.at(t).unwrap(), by_hand(t));
        assert!((state.z[0] - speed).abs() < 1e-9 && (state.q[0] - place).abs() < 1e-9, "{t}: {state:?}");
        // The force of friction is that of the push that was held then, also after the run.
        let friction = run.forces(t).unwrap()[1];
        let wanted = match t {
            t if t < PERIOD => 0.0,
            t if t < 2.0 * PERIOD => -6.0,
            t if t < 3.0 * PERIOD + 0.125 => -8.0,
            _ => 0.0,
        };
        assert!((friction - wanted).abs() < 1e-8, "{t}: {friction}");
    }
    let kinds: Vec<_> = run.events().iter().map(|event| (event.time, event.kind)).collect();
    let [(slides, EventKind::Slides(_)), (sticks, EventKind::Sticks)] = kinds[..] else { panic!("{kinds:?}") };
    assert!(slides == 2.0 * PERIOD && (sticks - 0.875).abs() < 1e-9);
}

#[test]
fn in_steps_of_any_length() {
    let kernel = Block {}.kernel().unwrap();
    // Instants are ends of steps, or cut one.
    for h in [1e-3, 0.7e-3, 0.011] {
        let seen = Seen::default();
        let run = Simulation::new(&kernel).sampled(PERIOD, law(&seen)).contact_steps(h);
        let run = run.run(rest()[0], rest()[1], 0.0..1.0).unwrap();
        // Places are off by what a step does not know: when within it the block stops.
        instants_are_those_of_periods(&seen, 4.0 * h * h);
        let end = run.samples.last().unwrap().state;
        assert!(end.t == 1.0 && end.z[0] == 0.0 && (end.q[0] - by_hand(1.0)[1]).abs() < 4.0 * h * h, "{h}: {end:?}");
        assert!((1..4).all(|k| run.samples.iter().any(|step| (step.state.t - PERIOD * k as f64).abs() < 1e-14)));
        assert!(run.samples.windows(2).all(|pair| pair[1].state.t > pair[0].state.t));
    }
    // Where instants are ends of steps the input is that of a closure that knows the time.
    let seen = Seen::default();
    let sampled = Simulation::new(&kernel).sampled(PERIOD, law(&seen)).contact_steps(PERIOD / 64.0);
    let sampled = sampled.run(rest()[0], rest()[1], 0.0..1.0).unwrap();
    let closure = |t: f64, _: &_, _: &_| SVector::from([pushes((t / PERIOD).floor() as usize)]);
    let closure = Simulation::new(&kernel).input(closure).contact_steps(PERIOD / 64.0);
    let closure = closure.run(rest()[0], rest()[1], 0.0..1.0).unwrap();
    assert_eq!(sampled.samples.len(), closure.samples.len());
    assert!(
        sampled.samples.iter().zip(&closure.samples).all(|(a, b)| (a.state.q, a.state.z) == (b.state.q, b.state.z))
    );
}

#[test]
fn in_steps_that_keep_a_tolerance() {
    let (kernel, seen) = (Block {}.kernel().unwrap(), Seen::default());
    let run = Simulation::new(&kernel).sampled(PERIOD, law(&seen)).contact_steps(0.1).adaptive(1e-6, 1e-6);
    let run = run.run(rest()[0], rest()[1], 0.0..1.0).unwrap();
    instants_are_those_of_periods(&seen, 1e-5);
    let end = run.samples.last().unwrap().state;
    assert!((end.q[0] - by_hand(1.0)[1]).abs() < 1e-5, "{end:?}");
}

#[test]
fn delays_and_functions_beside() {
    let kernel = Block {}.kernel().unwrap();
    let at = |run: &dyn Fn(f64) -> f64, delay: f64| {
        for t in [0.2, 0.4, 0.6, 0.8, 1.0] {
            let (found, wanted) = (run(t), by_hand(t - delay)[1]);
            assert!((found - wanted).abs() < 1e-4, "{t}: {found} for {wanted}");
        }
    };
    let (delay, still) = (0.0625, |_: f64, _: &_, _: &_| SVector::from([0.0]));
    let (a, b) = (Seen::default(), Seen::default());
    let events = Simulation::new(&kernel).input(still).sampled(PERIOD, law(&a)).delayed(delay);
    let events = events.adaptive(1e-9, 1e-9).contact_events().run(rest()[0], rest()[1], 0.0..1.0).unwrap();
    at(&|t| events.state_at(t).unwrap().q[0], delay);
    let steps = Simulation::new(&kernel).input(still).sampled(PERIOD, law(&b)).delayed(delay).contact_steps(1e-3);
    let steps = steps.run(rest()[0], rest()[1], 0.0..1.0).unwrap();
    at(&|t| steps.state_at(t).unwrap().q[0], delay);
}

#[test]
fn mistakes_end_the_run() {
    let kernel = Block {}.kernel().unwrap();
    let none = |_: f64, _: &_, _: &_| SVector::from([f64::NAN]);
    let wrong = |period: f64| {
        let events = Simulation::new(&kernel).sampled(period, none).adaptive(1e-9, 1e-9).contact_events();
        let steps = Simulation::new(&kernel).sampled(period, none).contact_steps(1e-3);
        let events = events.run(rest()[0], rest()[1], 0.0..1.0).map(|_| ()).unwrap_err();
        (events, steps.run(rest()[0], rest()[1], 0.0..1.0).map(|_| ()).unwrap_err())
    };
    for (period, mistake) in [(0.1, SamplingMistake::Input), (0.0, SamplingMistake::Period(0.0))] {
        let (events, steps) = wrong(period);
        for error in [events, steps] {
            let kind = IntegrationErrorKind::Sampling { controller: 0, mistake };
            assert_eq!((error.time, error.kind), (0.0, ContactErrorKind::Sampling(kind)));
        }
    }
}
