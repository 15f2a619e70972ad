//! Taylor's method: against reference solutions, its order, its ends, events, what it refuses.

use gauss_runtime::integrate::{IntegrationErrorKind, RunPart};
use gauss_runtime::prelude::*;
use gauss_tests::scene::{Scene, quaternion_of};
use gauss_tests::top::{Top, TopKernel};

fn top(scene: &Scene) -> TopKernel<f64> {
    let p = &scene.parameters;
    Top { mass: p.mass, center: p.center, inertia: p.principal, g: p.gravity }.kernel().expect("a top")
}

/// The largest error of an entry of R at the end, and the number of steps.
fn error(scene: &Scene, control: Taylor) -> (f64, u32) {
    let (kernel, mut steps) = (top(scene), 0_u32);
    let run = Simulation::new(&kernel).control(control).observe(|_| steps += 1);
    let end = run.run_to_end(quaternion_of(&scene.initial.rotation), scene.initial.omega, 0.0..scene.duration);
    let end = end.expect("runs");
    ((end.q.to_rotation_matrix().into_inner() - scene.last.rotation).amax(), steps - 1)
}

/// What a run may be off at the end: some roundings a step, and what was left out of the series, carried on as the
/// reference says that errors of the initial state are.
fn allowed(scene: &Scene, tolerance: f64, steps: u32) -> f64 {
    let growth = scene.sensitivity / (0.5 * f64::EPSILON);
    f64::from(steps) * (tolerance + 4.0 * f64::EPSILON) * growth.max(1.0)
}

#[test]
fn tops_reach_their_references_at_every_tolerance() {
    for name in ["hlw_heavy_top", "lagrange_top", "kovalevskaya", "simo_wong_top"] {
        let scene = Scene::load(name);
        let mut before = f64::INFINITY;
        for tolerance in [1e-5, 1e-8, 1e-11, 1e-14] {
            let (error, steps) = error(&scene, Taylor::new(tolerance, tolerance));
            let allowed = allowed(&scene, tolerance, steps);
            assert!(error <= allowed, "{name} at {tolerance:e}: {error:e} > {allowed:e} in {steps} steps");
            assert!(error < before || error < allowed * 1e-2, "{name}: {before:e}, then {error:e}");
            before = error;
        }
    }
}

/// With loose tolerances steps are as long as is asked for. Over the first tenth of the scene, in steps so short that
/// the slope is that of the leading term.
#[test]
fn errors_go_with_the_order() {
    let scene = Scene::load("hlw_heavy_top");
    let (kernel, span) = (top(&scene), 0.1 * scene.duration);
    let (q, omega) = (quaternion_of(&scene.initial.rotation), scene.initial.omega);
    let run = |control: Taylor| {
        let mut steps = 0;
        let run = Simulation::new(&kernel).control(control).observe(|_| steps += 1);
        let end = run.run_to_end(q, omega, 0.0..span).expect("runs");
        (end.q, steps - 1)
    };
    let exact = run(Taylor::new(1e-16, 1e-16)).0;
    for (order, counts) in [(4, [320, 640]), (6, [80, 160]), (9, [32, 48]), (12, [12, 16])] {
        let [coarse, fine] = counts.map(|n| {
            let h = span / f64::from(n) * (1.0 + 1e-12);
            let (end, made) = run(Taylor::new(1e9, 1e9).of_order(order).largest_step(h));
            assert_eq!(made, n);
            end.angle_to(&exact)
        });
        assert!(fine > 1e-13, "order {order}: {fine:e} is rounding");
        let slope = (coarse / fine).ln() / (f64::from(counts[1]) / f64::from(counts[0])).ln();
        assert!((slope - order as f64).abs() < 0.1 * order as f64, "{slope} instead of {order}: {coarse:e} {fine:e}");
    }
}

#[test]
fn there_and_back() {
    let scene = Scene::load("hlw_heavy_top");
    let kernel = top(&scene);
    let (q, omega) = (quaternion_of(&scene.initial.rotation), scene.initial.omega);
    let control = Taylor::new(1e-15, 1e-15);
    let run = |q, z, range| Simulation::new(&kernel).control(control).run_to_end(q, z, range).expect("runs");
    let there = run(q, omega, 0.0..scene.duration);
    let back = run(there.q, there.z, scene.duration..0.0);
    let steps = error(&scene, control).1;
    assert!(back.q.angle_to(&q) <= 2.0 * allowed(&scene, 1e-15, steps));
}

/// Both forms give the same states: momenta are converted at the ends of steps.
#[test]
fn in_momentum_form() {
    let scene = Scene::load("hlw_heavy_top");
    let kernel = top(&scene);
    let (q, omega) = (quaternion_of(&scene.initial.rotation), scene.initial.omega);
    let run = Simulation::new(&kernel).control(Taylor::new(1e-13, 1e-13));
    let by_velocity = run.run_to_end(q, omega, 0.0..scene.duration).expect("runs");
    let by_momentum = run.momentum_form().run_to_end(q, omega, 0.0..scene.duration).expect("runs");
    let steps = error(&scene, Taylor::new(1e-13, 1e-13)).1;
    assert!(by_velocity.q.angle_to(&by_momentum.q) <= allowed(&scene, 1e-13, steps));
    assert!((by_velocity.p - by_momentum.p).norm() <= allowed(&scene, 1e-13, steps) * by_velocity.p.norm());
}

