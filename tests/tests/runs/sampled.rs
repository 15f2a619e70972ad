//! Controllers that sample, against loops of runs and closed forms.

use std::cell::{Cell, RefCell};

use gauss_runtime::dual::Dual;
use gauss_runtime::integrate::problem::input::InputSource;
use gauss_runtime::integrate::{Controller, SamplingMistake};
use gauss_runtime::monitor::power_balance;
use gauss_runtime::prelude::*;
use gauss_tables::Tabulate;

type One = SVector<f64, 1>;

/// A pole on a cart; the angle is from upright.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, theta),
    particle(mass = 1, position = [x, 0, 0]),
    particle(mass = 0.2, position = [x + 0.6 * sin(theta), 0, 0.6 * cos(theta)]),
    input(push),
    drive(x = push),
)]
struct CartPole {
    #[gauss(gravity)]
    g: f64,
}

/// ẍ = push/m.
#[derive(GaussDynamics)]
#[gauss(coordinates(x), particle(mass = m, position = [x, 0, 0]), input(push), drive(x = push))]
struct Cart<T> {
    m: T,
}

/// A point on a ring, as a constraint, pushed along x.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y),
    particle(mass = 1, position = [x, y, 0]),
    constraint(position = x * x + y * y - 1),
    input(push),
    drive(x = push),
)]
struct Ring {
    #[gauss(gravity)]
    g: f64,
}

/// Gains that hold the pole, with an integral of x: a state of its own.
#[derive(Clone)]
struct Regulator {
    integral: f64,
    calls: Vec<f64>,
}

impl Regulator {
    fn new() -> Self {
        Self { integral: 0.0, calls: Vec::new() }
    }

    fn push(&mut self, t: f64, q: &SVector<f64, 2>, z: &SVector<f64, 2>) -> One {
        self.calls.push(t);
        self.integral += q[0] * 0.02;
        One::new(10.0 * q[0] + 60.0 * q[1] + 12.0 * z[0] + 12.0 * z[1] + self.integral)
    }
}

impl Controller<CartPoleKernel> for Regulator {
    fn start(&mut self) {
        *self = Self::new();
    }

    fn sample(&mut self, t: f64, q: &SVector<f64, 2>, z: &SVector<f64, 2>) -> One {
        self.push(t, q, z)
    }
}

fn bits<const N: usize, const M: usize>(q: &SVector<f64, N>, z: &SVector<f64, M>) -> Vec<u64> {
    q.iter().chain(z.iter()).map(|number| number.to_bits()).collect()
}

const SAMPLES: u32 = 100;
const PERIOD: f64 = 0.02;

/// What users wrote: a run from sample to sample.
macro_rules! by_a_loop {
    ($kernel:expr, $start:expr, |$run:ident| $steps:expr) => {{
        let (mut law, (mut q, mut z)) = (Regulator::new(), $start);
        let mut states = vec![(0.0, q, z)];
        for n in 0..SAMPLES {
            let held = law.push(PERIOD * f64::from(n), &q, &z);
            let $run = Simulation::new($kernel).input(move |_t, _q, _z| held);
            let end = $steps.run_to_end(q, z, PERIOD * f64::from(n)..PERIOD * f64::from(n + 1)).expect("runs");
            (q, z) = (end.q, end.z);
            states.push((PERIOD * f64::from(n + 1), q, z));
        }
        (states, law.calls)
    }};
}

