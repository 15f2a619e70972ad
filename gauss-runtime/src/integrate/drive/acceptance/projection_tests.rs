//! Runs with constraints: no drift, the order of the method, closed forms, refusals.

use core::ops::ControlFlow;
use nalgebra::SVector;
use std::string::ToString;
use std::vec::Vec;

use super::check_jump;
use crate::constraint::{ConstrainedSystem, ConstraintLevel, ProjectionFailure};
use crate::integrate::*;
use crate::monitor::monitor;
use crate::system::GaussSystem;
use crate::testing::constrained::{GRAVITY, Hand, circle, line, on_both, pendulum, pendulum_by_angle, skate};

/// A swing from 2 rad: up to 6 m/s, and far from small angles.
const ANGLE: f64 = 2.0;
const RATE: f64 = 0.5;

fn swing() -> (SVector<f64, 2>, SVector<f64, 2>) {
    let (sine, cosine) = ANGLE.sin_cos();
    (SVector::from([sine, -cosine]), SVector::from([RATE * cosine, RATE * sine]))
}

/// Residuals of the pendulum, and what rounding explains of them: see the tests of the projection for the first; for
/// x u + y v, doubled, |v| times ½ε for each of x, y, u, v, and as much for two products and a sum.
fn on_the_circle(sample: &Sample<Hand<f64, 2, 1>>) -> bool {
    let system = pendulum::<f64>(2.0);
    let position = system.position_residual(sample.t, &sample.q).amax();
    let velocity = system.velocity_residual(sample.t, &sample.q, &sample.z).amax();
    position <= 2.0 * f64::EPSILON && velocity <= 4.0 * f64::EPSILON * sample.z.norm().max(1.0)
}

#[test]
fn nothing_drifts_in_a_hundred_thousand_steps() {
    let system = pendulum::<f64>(2.0);
    let (q, z) = swing();
    let (mut count, mut off) = (0, 0);
    let run = Simulation::new(&system).fixed_step(0.01).observe(|sample| {
        count += 1;
        off += usize::from(!on_the_circle(sample));
    });
    run.run_to_end(q, z, 0.0..1000.0).expect("runs");
    assert_eq!((count, off), (100_001, 0));

    // Without projection the same method leaves the circle: there was something to keep.
    let method = Rkmk::new(&Tableau::RK4);
    let problem = SystemProblem { system: &system, form: VelocityForm, input: NoInput };
    let mut state = State { t: 0.0, q, y: z };
    for _ in 0..10_000 {
        let rates = problem.rates(&state);
        state = method.step(&problem, &state, &rates, 0.01).expect("steps").state;
    }
    let drift = system.position_residual(state.t, &state.q).amax();
    assert!(drift > 1e-6, "{drift:e}");
}

#[test]
fn momenta_are_kept_on_the_constraints_as_well() {
    let system = pendulum::<f64>(2.0);
    let (q, z) = swing();
    let run = Simulation::new(&system).adaptive(1e-10, 1e-12);
    let velocities = run.run(q, z, 0.0..20.0).expect("runs");
    let momenta = run.momentum_form().run(q, z, 0.0..20.0).expect("runs");
    assert!(velocities.iter().chain(momenta.iter()).all(on_the_circle));
    // Momenta are those of the projected velocities.
    assert!(momenta.iter().all(|sample| (sample.p - 2.0 * sample.z).amax() <= 4.0 * f64::EPSILON * sample.p.amax()));
    // 20 s are ten swings; tolerances of 1e-10 a step over about 1000 steps.
    let (a, b) = (velocities.last(), momenta.last());
    assert!((a.q - b.q).amax() < 1e-7 && (a.z - b.z).amax() < 1e-6, "{a:?} {b:?}");
    for trajectory in [&velocities, &momenta] {
        let energy = monitor(&system, trajectory).energy.largest();
        assert!(energy < 1e-6, "{energy:e}");
    }
}

/// The largest errors of a method over eight times up to t = 2, for each number of steps in these 2 s. The reference is
/// the pendulum by its angle, which has no constraint, to 1e-13.
///
/// At one time alone the two leading terms of the error cancel for some step, where its sign changes, and the slope
/// next to that says nothing of the order.
fn errors<F: Form<Hand<f64, 2, 1>>, const N: usize>(form: F, tableau: &Tableau<N>, steps: [usize; 2]) -> [f64; 2] {
    let reference = pendulum_by_angle();
    let exact: Vec<(SVector<f64, 2>, SVector<f64, 2>)> = (1..=8)
        .map(|k| {
            let end = Simulation::new(&reference)
                .control(Adaptive::with(&Tableau::DORMAND_PRINCE_8, 1e-14, 1e-14))
                .run_to_end(SVector::from([ANGLE]), SVector::from([RATE]), 0.0..0.25 * f64::from(k))
                .expect("runs");
            let (sine, cosine) = end.q[0].sin_cos();
            (SVector::from([sine, -cosine]), end.z[0] * SVector::from([cosine, sine]))
        })
        .collect();
    let system = pendulum::<f64>(2.0);
    let (q, z) = swing();
    steps.map(|steps| {
        let run = Simulation::new(&system).form(form).control(Fixed::with(tableau, 2.0 / steps as f64));
        let trajectory = run.run(q, z, 0.0..2.0).expect("runs");
        let error = |(k, (q, z)): (usize, &(SVector<f64, 2>, SVector<f64, 2>))| {
            let sample = trajectory.get((k + 1) * steps / 8).expect("is there");
            (sample.q - q).amax().max((sample.z - z).amax())
        };
        exact.iter().enumerate().map(error).fold(0.0, f64::max)
    })
}

