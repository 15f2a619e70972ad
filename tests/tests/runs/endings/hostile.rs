//! Numbers that nobody should pass, to every public entry of the integration: each comes back soon, with a good state
//! or a reason.

use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};

use gauss_adapters::FlatSystem;
use gauss_batch::{Batch, States};
use gauss_exact::{FreeFlow, Scheme, Splitting};
use gauss_runtime::chart::convert;
use gauss_runtime::configuration::Configuration;
use gauss_runtime::integrate::{
    Compensated, Composed, Composition, Control, EnergyMomentum, Fixed, Radau, Rkmk, Variational,
};
use gauss_runtime::monitor::{monitor, power_balance};
use gauss_runtime::prelude::*;
use gauss_tables::Tabulate;
use gauss_tests::top::TopKernel;
use gauss_tests::watchdog::within;

use super::scenes::{
    Angles, Bead, Driven, GenericTop, GenericTopKernel, Inclined, Pendulum, PendulumKernel, Spring, one, toy,
};

/// What numbers can be. Beside each other they make steps of which a run is refused, or has few: not the millions that
/// somebody who asks for them gets: no two have a ratio of 10⁶ to 10⁸.
const HOSTILE: [f64; 22] = [
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    1e300,
    -1e300,
    1e154,
    1e-290,
    5e-324,
    -5e-324,
    1e150,
    1e-150,
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.3,
    -2.5,
    1e-12,
    1e12,
    1e-17,
    f64::MAX,
    f64::MIN_POSITIVE,
];

/// Draws for each entry.
const DRAWS: u32 = 75;

/// All draws of an entry come back in so many seconds, on a slow machine that does other things too.
const SECONDS: u64 = 240;

/// Ten numbers, one of two of them hostile.
type Numbers = [f64; 10];

fn numbers() -> impl Strategy<Value = Numbers> {
    let number = prop_oneof![prop::sample::select(&HOSTILE[..]), -3.0..3.0_f64];
    prop::array::uniform10(number)
}

/// Every draw handed to a function.
fn each(what: &'static str, function: impl Fn(Numbers) + Send + 'static) {
    within(SECONDS, what, move || {
        let config = Config { cases: DRAWS, failure_persistence: None, max_shrink_iters: 100, ..Config::default() };
        let run = TestRunner::new(config).run(&numbers(), |numbers| {
            function(numbers);
            Ok(())
        });
        if let Err(error) = run {
            panic!("{what}: {error}");
        }
    });
}

/// A run that ends well is at its end, or at its event, in a finite state; one that does not says why.
fn judge<K: GaussSystem<Scalar = f64>>(
    path: &Trajectory<'_, K>,
    error: Option<&IntegrationError>,
    end: f64,
    at: &[f64],
) {
    let last = path.last();
    match error {
        None => {
            assert!(last.t == end || path.stopped_by().is_some(), "{} is not {end}", last.t);
            assert!(last.q.is_finite() && last.z.is_finite(), "{last:?}");
        }
        Some(error) => {
            assert!(!error.to_string().is_empty());
            assert!(error.time == last.t || error.time.is_nan(), "{error} at {}", last.t);
        }
    }
    // What was handed over is kept, whatever it is.
    let good = path.first().q.is_finite() && path.first().z.is_finite();
    for &t in at {
        if let (true, Ok(sample)) = (good, path.at(t)) {
            assert!(sample.t == t && sample.q.is_finite(), "{sample:?}");
        }
    }
    assert!(path.table().energies_are_as_many_as(path.len()));
}

fn finite<C: Configuration>(part: &C) -> bool {
    part.is_finite()
}

/// Rows of a table.
trait Rows {
    fn energies_are_as_many_as(&self, rows: usize) -> bool;
}

impl<K: GaussSystem> Rows for gauss_tables::RunTable<K> {
    fn energies_are_as_many_as(&self, rows: usize) -> bool {
        self.get("t").is_some_and(|times| times.len() == rows)
    }
}

fn pendulum() -> PendulumKernel {
    Pendulum { g: 9.81 }.kernel().expect("a pendulum")
}

fn top() -> TopKernel<f64> {
    toy().kernel().expect("a top")
}

/// A pendulum by a control of two numbers, with events and a jump.
fn swing<C: Control<PendulumKernel>>(n: Numbers, control: C) {
    let kernel = pendulum();
    let [_, _, q, z, start, end, level, at, every, push] = n;
    let run = Simulation::new(&kernel)
        .every(every.abs() as u64)
        .event(Crossing::Any, move |_, q: &SVector<f64, 1>, _| q[0] - level)
        .then(move |state| state.z[0] += push)
        .until(Crossing::Rising, move |t, _, z: &SVector<f64, 1>| t * z[0] - at)
        .control(control);
    let (path, error) = run.attempt(one(q), one(z), start..end);
    judge(&path, error.as_ref(), end, &[at, level, start]);
    // Without events it is the same.
    let plain = Simulation::new(&kernel).control(Fixed::new(0.1)).max_steps((every.abs() as u64).min(100_000));
    let _ = plain.run_to_end(one(q), one(z), start..end);
}