/// One run has the bits of a loop of runs with the same steps, at each instant; whatever is kept, and every time.
macro_rules! the_bits_of_a_loop {
    ($kernel:expr, $start:expr, |$run:ident| $steps:expr) => {{
        let end = PERIOD * f64::from(SAMPLES);
        let (states, calls) = by_a_loop!($kernel, $start, |$run| $steps);
        let mut law = Regulator::new();
        let $run = Simulation::new($kernel).sampled(PERIOD, |t, q, z| law.push(t, q, z));
        let all = $steps.run($start.0, $start.1, 0.0..end).expect("runs");
        for (t, q, z) in &states {
            let at = all.iter().filter(|sample| sample.t == *t).collect::<Vec<_>>();
            assert_eq!(at.len(), 1, "one sample at {t}");
            assert_eq!(bits(&at[0].q, &at[0].z), bits(q, z), "{t}");
        }
        let last = bits(&all.last().q, &all.last().z);
        for every in [1, 7] {
            let $run = Simulation::new($kernel).sampled_by(PERIOD, Regulator::new()).every(every);
            let mut boxed = $steps.boxed();
            for _ in 0..2 {
                let kept = boxed.run($start.0, $start.1, 0.0..end).expect("runs");
                assert_eq!(bits(&kept.last().q, &kept.last().z), last);
                assert_eq!(kept.summary(), all.summary());
                assert_eq!(kept.len() as u64, kept.summary().steps.div_ceil(every) + 1);
            }
            let end = boxed.run_to_end($start.0, $start.1, 0.0..end).expect("runs");
            assert_eq!(bits(&end.q, &end.z), last);
        }
        assert_eq!(law.calls, calls);
    }};
}

fn pole() -> (CartPoleKernel, (SVector<f64, 2>, SVector<f64, 2>)) {
    (CartPole { g: 9.81 }.kernel().expect("a pole"), (SVector::from([0.0, 0.3]), SVector::zeros()))
}

#[test]
fn one_run_has_the_bits_of_a_loop_of_runs() {
    let (kernel, start) = pole();
    the_bits_of_a_loop!(&kernel, start, |run| run.fixed_step(0.005));
    // The last step of an interval is a short one.
    the_bits_of_a_loop!(&kernel, start, |run| run.fixed_step(0.007));
    the_bits_of_a_loop!(&kernel, start, |run| run.adaptive(1e-9, 1e-9));
    // In momentum form a loop changes between momenta and speeds at each instant, and the run does not.
    let (states, _) = by_a_loop!(&kernel, start, |run| run.momentum_form().adaptive(1e-9, 1e-9));
    let run = Simulation::new(&kernel).momentum_form().sampled_by(PERIOD, Regulator::new()).adaptive(1e-9, 1e-9);
    let end = run.run_to_end(start.0, start.1, 0.0..2.0).expect("runs");
    let (_, q, z) = states[SAMPLES as usize];
    // Roundings of numbers up to 10 that change the steps within their tolerances, a few hundred of which are made.
    assert!((end.q - q).amax().max((end.z - z).amax()) < 1e-9 * 10.0 * 300.0);
}

#[test]
fn states_between_have_the_input_that_was_held() {
    let (kernel, start) = pole();
    for every in [1, 5, 1000] {
        let run = Simulation::new(&kernel).sampled_by(PERIOD, Regulator::new()).fixed_step(0.006).every(every);
        let run = run.run(start.0, start.1, 0.0..2.0).expect("runs");
        let (states, _) = by_a_loop!(&kernel, start, |run| run.fixed_step(0.006));
        for (n, (from, q, z)) in states.iter().enumerate().take(SAMPLES as usize) {
            let held = run.input(*from, q, z);
            for part in [0.3, 0.9] {
                let t = from + part * PERIOD;
                assert_eq!(run.input(t, q, z), held, "until the next instant it is held");
                let alone = Simulation::new(&kernel).input(|_t, _q, _z| held).fixed_step(0.006);
                let (alone, found) = (alone.run_to_end(*q, *z, *from..t).expect("runs"), run.at(t).expect("inside"));
                // The same steps of numbers up to 10 (rates), some hundred operations each, from states that for
                // `every` beyond one are found anew: roundings of 2000 operations a sample.
                let apart = (found.q - alone.q).amax().max((found.z - alone.z).amax());
                let bound = 10.0 * f64::EPSILON * if every == 1 { 400.0 } else { 2000.0 * (n + 1) as f64 };
                assert!(apart <= bound, "{every} {t}: {apart:e}");
            }
        }
    }
}

/// ẍ = u with what is held: exact but for rounding.
struct Parabola {
    x: f64,
    v: f64,
}

impl Parabola {
    fn hold(&mut self, u: f64, h: f64) {
        self.x += h * self.v + 0.5 * h * h * u;
        self.v += h * u;
    }
}

/// Roundings of some hundred intervals with a few steps of a few dozen operations, on numbers up to 4.
const ROUNDING: f64 = 4.0 * 100.0 * 100.0 * f64::EPSILON;

