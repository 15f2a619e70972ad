//! Runs step by step are the runs as a whole, to the last bit.

use alloc::vec::Vec;
use core::cell::{Cell, RefCell};

use nalgebra::SVector;

use super::*;
use crate::integrate::problem::input::Feedback;
use crate::integrate::{
    Adams, Adaptive, Classical4, Compensated, Crossing, DormandPrince5, Fixed, RungeKutta, Simulation, Tableau,
};
use crate::testing::FreeTop;
use crate::testing::coasting::Coasting;
use crate::testing::order::{TOP, TORQUE, start_by_velocity};

type Pair = SVector<f64, 2>;
type Particle = Coasting<Pair>;
type Top = FreeTop<f64>;

/// Under weight.
const PARTICLE: Particle = Coasting { push: Pair::new(0.0, -9.81), drag: 0.1 };

const START: (Pair, Pair) = (Pair::new(0.0, 1.0), Pair::new(0.5, 0.0));

fn bits(sample: &Sample<Top>) -> Vec<u64> {
    [sample.t].iter().chain(sample.q.coords.iter()).chain(&sample.z).chain(&sample.p).map(|x| x.to_bits()).collect()
}

fn numbers(sample: &Sample<Particle>) -> [u64; 7] {
    let Sample { t, q, z, p } = sample;
    [*t, q[0], q[1], z[0], z[1], p[0], p[1]].map(f64::to_bits)
}

/// Does something with every kind of control.
macro_rules! every_control {
    ($check:ident($($argument:expr),*)) => {
        $check(Fixed::new(0.07), $($argument),*);
        $check(Fixed::by(RungeKutta(Classical4), 0.02), $($argument),*);
        $check(Fixed::by(RungeKutta(DormandPrince5), 0.05), $($argument),*);
        $check(Compensated::with(&Tableau::RK4, 0.02), $($argument),*);
        $check(Adaptive::new(1e-9, 1e-9), $($argument),*);
        $check(Adaptive::by(RungeKutta(DormandPrince5), 1e-6, 1e-6), $($argument),*);
        // With room for half of the steps, a last step of another length, and as many steps as begin a run.
        $check(Adams::<_, 10>::new(0.023), $($argument),*);
        $check(Adams::<_, 4>::new(0.02), $($argument),*);
        $check(Adams::<_, 12>::new(0.3), $($argument),*);
    };
}

#[test]
fn steps_have_the_bits_of_the_run_whatever_is_asked_between_them() {
    fn check(control: impl Control<Top> + Copy, interval: &Range<f64>) {
        let State { q, y: z, .. } = start_by_velocity();
        let simulation = Simulation::new(&TOP).input_from(TORQUE).control(control);
        let whole = simulation.run(q, z, interval.clone()).expect("runs");
        let mut run = simulation.stepper(q, z, interval.clone()).expect("begins");
        assert_eq!(bits(&run.state()), bits(whole.first()));
        for n in 1..whole.len() {
            let (before, outcome) = (run.time(), run.step().expect("a step"));
            assert_eq!(outcome, if n + 1 == whole.len() { StepOutcome::End } else { StepOutcome::Step });
            assert_eq!(bits(&run.state()), bits(&whole.samples()[n]), "step {n}");
            // What is asked, or made of a copy, changes nothing.
            let between = 0.7 * before + 0.3 * run.time();
            assert_eq!(bits(&run.at(between).expect("inside")), bits(&whole.at(between).expect("inside")));
            assert_eq!(bits(&run.at(before).expect("inside")), bits(&whole.samples()[n - 1]));
            run.clone().step().expect("another one");
        }
        assert_eq!((run.is_over(), run.stopped_by(), run.summary()), (true, None, whole.summary()));
        assert_eq!(run.step(), Ok(StepOutcome::End));
        assert_eq!(bits(&run.state()), bits(whole.last()));
    }
    every_control!(check(&(0.0..2.0)));
    every_control!(check(&(1.0..-1.0)));
}