#[test]
fn methods_keep_their_order() {
    // With errors C hᵖ (1 + c h + …) the slope between h and h/2 differs from p by about c h: for RK4 it is 3.62, 3.84
    // and 3.93 between 200, 400, 800 and 1600 steps. An order lost would show as 1.
    for (name, order, [coarse, fine]) in [
        ("RK4, velocities", 4.0, errors(VelocityForm, &Tableau::RK4, [800, 1600])),
        ("RK4, momenta", 4.0, errors(MomentumForm, &Tableau::RK4, [800, 1600])),
        ("DP5, velocities", 5.0, errors(VelocityForm, &Tableau::DORMAND_PRINCE_5, [192, 384])),
        ("DP5, momenta", 5.0, errors(MomentumForm, &Tableau::DORMAND_PRINCE_5, [192, 384])),
    ] {
        let found = (coarse / fine).log2();
        assert!((found - order).abs() < 0.25, "{name}: order {found} instead of {order}: {coarse:e}, {fine:e}");
    }
}

#[test]
fn a_skate_on_an_incline_runs_along_a_cycloid() {
    // Closed form (Neimark & Fufaev, *Dynamics of Nonholonomic Systems*): the edge turns evenly, the speed along it is
    // (g/ω) sin ωt, and the skate does not go down on average.
    let system = skate();
    let turn = 2.0;
    let start = (SVector::from([0.0, 0.0, 0.0]), SVector::from([0.0, 0.0, turn]));
    for (form, end) in [
        ("velocities", Simulation::new(&system).adaptive(1e-12, 1e-12).run(start.0, start.1, 0.0..3.0)),
        ("momenta", Simulation::new(&system).adaptive(1e-12, 1e-12).momentum_form().run(start.0, start.1, 0.0..3.0)),
    ] {
        let trajectory = end.expect("runs");
        for sample in &trajectory {
            let angle = turn * sample.t;
            let scale = GRAVITY / (2.0 * turn * turn);
            let expected = [scale * angle.sin() * angle.sin(), scale * (angle - angle.sin() * angle.cos()), angle];
            assert!((sample.q - SVector::from(expected)).amax() < 1e-9, "{form}: {sample:?}");
            // Two products and a sum of numbers up to |z|, and the rounding of z.
            let slip = system.velocity_residual(sample.t, &sample.q, &sample.z).amax();
            assert!(slip <= 4.0 * f64::EPSILON * sample.z.norm(), "{form}: {slip:e}");
        }
    }
}

#[test]
fn derivatives_belong_to_the_projected_state() {
    // Those that come with a step of Dormand & Prince are taken before the projection.
    let system = pendulum::<f64>(2.0);
    let problem = SystemProblem { system: &system, form: VelocityForm, input: NoInput };
    let (q, y) = swing();
    let mut seen = 0;
    let mut check = |state: &State<_>, rates: &Rates<_>, _: StepStatistics| {
        let expected = problem.rates(state);
        assert_eq!((rates.configuration, rates.variables), (expected.configuration, expected.variables));
        seen += 1;
        ControlFlow::Continue(())
    };
    let start = State { t: 0.0, q, y };
    Adaptive::new(1e-4, 1e-4).drive(&problem, start, 2.0, 1000, &mut check).expect("runs");
    Fixed::new(0.05).drive(&problem, start, 2.0, 1000, &mut check).expect("runs");
    assert!(seen > 50);
}