#[test]
fn adaptive_methods() {
    each("adaptive runs", |n| {
        let [a, b, ..] = n;
        swing(n, Adaptive::new(a, b));
    });
    each("adaptive runs of other pairs", |n| {
        let [a, b, ..] = n;
        swing(n, Adaptive::by(RungeKutta(DormandPrince5), a, b));
        swing(n, Adaptive::with(&Tableau::VERNER_9, a, b));
    });
    each("first and longest steps", |n| {
        let [a, b, q, z, start, end, ..] = n;
        let kernel = pendulum();
        let run = Simulation::new(&kernel).adaptive(1e-6, 1e-6).first_step(a).largest_step(b);
        let (path, error) = run.attempt(one(q), one(z), start..end);
        judge(&path, error.as_ref(), end, &[]);
    });
}

#[test]
fn fixed_steps() {
    each("steps of one length", |n| {
        let h = n[0];
        swing(n, Fixed::new(h));
        swing(n, Fixed::by(RungeKutta(Classical4), h));
        swing(n, Fixed::with(&Tableau::RK4, h));
        swing(n, Fixed::by(CommutatorFree4, h));
        swing(n, Compensated::with(&Tableau::RK4, h));
    });
    each("implicit steps", |n| {
        let h = n[0];
        swing(n, Fixed::by(Collocation::midpoint(), h));
        swing(n, Fixed::by(Collocation::order_6(), h));
        swing(n, Fixed::by(Composed::new(&Composition::KAHAN_LI_6, Collocation::midpoint()), h));
        swing(n, Fixed::by(Composed::new(&Composition::KAHAN_LI_8, Collocation::order_6()), h));
    });
}

#[test]
fn series_and_stiff_methods() {
    each("Taylor's method", |n| {
        let [a, b, ..] = n;
        swing(n, Taylor::new(a, b));
        swing(n, Taylor::new(1e-6, 1e-6).largest_step(a).of_order(b.abs() as usize));
    });
    each("Rosenbrock and Radau", |n| {
        let [a, b, q, z, start, end, k, c, ..] = n;
        // Parameters that no spring has are refused elsewhere.
        let Ok(kernel) = (Spring { k, c }).kernel() else { return };
        let run = Simulation::new(&kernel);
        for (path, error) in [
            run.control(Adaptive::by(Rosenbrock, a, b)).attempt(one(q), one(z), start..end),
            run.control(Fixed::by(Rosenbrock, a)).attempt(one(q), one(z), start..end),
            run.control(Adaptive::by(Radau, a, b)).attempt(one(q), one(z), start..end),
            run.control(Fixed::by(Radau, a)).attempt(one(q), one(z), start..end),
            run.adaptive(a, b).attempt(one(q), one(z), start..end),
            run.momentum_form().taylor(a, b).attempt(one(q), one(z), start..end),
        ] {
            judge(&path, error.as_ref(), end, &[a, b, q]);
        }
    });
}

#[test]
fn bodies() {
    each("tops", |n| {
        let [a, b, x, y, z, start, end, w, ..] = n;
        let (kernel, spin) = (top(), Vector3::new(x, y, z));
        // A quaternion of any norm.
        let q = UnitQuaternion::new_unchecked(Quaternion::new(w, x, y, z));
        let run = Simulation::new(&kernel);
        for q in [UnitQuaternion::identity(), q] {
            for (path, error) in [
                run.adaptive(a, b).attempt(q, spin, start..end),
                run.momentum_form().control(Fixed::by(Variational, a)).attempt(q, spin, start..end),
                run.control(Fixed::by(EnergyMomentum::new(), a)).attempt(q, spin, start..end),
                run.control(Compensated::by(Rkmk::new(&Tableau::RK4), a)).attempt(q, spin, start..end),
            ] {
                judge(&path, error.as_ref(), end, &[a, b]);
            }
        }
        let discrete = Splitting::discrete(&kernel, Scheme::BLANES_MOAN_4).expect("a top");
        let exact = Splitting::exact(&kernel, Scheme::BLANES_MOAN_4).expect("a top");
        let run = run.momentum_form();
        for (path, error) in [
            run.control(Fixed::by(discrete, a)).attempt(UnitQuaternion::identity(), spin, start..end),
            run.control(Fixed::by(exact, a)).attempt(UnitQuaternion::identity(), spin, start..end),
        ] {
            judge(&path, error.as_ref(), end, &[b]);
        }
        let _ = FreeFlow::new([0.2, 0.3, 0.4]);
    });
    each("angles", |n| {
        let [a, b, x, y, z, start, end, u, v, w] = n;
        let kernel = Angles { mass: 1.0, inertia: Vector3::new(1.0, 2.0, 2.5) }.kernel().expect("a body");
        let run = Simulation::new(&kernel).adaptive(a, b);
        let (path, error) = run.attempt(Vector3::new(x, y, z), Vector3::new(u, v, w), start..end);
        judge(&path, error.as_ref(), end, &[a, b]);
    });
}