#[derive(GaussDynamics)]
#[gauss(taylor, coordinates(angle), particle(mass = 1, position = [sin(angle), 0, -cos(angle)]))]
struct Pendulum {
    #[gauss(gravity)]
    g: f64,
}

/// Upside down errors grow by e³ a second: what a step adds is seen. At one tolerance both methods are to be about as
/// exact; before, a series left out all of the tolerance, and was 5 to 16 times worse here.
#[test]
fn next_to_instabilities_series_are_as_exact_as_order_8() {
    let kernel = Pendulum { g: 9.81 }.kernel().expect("a pendulum");
    let run = Simulation::new(&kernel);
    let rest = SVector::from([0.0]);
    for angle in [std::f64::consts::PI - 2.65e-6, 3.1].map(|angle| SVector::from([angle])) {
        let exact = run.taylor(1e-18, 1e-18).run_to_end(angle, rest, 0.0..7.0).expect("runs");
        for tolerance in [1e-6, 1e-8, 1e-10, 1e-12] {
            let error = |end: gauss_runtime::integrate::End<PendulumKernel>| {
                (end.q - exact.q).amax().max((end.z - exact.z).amax())
            };
            let series = error(run.taylor(tolerance, tolerance).run_to_end(angle, rest, 0.0..7.0).expect("runs"));
            let order_8 = error(run.adaptive(tolerance, tolerance).run_to_end(angle, rest, 0.0..7.0).expect("runs"));
            assert!(series <= 2.0 * order_8, "{angle}, {tolerance:e}: {series:e}, order 8: {order_8:e}");
        }
    }
}

/// Turning points of a pendulum, whose period is known (Gauss), although steps are longer than a quarter of it.
#[test]
fn events_and_states_between_samples_have_the_accuracy_of_the_method() {
    let kernel = Pendulum { g: 9.81 }.kernel().expect("a pendulum");
    let amplitude = 2.0_f64;
    let run = Simulation::new(&kernel)
        .event(Crossing::Any, |_, _, z| z[0])
        .control(Taylor::new(1e-14, 1e-14))
        .run(SVector::from([amplitude]), SVector::from([0.0]), 0.0..10.0)
        .expect("runs");
    let (mut a, mut b) = (1.0, (0.5 * amplitude).cos());
    for _ in 0..6 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    let half = 0.5 * std::f64::consts::TAU / a / 9.81_f64.sqrt();
    assert_eq!(run.events().len(), (10.0 / half) as usize);
    let steps = run.len() as f64;
    for (n, event) in run.events().iter().enumerate() {
        let late = event.sample.t - half * (n + 1) as f64;
        // Some tolerances a step of the state, over its rates, which are g at the turn.
        assert!(late.abs() < 10.0 * steps * 1e-14, "turn {n}: {late:e}");
    }
    let energy = |q: &SVector<f64, 1>, z: &SVector<f64, 1>| kernel.energy(0.0, q, z);
    let initial = energy(&SVector::from([amplitude]), &SVector::from([0.0]));
    for k in 0..=97 {
        let sample = run.at(10.0 * f64::from(k) / 97.0).expect("within the run");
        assert!((energy(&sample.q, &sample.z) - initial).abs() < 10.0 * steps * 1e-14 * 9.81);
    }
}

#[test]
fn what_stays_still_is_one_step() {
    let kernel = Pendulum { g: 9.81 }.kernel().expect("a pendulum");
    let run = Simulation::new(&kernel).control(Taylor::new(1e-12, 1e-12));
    let run = run.run(SVector::from([0.0]), SVector::from([0.0]), 0.0..1e6).expect("runs");
    assert_eq!(run.len(), 2);
    assert_eq!((run.last().q[0], run.last().z[0]), (0.0, 0.0));
}

#[test]
fn what_cannot_be_done_is_said() {
    let kernel = Pendulum { g: 9.81 }.kernel().expect("a pendulum");
    let (q, z) = (SVector::from([1.0]), SVector::from([0.5]));
    let kind = |control: Taylor, q, z, end: f64, limit: u64| {
        let run = Simulation::new(&kernel).control(control).max_steps(limit);
        run.run_to_end(q, z, 0.0..end).expect_err("refused").kind
    };
    let fine = Taylor::new(1e-10, 1e-10);
    let many = u64::MAX;
    assert_eq!(
        kind(Taylor::new(-1.0, 0.0), q, z, 1.0, many),
        IntegrationErrorKind::InvalidTolerance { relative: -1.0, absolute: 0.0 }
    );
    assert_eq!(kind(fine.largest_step(0.0), q, z, 1.0, many), IntegrationErrorKind::InvalidStep { step: 0.0 });
    assert_eq!(kind(fine, q, z, f64::NAN, many), IntegrationErrorKind::InvalidInterval);
    assert_eq!(kind(fine, q, z, 100.0, 3), IntegrationErrorKind::TooManySteps { limit: 3 });
    assert_eq!(
        kind(fine, SVector::from([f64::NAN]), z, 1.0, many),
        IntegrationErrorKind::NonFinite { part: RunPart::InitialState }
    );
    // Coefficients of a finite state that overflow: no step is made with them.
    let fast = kind(fine, q, SVector::from([1e200]), 1.0, many);
    assert!(matches!(fast, IntegrationErrorKind::NonFinite { .. }), "{fast:?}");
}