#[test]
fn delays_by_samples_and_by_time() {
    let kernel = Cart { m: 1.0 }.kernel().expect("a cart");
    let law = |x: f64, v: f64| -x - 1.2 * v;
    let start = (One::new(1.0), One::new(0.0));
    for (whole, part) in [(0_usize, 0.0), (1, 0.0), (3, 0.0), (0, 0.03), (2, 0.03)] {
        let simulation = Simulation::new(&kernel).sampled(0.1, |_t, q, z| One::new(law(q[0], z[0])));
        let delayed = if part == 0.0 {
            simulation.delayed_samples(whole as u32)
        } else {
            simulation.delayed(whole as f64 * 0.1 + part)
        };
        let run =
            delayed.initially(One::new(0.5)).adaptive(1e-12, 1e-12).run(start.0, start.1, 0.0..5.0).expect("runs");
        let (mut body, mut given) = (Parabola { x: 1.0, v: 0.0 }, vec![0.5; whole + 1]);
        for n in 0..50 {
            let input = law(body.x, body.v);
            if part == 0.0 {
                given.push(input);
                body.hold(given[given.len() - 1 - whole], 0.1);
            } else {
                body.hold(given[given.len() - 1 - whole], part);
                given.push(input);
                body.hold(given[given.len() - 1 - whole], 0.1 - part);
            }
            let found = run.at(0.1 * f64::from(n + 1)).expect("inside");
            let apart = (found.q[0] - body.x).abs().max((found.z[0] - body.v).abs());
            assert!(apart < ROUNDING, "{whole} {part} {n}: {apart:e}");
        }
        if part == 0.0 && whole > 0 {
            // Whole periods, said as a time, are samples: the same instants and bits.
            let simulation = Simulation::new(&kernel).sampled(0.1, |_t, q, z| One::new(law(q[0], z[0])));
            let by_time = simulation.delayed(whole as f64 * 0.1).initially(One::new(0.5)).adaptive(1e-12, 1e-12);
            let by_time = by_time.run(start.0, start.1, 0.0..5.0).expect("runs");
            assert_eq!(by_time.len(), run.len());
            assert_eq!(bits(&by_time.last().q, &by_time.last().z), bits(&run.last().q, &run.last().z));
        }
    }
}

#[test]
fn several_rates_and_a_gust_add_up() {
    let kernel = Cart { m: 1.0 }.kernel().expect("a cart");
    // A goal every 0.5 s for a loop every 0.1 s; a push every 0.2 s; a gust 0.6 t.
    let (goal, seen) = (Cell::new(9.0), RefCell::new(Vec::new()));
    let run = Simulation::new(&kernel)
        .input(|t, _q, _z| One::new(0.6 * t))
        .sampled(0.5, |t, _q, _z| {
            goal.set(1.0 + t);
            seen.borrow_mut().push((t, 'g'));
            One::zeros()
        })
        .sampled(0.1, |t, q, z| {
            seen.borrow_mut().push((t, 'l'));
            One::new(4.0 * (goal.get() - q[0]) - 3.0 * z[0])
        })
        .sampled(0.2, |t, q, _z| One::new(-0.1 * q[0] + t))
        .fixed_step(0.1)
        .run(One::zeros(), One::zeros(), 0.0..2.0)
        .expect("runs");
    assert_eq!(run.len(), 21);
    let (mut body, mut slow) = (Parabola { x: 0.0, v: 0.0 }, 0.0);
    for n in 0..20 {
        let t = 0.1 * f64::from(n);
        let goal = 1.0 + 0.5 * f64::from(n / 5);
        if n % 2 == 0 {
            slow = -0.1 * body.x + t;
        }
        let u = 4.0 * (goal - body.x) - 3.0 * body.v + slow;
        // The gust: ẍ = 0.6 t, so that ∫ is 0.3 t² and ∫∫ from t is 0.3 h² t + 0.1 h³.
        let h = 0.1;
        body.hold(u + 0.6 * t, h);
        (body.x, body.v) = (body.x + 0.1 * h * h * h, body.v + 0.3 * h * h);
        let found = run.at(0.1 * f64::from(n + 1)).expect("inside");
        let apart = (found.q[0] - body.x).abs().max((found.z[0] - body.v).abs());
        assert!(apart < ROUNDING, "{n}: {apart:e}");
    }
    // At the same time in the order in which they were added; the end is no instant.
    let seen = seen.borrow();
    assert_eq!(seen.iter().filter(|(_, who)| *who == 'g').count(), 4);
    assert_eq!(seen.len(), 24);
    assert_eq!((seen[0], seen[1], seen[6]), ((0.0, 'g'), (0.0, 'l'), (0.5, 'g')));
}