#[test]
fn batches_and_adapters() {
    each("batches", |n| {
        type Four = Lanes<f64, 4>;
        let [h, start, end, x, y, z, u, v, ..] = n;
        let kernel = GenericTop::<Four>::toy().kernel().expect("a top");
        let spins = [[x, y, z], [u, v, 0.1], [0.1, 0.2, 0.3]];
        let mut states =
            States::<GenericTopKernel<Four>>::from_fn(7, |i| (UnitQuaternion::identity(), Vector3::from(spins[i % 3])));
        let batch = Batch::new(&kernel).advance(&RungeKutta(DormandPrince8), h, start..end, &mut states);
        if let Err(error) = batch {
            assert!(!error.failures.is_empty() && !error.to_string().is_empty());
        } else {
            assert!((0..7).all(|i| states.get(i).1.iter().all(|x| x.is_finite())));
        }
        let _ = Batch::new(&kernel).accelerations(h, &states);
    });
    each("projections, conversions and derivatives", |n| {
        let [t, x, y, u, v, h, a, ..] = n;
        let (q, z) = (SVector::from([x, y]), SVector::from([u, v]));
        // What `kernel()` accepts is no reason to hang either.
        for a in [0.5, a] {
            let Ok(bead) = (Bead { a }).kernel() else { continue };
            match bead.project(t, &q, &z) {
                Ok((q, z)) => {
                    let (position, velocity) = (bead.position_residual(t, &q), bead.velocity_residual(t, &q, &z));
                    assert!(finite(&q) && finite(&z), "{q}, {z}");
                    // Beyond, doubles do not know the phase of a sine, and nothing can be resolved.
                    if q.amax() < 1e6 && a.abs() < 1e6 {
                        // Some thousand roundings of what is added up.
                        let rounding = 1e-12 * (1.0 + a.abs()) * (1.0 + q.amax());
                        assert!(position.amax() <= rounding, "{position} at {q}");
                        assert!(velocity.amax() <= rounding * (1.0 + z.amax()), "{velocity} at {q}, {z}");
                    }
                }
                Err(error) => assert!(!error.to_string().is_empty()),
            }
            let _ = bead.linearize(t, &q, &z, &one(v));
        }
        let driven = Driven { g: 9.81 }.kernel().expect("a pendulum");
        match CommutatorFree4.step_linearized(&driven, t, &one(x), &one(u), &one(v), h) {
            Ok(step) => assert!(finite(&step.q) && finite(&step.z), "{:?}", (step.q, step.z)),
            Err(error) => assert!(!error.to_string().is_empty()),
        }
        let (top, inclined) = (top(), Inclined::toy().kernel().expect("a top"));
        if let Ok((angles, rates)) = convert(&top, &UnitQuaternion::identity(), &Vector3::new(x, y, u), &inclined) {
            assert!(finite(&angles) && finite(&rates));
        }
        let turned = convert(&inclined, &Vector3::new(x, y, u), &Vector3::new(v, h, a), &top);
        if let Ok((attitude, spin)) = turned {
            assert!(finite(&attitude) && finite(&spin));
        }
    });
    each("tables", |n| {
        let [q, z, start, end, a, b, c, ..] = n;
        let kernel = pendulum();
        let run = Simulation::new(&kernel).adaptive(1e-6, 1e-6).max_steps(2000);
        let (path, _) = run.attempt(one(q), one(z), start..end);
        if let Ok(samples) = path.at_times([a, b, c]) {
            assert!(samples.iter().all(|sample| finite(&sample.q)));
        }
        let table = path.table();
        assert!(table.to_string().lines().count() > path.len());
    });
    each("flat systems and balances", |n| {
        let [t, q, z, a, b, ..] = n;
        let kernel = pendulum();
        let system = FlatSystem::new(&kernel);
        let x: [f64; 2] = system.vector(t, &one(q), &one(z));
        let mut slope = [0.0; 2];
        system.rates(t, &x, &mut slope);
        let _ = system.sample(t, &[a, b]);
        let run = Simulation::new(&kernel).adaptive(1e-6, 1e-6).max_steps(2000);
        let (path, _) = run.attempt(one(q), one(z), t..a);
        let balance = power_balance(&kernel, &path, |_, _, _| ());
        assert_eq!(balance.points().len(), path.len());
        let _ = (monitor(&kernel, &path).to_string(), path.table_at([a, b]).map(|table| table.to_string()));
    });
}
