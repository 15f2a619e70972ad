//! Events, jumps and sampled controllers, each through what is done with a run.

use gauss_batch::{Batch, States};
use gauss_playback::{Playback, Shape};
use gauss_runtime::integrate::drive::event::Events;
use gauss_runtime::integrate::drive::observer::Unobserved;
use gauss_runtime::integrate::{Control, Fixed, Problem, StepOutcome};
use gauss_runtime::monitor::power_balance;
use gauss_runtime::prelude::*;
use gauss_runtime::simd::Lanes;
use gauss_study::{Declaration, uniform};
use gauss_tables::Tabulate;

use crate::scenes::{Pushed, PushedKernel};

type One<T = f64> = SVector<T, 1>;
type Kernel = PushedKernel<f64>;

/// A spring of 20 N/m on 1.5 kg, let go at 0.3 m: it passes zero at some 0.45 s.
const STIFFNESS: f64 = 20.0;
const START: f64 = 0.3;

fn push<T: Real>(t: T, _: &One<T>, z: &One<T>) -> One<T> {
    One::new((t + t).sin() - z[0] * T::from_f64(0.1))
}

/// Half of the speed is lost where the mass passes zero.
fn slowed<T: Real>(sample: &mut Sample<PushedKernel<T>>) {
    sample.z[0] *= T::from_f64(0.5);
}

/// Something that happens in a run of one second.
pub trait Happening {
    fn simulation<C>(
        kernel: &Kernel,
        control: C,
    ) -> Simulation<impl Problem<System = Kernel> + '_, C, Unobserved, impl Events<Kernel>>;

    fn run<C: Control<Kernel> + 'static>(kernel: &Kernel, start: f64, control: C) -> Trajectory<'_, Kernel> {
        Self::simulation(kernel, control).run(One::new(start), One::zeros(), 0.0..1.0).unwrap()
    }
}

/// The mass passes zero.
pub struct Event;

impl Happening for Event {
    fn simulation<C>(
        kernel: &Kernel,
        control: C,
    ) -> Simulation<impl Problem<System = Kernel> + '_, C, Unobserved, impl Events<Kernel>> {
        let run = Simulation::new(kernel).input(push).event(Crossing::Falling, |_, q: &One, _| q[0]);
        run.control(control)
    }
}

/// It loses half of its speed there.
pub struct Jump;

impl Happening for Jump {
    fn simulation<C>(
        kernel: &Kernel,
        control: C,
    ) -> Simulation<impl Problem<System = Kernel> + '_, C, Unobserved, impl Events<Kernel>> {
        let run = Simulation::new(kernel).input(push).event(Crossing::Falling, |_, q: &One, _| q[0]);
        run.then_through(slowed).control(control)
    }
}

/// A controller asks every tenth of a second where it is.
pub struct Sampled;

impl Happening for Sampled {
    fn simulation<C>(
        kernel: &Kernel,
        control: C,
    ) -> Simulation<impl Problem<System = Kernel> + '_, C, Unobserved, impl Events<Kernel>> {
        let run = Simulation::new(kernel).input(push).sampled(0.1, |_, q: &One, z: &One| -2.0 * q - z);
        run.control(control)
    }
}

fn kernel() -> Kernel {
    Pushed { k: STIFFNESS }.kernel().unwrap()
}

fn exact<H: Happening>(kernel: &Kernel) -> Trajectory<'_, Kernel> {
    H::run(kernel, START, Adaptive::new(1e-12, 1e-13))
}

fn apart(a: &Sample<Kernel>, b: &Sample<Kernel>) -> f64 {
    (a.q - b.q).amax().max((a.z - b.z).amax())
}

/// Rosenbrock's method at 1e-8 over some hundred steps; an event is found to the error of its step.
pub fn stiff<H: Happening>(_: &H) {
    let kernel = kernel();
    let run = H::run(&kernel, START, Adaptive::by(Rosenbrock, 1e-8, 1e-9));
    let apart = apart(run.last(), exact::<H>(&kernel).last());
    assert!(apart < 1e-5, "{apart:e}");
}

/// Collocation of order 6, h ω = 0.07.
pub fn implicit<H: Happening>(_: &H) {
    let kernel = kernel();
    let run = H::run(&kernel, START, Fixed::by(Collocation::order_6(), 0.02));
    let apart = apart(run.last(), exact::<H>(&kernel).last());
    assert!(apart < 1e-8, "{apart:e}");
}