#[test]
fn events_and_jumps_are_those_of_the_run() {
    fn check(control: impl Control<Particle> + Copy, every: u64) {
        let seen = RefCell::new(Vec::new());
        let simulation = || {
            Simulation::new(&PARTICLE)
                .observe(|sample| seen.borrow_mut().push(numbers(sample)))
                .event(Crossing::Falling, |_, q: &Pair, _| q[1])
                .then(|state| state.z[1] *= -0.8)
                .event(Crossing::Any, |_, _, z: &Pair| z[1])
                .until(Crossing::Rising, |_, q: &Pair, _| q[0] - 0.9)
                .control(control)
                .every(every)
        };
        let (q, z) = START;
        let whole = simulation().run(q, z, 0.0..3.0).expect("runs");
        let expected = seen.take();
        let mut run = simulation().stepper(q, z, 0.0..3.0).expect("begins");
        let mut jumps = 0;
        let last = loop {
            match run.step().expect("a step") {
                StepOutcome::Step => {}
                StepOutcome::Jump(number) => {
                    // The state is the one after the jump, in which it rises.
                    assert!(number == 0 && run.state().z[1] > 0.0);
                    jumps += 1;
                }
                last => break last,
            }
        };
        assert_eq!((last, run.stopped_by()), (StepOutcome::Stop(2), Some(2)));
        assert!(jumps > 1 && jumps == whole.summary().jumps);
        assert_eq!(run.summary(), whole.summary());
        assert_eq!(seen.take(), expected);
        assert_eq!(numbers(&run.state()), numbers(whole.last()));
        assert_eq!(run.step(), Ok(StepOutcome::Stop(2)));
    }
    for every in [1, 3] {
        check(Adaptive::new(1e-9, 1e-9), every);
        check(Fixed::new(0.05), every);
        check(Adams::<_, 6>::new(0.01), every);
    }
}

#[test]
fn a_clone_goes_on_from_where_it_was_made() {
    fn check(control: impl Control<Top> + Copy) {
        let State { q, y: z, .. } = start_by_velocity();
        let mut run =
            Simulation::new(&TOP).input_from(TORQUE).control(control).stepper(q, z, 0.0..5.0).expect("begins");
        for _ in 0..9 {
            run.step().expect("a step");
        }
        let checkpoint = run.clone();
        let to_the_end = |mut run: Stepper<_, _, _, _>| {
            let mut ends = Vec::new();
            while !run.is_over() {
                run.step().expect("a step");
                ends.push(bits(&run.state()));
            }
            ends
        };
        let (one, other) = (to_the_end(run), to_the_end(checkpoint));
        assert!(one.len() > 3 && one == other);
    }
    every_control!(check());
}

#[test]
fn states_that_are_reached_are_those_of_the_run() {
    let State { q, y: z, .. } = start_by_velocity();
    let simulation = Simulation::new(&TOP).input_from(TORQUE).adaptive(1e-9, 1e-9);
    for interval in [0.0..2.0, 2.0..0.0] {
        let whole = simulation.run(q, z, interval.clone()).expect("runs");
        let mut run = simulation.stepper(q, z, interval.clone()).expect("begins");
        // Frames of a sixtieth, many to a step.
        for frame in 0..=120 {
            let t = interval.start + (interval.end - interval.start) * f64::from(frame) / 120.0;
            assert_eq!(bits(&run.reach(t).expect("inside")), bits(&whole.at(t).expect("inside")), "{t}");
        }
        // Behind the last step, and beyond the end.
        let direction = interval.end - interval.start;
        for t in [interval.start, interval.end + 0.1 * direction, f64::NAN] {
            let error = run.reach(t).expect_err("outside");
            assert!(matches!(error.kind, IntegrationErrorKind::OutsideRun { .. }), "{error}");
        }
    }
}

/// A state that is set, or an input that has changed, begins a run anew: with the bits of a run that begins there.
#[test]
fn what_is_changed_between_steps_begins_anew() {
    fn check(control: impl Control<Top> + Copy) {
        let State { q, y: z, .. } = start_by_velocity();
        let size = Cell::new(1.0);
        let torque = |t: f64, q: &_, z: &_| {
            let of_top: [f64; 3] = crate::integrate::InputSource::<Top>::input(&TORQUE, t, q, z);
            of_top.map(|torque| size.get() * torque)
        };
        let simulation = Simulation::new(&TOP).input_from(Feedback(&torque)).control(control);
        let mut run = simulation.stepper(q, z, 0.0..2.0).expect("begins");
        let same = |run: &mut Stepper<_, _, _, _>, from: &Sample<Top>| {
            let alone = simulation.run(from.q, from.z, from.t..2.0).expect("runs");
            for expected in &alone.samples()[1..4] {
                run.step().expect("a step");
                assert_eq!(bits(&run.state()), bits(expected));
            }
        };
        run.step().expect("a step");
        let turned = Sample { z: -run.state().z, ..run.state() };
        run.set_state(turned.q, turned.z).expect("a state");
        same(&mut run, &turned);
        size.set(-3.0);
        let now = run.state();
        run.renew().expect("the same state");
        assert_eq!(bits(&run.state()), bits(&now));
        same(&mut run, &now);
        // Only the step behind it can be asked for.
        run.renew().expect("the same state");
        assert!(run.at(run.time()).is_ok() && run.at(run.time() - 1e-6).is_err());
    }
    check(Fixed::new(0.07));
    check(Fixed::by(RungeKutta(DormandPrince5), 0.05));
    check(Compensated::with(&Tableau::RK4, 0.02));
    check(Adaptive::new(1e-9, 1e-9));
    check(Adams::<_, 10>::new(0.02));
}