/// 30 · 0.005 is not 3 · 0.05: whoever was added first samples first, and no step of a rounding is between.
#[test]
fn instants_that_coincide_on_paper_are_one() -> Result<(), Box<dyn std::error::Error>> {
    let kernel = Cart { m: 2.0 }.kernel()?;
    for start in [0.0, 0.1, -7.3, 86_400.0] {
        for slow_first in [true, false] {
            let (calls, goal, seen) = (RefCell::new(String::new()), Cell::new(0), Cell::new(Vec::new()));
            let slow = |_t: f64, _q: &One, _z: &One| {
                calls.borrow_mut().push('s');
                goal.set(goal.get() + 1);
                One::zero()
            };
            let fast = |t: f64, _q: &One, _z: &One| {
                calls.borrow_mut().push('f');
                let mut times = seen.take();
                times.push((t, goal.get()));
                seen.set(times);
                One::zero()
            };
            let (q, z, span) = (One::zero(), One::zero(), start..start + 3.0);
            let run = Simulation::new(&kernel);
            let end = if slow_first {
                run.sampled(0.05, slow).sampled(0.005, fast).adaptive(1e-6, 1e-6).run_to_end(q, z, span)?
            } else {
                run.sampled(0.005, fast).sampled(0.05, slow).adaptive(1e-6, 1e-6).run_to_end(q, z, span)?
            };
            assert_eq!(end.t, start + 3.0);
            let period = if slow_first { "sffffffffff" } else { "fsfffffffff" };
            assert_eq!(*calls.borrow(), period.repeat(60), "from {start}");
            let seen = seen.take();
            assert!(seen.windows(2).all(|pair| pair[1].0 - pair[0].0 > 0.0049), "from {start}");
            for (n, (_, goal)) in seen.iter().enumerate() {
                let before = usize::from(!slow_first && n % 10 == 0);
                assert_eq!(*goal, n / 10 + 1 - before, "sample {n} from {start}");
            }
        }
    }
    Ok(())
}

#[test]
fn events_and_samples_in_one_run() {
    let kernel = Cart { m: 1.0 }.kernel().expect("a cart");
    // Away from a wall at 0 for a second, and then toward it, in units of 1 m/s²: it comes back to where it was after
    // (2 + √2) s; there it turns back with half of its speed √2.
    let law = |t: f64, _: &One, _: &One| One::new(if t < 0.999 { 1.0 } else { -1.0 });
    let run = Simulation::new(&kernel)
        .event(Crossing::Any, |t, _q, _z| t - 0.1 * 7.0) // at an instant
        .event(Crossing::Falling, |_t, q, _z| q[0])
        .then(|state| state.z[0] *= -0.5)
        .event(Crossing::Falling, |t, _q, _z| 4.0 - t) // a jump at an instant: the sample is that after it
        .then(|state| state.z[0] = 3.0)
        .sampled(0.1, law)
        .adaptive(1e-11, 1e-11)
        .run(One::zeros(), One::zeros(), 0.0..4.5)
        .expect("runs");
    let root = 2.0_f64.sqrt();
    let events = run.events().iter().map(|event| (event.number, event.sample.t)).collect::<Vec<_>>();
    assert_eq!(events.iter().map(|(number, _)| *number).collect::<Vec<_>>(), [0, 1, 2], "{events:?}");
    // Zeros are found to some roundings of the time.
    let expected = [0.1 * 7.0, 2.0 + root, 4.0];
    assert!(
        events.iter().zip(expected).all(|(event, t)| (event.1 - t).abs() < 64.0 * f64::EPSILON * 4.0),
        "{events:?}"
    );
    let flight = 4.0 - (2.0 + root);
    let height = 0.5 * root * flight - 0.5 * flight * flight + 3.0 * 0.5 - 0.5 * 0.25;
    assert!((run.last().q[0] - height).abs() < 1e-10 && (run.last().z[0] - 2.5).abs() < 1e-10);
    let double = run.iter().zip(run.iter().skip(1)).filter(|(a, b)| a.t == b.t).count();
    assert_eq!(double, 2, "samples on both sides of jumps, and nowhere else");

    let seen = Cell::new(0.0);
    let stopped = Simulation::new(&kernel)
        .until(Crossing::Rising, |t, _q, _z| t - 0.25)
        .sampled(0.1, |t, _q, _z| {
            seen.set(t);
            One::new(1.0)
        })
        .adaptive(1e-9, 1e-9)
        .run_to_end(One::zeros(), One::zeros(), 0.0..1.0)
        .expect("runs");
    assert_eq!((stopped.stopped_by, seen.get()), (Some(0), 0.2));
}