#[test]
fn a_start_off_the_constraints_is_refused_with_the_remedy() {
    let system = pendulum::<f64>(2.0);
    let (q, z) = swing();
    let off = q * 1.001;
    for error in [
        Simulation::new(&system).fixed_step(0.01).run_to_end(off, z, 0.0..1.0).expect_err("is refused"),
        Simulation::new(&system).adaptive(1e-6, 1e-6).momentum_form().run_to_end(off, z, 0.0..1.0).expect_err("is too"),
    ] {
        let IntegrationErrorKind::InconsistentStart { level: ConstraintLevel::Position, distance } = error.kind else {
            panic!("{error}");
        };
        // The larger component of a thousandth of (sin 2, −cos 2).
        assert!((distance - 1e-3 * ANGLE.sin()).abs() < 1e-12 && error.time == 0.0, "{error}");
        assert!(error.to_string().contains("the initial position violates the constraints"), "{error}");
        assert!(error.to_string().contains("call `kernel.project(t, &q, &z)` first"), "{error}");
    }
    let tilted = z + SVector::from([1e-3, 0.0]);
    let (trajectory, error) = Simulation::new(&system).fixed_step(0.01).attempt(q, tilted, 0.0..1.0);
    let kind = error.expect("is refused").kind;
    assert!(
        matches!(kind, IntegrationErrorKind::InconsistentStart { level: ConstraintLevel::Velocity, .. }),
        "{kind:?}"
    );
    assert_eq!(trajectory.last().z, tilted);

    // What the remedy gives is accepted, and so is what was typed with ten digits, which the first sample has improved.
    let (near, speeds) = system.project(0.0, &off, &tilted).expect("is near");
    let typed = (q.map(|x| (x * 1e10).round() / 1e10), z.map(|x| (x * 1e10).round() / 1e10));
    for (q, z) in [(near, speeds), typed] {
        let trajectory = Simulation::new(&system).fixed_step(0.01).run(q, z, 0.0..1.0).expect("runs");
        assert!(trajectory.iter().all(on_the_circle));
    }
}

#[test]
fn a_constraint_that_can_no_longer_be_met_ends_the_run_in_words() {
    // On the circle and at x = t: nowhere for t > 1.
    let system = on_both(circle(), line(|t, [x, _]| x - t, |_, _, [u, _]| u - 1.0));
    let (q, z) = (SVector::from([0.0, 1.0]), SVector::from([1.0, 0.0]));
    // 0.96 = 8 steps; the ninth ends at 1.08.
    let (trajectory, error) = Simulation::new(&system).fixed_step(0.12).attempt(q, z, 0.0..2.0);
    let error = error.expect("stops");
    let IntegrationErrorKind::Projection { error: reason } = error.kind else { panic!("{error}") };
    assert_eq!((reason.level, reason.failure), (ConstraintLevel::Position, ProjectionFailure::NotConverged));
    assert!(error.to_string().contains("contradict each other"), "{error}");
    assert!((error.time - 0.96).abs() < 1e-12 && error.time == trajectory.last().t, "{error}");
    let y = (1.0 - 0.96_f64 * 0.96).sqrt();
    assert!((trajectory.last().q - SVector::from([0.96, y])).amax() < 8.0 * f64::EPSILON / y);

    // Control tries shorter steps and comes closer.
    let (trajectory, error) = Simulation::new(&system).adaptive(1e-6, 1e-6).max_steps(2000).attempt(q, z, 0.0..2.0);
    let error = error.expect("stops");
    assert!(error.time > 0.999 && error.time <= 1.0 && error.time == trajectory.last().t, "{error}");
}

/// A jump is on the constraints again no farther from what was set than it went itself; what is farther is not its
/// projection.
#[test]
fn a_jump_is_not_projected_farther_than_it_goes() {
    let system = pendulum::<f64>(2.0);
    let two = |x: f64, y: f64| SVector::from([x, y]);
    let before = Sample { t: 0.0, q: two(0.0, -1.0), z: two(1.0, 0.0), p: two(2.0, 0.0) };
    let check =
        |q, z, projected| check_jump(&system, &before, &Sample { q, z, p: 2.0 * z, ..before }, (&projected, &(0..1)));
    let told =
        |level| move |kind| matches!(kind, IntegrationErrorKind::ProjectionTooFar { level: of, .. } if of == level);
    // Off the circle and back, and to its other side.
    assert_eq!(check(two(0.0, -1.1), before.z, (before.q, before.z)), Ok(()));
    let across = check(two(0.0, -1.1), before.z, (two(0.0, 1.0), before.z));
    assert!(across.is_err_and(told(ConstraintLevel::Position)));
    // What a jump adds across the circle goes, and no more than that.
    assert_eq!(check(before.q, two(1.0, 0.5), (before.q, before.z)), Ok(()));
    assert_eq!(check(before.q, two(3.0, 0.0), (before.q, two(3.0, 0.0))), Ok(()));
    let gone = check(before.q, two(1.0, 0.5), (before.q, two(0.0, 0.0)));
    assert!(gone.is_err_and(told(ConstraintLevel::Velocity)));
    let rounded = check(before.q, before.z, (before.q, two(1.0 - 1e-6, 0.0)));
    assert!(rounded.is_err_and(told(ConstraintLevel::Velocity)));
    assert_eq!(check(before.q, before.z, (before.q, two(1.0 - 1e-9, 0.0))), Ok(()));
    // As a run has it: a kick across the circle is taken by the rod.
    let run = Simulation::new(&system).event(Crossing::Rising, |t, _, _| t - 0.5).then(|state| state.z += state.q);
    let (q, z) = swing();
    let end = run.adaptive(1e-10, 1e-10).run_to_end(q, z, 0.0..1.0).expect("runs");
    assert!(on_the_circle(&end));
}