/// An event is passed from the side on which the state was set.
#[test]
fn events_have_the_side_of_the_state_that_was_set() {
    let simulation = Simulation::new(&PARTICLE).until(Crossing::Falling, |_, q: &Pair, _| q[1]);
    let mut run = simulation.fixed_step(0.125).stepper(START.0, START.1, 0.0..4.0).expect("begins");
    assert_eq!(run.step(), Ok(StepOutcome::Step));
    // Below zero it only falls on; from there upward it passes, and passes zero on its way down.
    run.set_state(Pair::new(0.0, -1.0), Pair::new(0.0, 0.0)).expect("a state");
    assert_eq!(run.step(), Ok(StepOutcome::Step));
    run.set_state(Pair::new(0.0, -1.0), Pair::new(0.0, 8.0)).expect("a state");
    let (mut highest, mut outcome) = (f64::NEG_INFINITY, StepOutcome::Step);
    while outcome == StepOutcome::Step {
        outcome = run.step().expect("a step");
        highest = highest.max(run.state().q[1]);
    }
    assert!(outcome == StepOutcome::Stop(0) && highest > 1.0);
    // Zeros are found to some roundings of a step, here of 7 m/s.
    assert!(run.state().q[1].abs() < 1e-13 && run.state().z[1] < 0.0);
}

#[test]
fn errors_are_those_of_the_run_and_stay() {
    let (q, z) = START;
    let limited = Simulation::new(&PARTICLE).max_steps(7).adaptive(1e-9, 1e-9).first_step(1e-3);
    let (path, expected) = limited.attempt(q, z, 0.0..100.0);
    let mut run = limited.stepper(q, z, 0.0..100.0).expect("begins");
    let error = loop {
        if let Err(error) = run.step() {
            break error;
        }
    };
    assert_eq!(Some(&error), expected.as_ref());
    assert_eq!(numbers(&run.state()), numbers(path.last()));
    assert_eq!(run.step(), Err(error));
    assert_eq!(numbers(&run.state()), numbers(path.last()));
    // A function without a value ends it at the last state that has one.
    let undefined = Simulation::new(&PARTICLE).event(Crossing::Any, |_, q: &Pair, _| (q[1] - 0.9).sqrt());
    let (path, expected) = undefined.fixed_step(0.05).attempt(q, z, 0.0..1.0);
    let mut run = undefined.fixed_step(0.05).stepper(q, z, 0.0..1.0).expect("begins");
    let error = loop {
        if let Err(error) = run.step() {
            break error;
        }
    };
    assert_eq!(Some(error), expected);
    assert_eq!(numbers(&run.state()), numbers(path.last()));
}

#[test]
fn runs_that_cannot_begin_say_why_and_those_of_no_length_are_over() {
    let (q, z) = START;
    let begin = |step: f64, end: f64| Simulation::new(&PARTICLE).max_steps(10).fixed_step(step).stepper(q, z, 0.0..end);
    let refused = |step, end| begin(step, end).map(|_| ()).expect_err("refused").kind;
    assert!(matches!(refused(0.0, 1.0), IntegrationErrorKind::InvalidStep { .. }));
    assert!(matches!(refused(0.01, 1.0), IntegrationErrorKind::TooManySteps { limit: 10 }));
    assert_eq!(refused(0.1, f64::NAN), IntegrationErrorKind::InvalidInterval);
    let mut run = begin(0.1, 0.0).expect("of no length");
    assert!(run.is_over() && run.step() == Ok(StepOutcome::End));
    assert_eq!(numbers(&run.state()), numbers(&run.at(0.0).expect("the start")));
    run.set_state(z, q).expect("a state");
    assert!(run.is_over() && run.state().q == z);
}
