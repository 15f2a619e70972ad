//! Accuracy of the energy–momentum method, on a top typed by hand; tests of the integrals that it keeps are in
//! `tests/long_runs`.

use super::*;
use crate::integrate::SystemProblem;
use crate::integrate::{Composed, Composition, Feedback, Fixed, MomentumForm, Simulation, VelocityForm};
use crate::testing::order::{NONE, TOP, TORQUE, distance, march, measured_order, start_by_momentum, start_by_velocity};

fn method() -> EnergyMomentum<f64> {
    EnergyMomentum::new()
}

#[test]
fn orders_alone_and_composed() {
    let velocities = SystemProblem { system: &TOP, form: VelocityForm, input: TORQUE };
    let momenta = SystemProblem { system: &TOP, form: MomentumForm, input: TORQUE };
    let (v, p) = (start_by_velocity(), start_by_momentum());
    let composed = Composed::new(&Composition::KAHAN_LI_6, method());
    let five = EnergyMomentum::<f64, 5>::with_points();
    for (expected, found) in [
        (2.0, measured_order(&method(), &velocities, &v, 4.0, &[40, 80, 160, 320])),
        (2.0, measured_order(&method(), &momenta, &p, 4.0, &[40, 80, 160, 320])),
        (2.0, measured_order(&five, &momenta, &p, 4.0, &[40, 80, 160, 320])),
        (6.0, measured_order(&composed, &momenta, &p, 4.0, &[20, 40, 80, 160])),
    ] {
        assert!((found - expected).abs() < 0.2, "{found} instead of {expected}");
    }
}

#[test]
fn a_step_back_undoes_a_step() {
    let problem = SystemProblem { system: &TOP, form: MomentumForm, input: TORQUE };
    let start = State { t: 0.3, ..start_by_momentum() };
    for h in [0.05, 0.2, 0.4] {
        let there = march(&method(), &problem, &start, h, 1);
        let found = distance(&march(&method(), &problem, &there, -h, 1), &start);
        // Some thirty roundings each way, and what the iterations leave.
        assert!(found < 60.0 * f64::EPSILON, "h = {h}: {found:e}");
    }
}

/// Polynomials of degree 2N − 1 by the rule, `∫ x^k dx` over (−½, ½); with double-double coefficients not needed here.
#[test]
fn points_are_those_of_gauss() {
    fn check<const N: usize>() {
        let EnergyMomentum { offsets, weights, .. } = EnergyMomentum::<f64, N>::with_points();
        for k in 0..2 * N {
            let sum: f64 = offsets.iter().zip(&weights).map(|(x, w)| w * x.powi(k as i32)).sum();
            let exact = if k % 2 == 1 { 0.0 } else { 0.5_f64.powi(k as i32) / (k as f64 + 1.0) };
            assert!((sum - exact).abs() < 4.0 * f64::EPSILON * 0.5_f64.powi(k as i32), "{N} {k}: {sum} {exact}");
        }
    }
    check::<2>();
    check::<3>();
    check::<4>();
    check::<6>();
    check::<7>();
}

/// cos θs and sin θs about the middle, θ from nothing to π.
#[test]
fn what_turns_with_the_body_is_integrated_exactly() {
    for theta in [0.0_f64, 1e-300, 1e-9, 1e-3, 0.4, 1.0, 2.5, core::f64::consts::PI] {
        let c = method().spread(theta * theta);
        let exact = if theta == 0.0 { 1.0 } else { (0.5 * theta).sin() / (0.5 * theta) };
        assert!(((theta * c).cos() - exact).abs() <= 2.0 * f64::EPSILON, "{theta}: {c}");
    }
    assert!((method().spread(0.0) - (1.0_f64 / 12.0).sqrt()).abs() < f64::EPSILON);
}

/// Increments are what a step adds.
#[test]
fn increments_add_up_to_the_step() {
    for (form_start, h) in [(start_by_momentum(), 0.1), (State { t: 1.0, ..start_by_momentum() }, -0.3)] {
        let problem = SystemProblem { system: &TOP, form: MomentumForm, input: TORQUE };
        let rates = problem.rates(&form_start);
        let step = method().step(&problem, &form_start, &rates, h).expect("steps").state;
        let Rates { configuration, variables } = method().increment(&problem, &form_start, &rates, h).expect("steps");
        let again = State { t: step.t, q: form_start.q.retract(&configuration), y: form_start.y + variables };
        assert!(distance(&step, &again) < 4.0 * f64::EPSILON);
    }
}

#[test]
fn what_cannot_be_solved_is_refused() {
    let run = |z: [f64; 3], h| {
        let run = Simulation::new(&TOP).input_from(NONE).control(Fixed::by(method(), h));
        run.run_to_end(start_by_velocity().q, SVector::from(z), 0.0..1.0).map(|end| end.t)
    };
    let error = run([1.0, 60.0, 40.0], 0.2).expect_err("refused");
    assert!(
        matches!(
            error.kind,
            IntegrationErrorKind::NotConverged { .. } | IntegrationErrorKind::IncrementTooLarge { .. }
        ),
        "{error}"
    );
    let error = run([0.0, 0.0, 40.0], 0.1).expect_err("refused");
    assert!(matches!(error.kind, IntegrationErrorKind::IncrementTooLarge { .. }), "{error}");
    let broken = Feedback(|t: f64, _: &_, _: &_| [if t > 0.05 { f64::NAN } else { 0.0 }, 0.0, 0.0]);
    let run = Simulation::new(&TOP).input_from(broken).control(Fixed::by(method(), 0.2));
    let start = start_by_velocity();
    let error = run.run_to_end(start.q, start.y, 0.0..1.0).map(|end| end.t).expect_err("refused");
    assert_eq!(error.kind, IntegrationErrorKind::NonFinite { part: RunPart::Step });
}