#[test]
fn constraints_hold_and_controllers_see_them() {
    let kernel = Ring { g: 9.81 }.kernel().expect("a ring");
    let law = |_t: f64, q: &SVector<f64, 2>, z: &SVector<f64, 2>| One::new(-20.0 * q[0] - 6.0 * z[0]);
    let (q, z) = (SVector::from([0.6, -0.8]), SVector::zeros());
    let run = Simulation::new(&kernel).sampled(0.05, law).adaptive(1e-10, 1e-10).run(q, z, 0.0..4.0).expect("runs");
    // Of squares of lengths 1, and of speeds below 4 times them.
    assert!(run.iter().all(|s| (s.q.norm() - 1.0).abs().max(s.q.dot(&s.z).abs()) < 16.0 * 4.0 * f64::EPSILON));
    assert!(run.last().q[0].abs() < 1e-2);
}

#[test]
fn derivatives_pass_through_samples() {
    type Number = Dual<1>;
    let kernel = Cart { m: Dual::variable(1.3, 0) }.kernel().expect("a cart");
    let number = Number::constant;
    let law = |_t: Number, q: &SVector<Number, 1>, z: &SVector<Number, 1>| {
        SVector::from([number(-1.0) * q[0] - number(1.2) * z[0]])
    };
    let (q, z) = (SVector::from([number(1.0)]), SVector::from([number(0.0)]));
    let run = Simulation::new(&kernel).sampled(0.1, law).fixed_step(number(0.05));
    let end = run.run_to_end(q, z, number(0.0)..number(2.0)).expect("runs");
    // The recursion of x, v in the same numbers.
    let (mut x, mut v, h) = (number(1.0), number(0.0), number(0.1));
    for _ in 0..20 {
        let a = (number(-1.0) * x - number(1.2) * v) / Dual::variable(1.3, 0);
        (x, v) = (x + h * v + number(0.5) * h * h * a, v + h * a);
    }
    let apart = (end.q[0].value - x.value).abs().max((end.q[0].slopes[0] - x.slopes[0]).abs());
    assert!(apart < ROUNDING && x.slopes[0].abs() > 0.1, "{apart:e}");
}