/// Steps one at a time have the bits of the run: of its samples, one for each step and two where the state jumps.
pub fn one_by_one<H: Happening>(_: &H) {
    fn check<H: Happening>(control: impl Control<Kernel> + Copy + 'static) {
        let kernel = kernel();
        let whole = H::run(&kernel, START, control);
        let mut run = H::simulation(&kernel, control).stepper(One::new(START), One::zeros(), 0.0..1.0).unwrap();
        let (mut at, mut outcome) = (0, StepOutcome::Step);
        while outcome != StepOutcome::End {
            outcome = run.step().unwrap();
            at += if outcome == StepOutcome::Jump(0) { 2 } else { 1 };
            assert_eq!(apart(&run.state(), &whole.samples()[at]), 0.0);
            let (begin, end) = (whole.samples()[at - 1].t, whole.samples()[at].t);
            let between = 0.5 * (begin + end);
            if outcome == StepOutcome::Step {
                assert_eq!(apart(&run.at(between).unwrap(), &whole.at(between).unwrap()), 0.0);
            }
        }
        assert_eq!((at + 1, run.summary()), (whole.len(), whole.summary()));
    }
    check::<H>(Adaptive::new(1e-9, 1e-10));
    check::<H>(Fixed::new(0.03));
}

/// A row for each sample with its numbers, also of both at one time where the state jumps; and a picture of them.
pub fn table_and_plot<H: Happening>(_: &H) {
    let kernel = kernel();
    let run = exact::<H>(&kernel);
    let table = run.table().state().energies(&kernel);
    let columns = ["x", "x_dot"].map(|name| table.get(name).unwrap_or_else(|| panic!("no column {name}")));
    for (i, sample) in run.iter().enumerate() {
        assert_eq!((columns[0][i], columns[1][i]), (sample.q[0], sample.z[0]));
    }
    let picture = table.svg().unwrap();
    assert!(picture.contains("<svg") && picture.contains("x_dot") && !picture.contains("NaN"));
}

/// A page that draws it.
pub fn page<H: Happening>(_: &H) {
    let kernel = kernel();
    let run = exact::<H>(&kernel);
    let pose = |sample: &Sample<Kernel>| Isometry3::translation(sample.q[0], 0.0, 0.0);
    let page = Playback::with_pictures("It happens", &run, 5).unwrap().body("mass", pose, [Shape::ball(0.1)]);
    let html = page.curve("speed", "first", |sample| sample.z[0]).html().unwrap();
    assert!(["mass", "speed", "first"].iter().all(|part| html.contains(part)));
}

/// The energy is the work of the push: to the tolerance over some hundred steps.
pub fn energy<H: Happening>(_: &H) {
    let kernel = kernel();
    let run = exact::<H>(&kernel);
    let balance = power_balance(&kernel, &run, push);
    assert!(balance.largest_residual() < 1e-9 + 10.0 * balance.last().uncertainty, "{balance}");
    assert!(balance.last().uncertainty < 1e-6, "{balance}");
    // At an event alone nothing is lost. A jump takes three quarters of the kinetic energy that there is.
    let lost: f64 = run
        .events()
        .iter()
        .map(|event| {
            let after = run.at(event.sample.t).unwrap();
            kernel.energy(after.t, &after.q, &after.z) - kernel.energy(event.sample.t, &event.sample.q, &event.sample.z)
        })
        .sum();
    assert!((balance.last().jumps - lost).abs() < 1e-12, "{balance}");
}

/// Rows of a study are runs that are made alone.
pub fn study<H: Happening>(_: &H) {
    let speed_at_end = |start: f64| H::run(&kernel(), start, Adaptive::new(1e-9, 1e-10)).last().z[0];
    let mut declaration = Declaration::new("starts", 7, 4);
    let drawn = declaration.parameter("start", "m", uniform(0.2, 0.4));
    let speed = declaration.number("speed", "m/s");
    let study = declaration.study(move |sample, row| {
        row.set(speed, speed_at_end(sample[drawn]));
        Ok::<(), IntegrationError>(())
    });
    let study = study.unwrap();
    for run in 0..4 {
        let (draw, row) = study.one(run);
        let expected = speed_at_end(draw.values()[0]);
        assert_eq!((row.cause(), row.get(speed)), (None, Some(&gauss_study::Value::Number(expected))));
    }
}

/// Jumps of an ensemble on all threads are those of single runs, to the last bit.
pub fn threads(_: &Jump) {
    type Four = Lanes<f64, 4>;
    let wide = Pushed { k: Four::splat(STIFFNESS) }.kernel().unwrap();
    let start = |i: usize| START + 0.02 * i as f64;
    let mut states = States::<PushedKernel<Four>>::from_fn(6, |i| (One::new(start(i)), One::zeros()));
    let batch = Batch::new(&wide).input(push::<Four>).adaptive(1e-9, 1e-10);
    let batch = batch.event(Crossing::Falling, |_, q: &One<Four>, _: &One<Four>| q[0]).then_through(slowed::<Four>);
    let ends = batch.run_on_all_threads(0.0..1.0, &mut states);
    let kernel = kernel();
    for (i, end) in ends.iter().enumerate() {
        assert!(end.is_ok());
        let alone = Jump::run(&kernel, start(i), Adaptive::new(1e-9, 1e-10));
        assert_eq!(states.get(i), (alone.last().q, alone.last().z), "state {i}");
    }
}