#[test]
fn what_cannot_be_sampled_is_refused() {
    let kernel = Cart { m: 1.0 }.kernel().expect("a cart");
    let give = |value: f64| move |_t: f64, _q: &One, _z: &One| One::new(value);
    let ends = |period: f64, delay: f64, value: f64, span: core::ops::Range<f64>| {
        let run = Simulation::new(&kernel).sampled(0.1, give(1.0)).sampled(period, give(value)).delayed(delay);
        run.adaptive(1e-9, 1e-9).max_steps(1000).run_to_end(One::zeros(), One::zeros(), span).map(|_| ())
    };
    let mistake = |result: Result<(), IntegrationError>| match result.expect_err("refused").kind {
        IntegrationErrorKind::Sampling { controller, mistake } => (controller, mistake),
        kind => panic!("{kind:?}"),
    };
    for period in [0.0, -0.1, f64::INFINITY] {
        assert_eq!(mistake(ends(period, 0.0, 1.0, 0.0..1.0)), (1, SamplingMistake::Period(period)));
    }
    assert!(matches!(mistake(ends(f64::NAN, 0.0, 1.0, 0.0..1.0)), (1, SamplingMistake::Period(_))));
    assert_eq!(mistake(ends(0.1, -0.1, 1.0, 0.0..1.0)), (1, SamplingMistake::Delay(-0.1)));
    assert_eq!(mistake(ends(0.1, 0.0, f64::NAN, 0.0..1.0)), (1, SamplingMistake::Input));
    assert_eq!(mistake(ends(0.1, 0.0, 1.0, 1.0..0.0)).1, SamplingMistake::Backward);
    let kind = |result: Result<(), IntegrationError>| result.expect_err("refused").kind;
    assert_eq!(kind(ends(1e-4, 0.0, 1.0, 0.0..1.0)), IntegrationErrorKind::TooManySteps { limit: 1000 });
    let coarse = kind(ends(0.1, 0.0, 1.0, 1e15..1e15 + 1.0));
    assert!(matches!(coarse, IntegrationErrorKind::TimeTooCoarse { .. }), "{coarse:?}");
    assert_eq!(kind(ends(0.1, 0.0, 1.0, 0.0..f64::NAN)), IntegrationErrorKind::InvalidInterval);
    assert!(ends(0.1, 0.0, 1.0, 0.5..0.5).is_ok());

    // An error in the middle leaves the run up to there, and says when.
    let late = |t: f64, _: &One, _: &One| One::new(if t > 0.45 { f64::INFINITY } else { 1.0 });
    let run = Simulation::new(&kernel).sampled(0.1, late).every(1000).fixed_step(0.1);
    let (path, error) = run.attempt(One::zeros(), One::zeros(), 0.0..1.0);
    let error = error.expect("it ends");
    assert_eq!((error.time, path.last().t), (0.5, 0.5));
    let text = "integration stopped at t = 0.5: controller 0 gave an input that is infinite or undefined";
    assert!(error.to_string().starts_with(text), "{error}");

    // What is given afterwards would take the place of the controller.
    let replaced = Simulation::new(&kernel).sampled(0.1, give(1.0)).input(give(2.0)).fixed_step(0.1);
    let replaced = replaced.run_to_end(One::zeros(), One::zeros(), 0.0..1.0).map(|_| ());
    assert_eq!(mistake(replaced), (0, SamplingMistake::Replaced));

    // Outside a run there is no input that anybody could take for one.
    let simulation = Simulation::new(&kernel).sampled(0.1, give(1.0));
    assert!(simulation.problem().input.input(0.0, &One::zeros(), &One::zeros())[0].is_nan());
}

#[test]
fn the_balance_of_energy_is_that_of_what_was_held() {
    let kernel = Cart { m: 1.0 }.kernel().expect("a cart");
    let law = |_t: f64, q: &One, z: &One| One::new(-4.0 * q[0] - z[0]);
    let run = Simulation::new(&kernel).sampled(0.1, law).adaptive(1e-9, 1e-9);
    let run = run.run(One::new(1.0), One::zeros(), 0.0..4.0).expect("runs");
    let balance = power_balance(&kernel, &run, |t, q, z| run.input(t, q, z));
    // The power is linear in time within a step: nothing but roundings of energies up to 4.
    assert!(balance.largest_residual() < 4.0 * 8.0 * f64::EPSILON * run.len() as f64, "{balance}");
    assert!(balance.points().iter().any(|point| point.work > 0.5), "{balance}");
}

#[test]
fn tables_tell_what_was_held() {
    let kernel = Cart { m: 1.0 }.kernel().expect("a cart");
    let run = Simulation::new(&kernel).sampled(0.5, |t, _q, _z| One::new(t)).delayed(0.25).fixed_step(0.25);
    let run = run.run(One::zeros(), One::zeros(), 0.0..2.0).expect("runs");
    let table = run.table().column("push", |s| run.input(s.t, &s.q, &s.z)[0]);
    let expected = [0.0, 0.0, 0.0, 0.5, 0.5, 1.0, 1.0, 1.5, 1.5];
    assert_eq!(table.get("push").expect("is there"), expected);
}
