//! Orders, what is kept, numbers of evaluations.

use nalgebra::{SVector, UnitQuaternion};
use std::vec::Vec;

use super::*;
use crate::integrate::{Feedback, Fixed, SystemProblem, VelocityForm};
use crate::testing::FreeTop;
use crate::testing::order::{TOP, TORQUE, Torque, WEIGHT, distance, fitted_order, start_by_velocity};

fn run(control: &impl Control<FreeTop<f64>>, torque: Feedback<Torque>, end: f64) -> State<FreeTop<f64>> {
    let problem = SystemProblem { system: &TOP, form: VelocityForm, input: torque };
    let nobody = &mut |_: &State<_>, _: &Rates<_>, _| core::ops::ControlFlow::Continue(());
    control.drive(&problem, start_by_velocity(), end, 100_000, nobody).expect("a smooth run")
}

fn order<const K: usize>(steps: [f64; 4]) -> f64 {
    let span = 4.0;
    let exact = run(&Fixed::new(span / 4000.0), TORQUE, span);
    let points: Vec<_> =
        steps.iter().map(|n| (span / n, distance(&run(&Adams::<_, K>::new(span / n), TORQUE, span), &exact))).collect();
    fitted_order(&points, 64.0 * f64::EPSILON)
}

/// The torque depends on everything. Slopes of finite steps are within 0.6 of the order.
#[test]
fn errors_fall_with_the_order() {
    for (measured, expected) in [
        (order::<2>([100.0, 200.0, 400.0, 800.0]), 3.0),
        (order::<4>([80.0, 120.0, 200.0, 400.0]), 5.0),
        (order::<6>([60.0, 80.0, 120.0, 200.0]), 7.0),
        (order::<8>([60.0, 80.0, 100.0, 140.0]), 9.0),
    ] {
        assert!((measured - expected).abs() < 0.6, "{measured} {expected}");
    }
}

/// The last step is shorter where the length does not fit; backwards is as good as forwards.
#[test]
fn runs_end_where_they_should() {
    for end in [3.0, -3.0, 2.9999, 0.3, 0.01] {
        let exact = run(&Fixed::new(0.01), WEIGHT, end);
        let state = run(&Adams::<_, 8>::new(0.03), WEIGHT, end);
        assert_eq!(state.t, end);
        assert!(distance(&state, &exact) < 1e-9, "{end}: {}", distance(&state, &exact));
    }
}

/// One evaluation before the first step, one ahead and one at the end of each; the first nine are four of twelve
/// evaluations, and five states between.
#[test]
fn a_step_needs_two_evaluations() {
    const STEPS: u32 = 50;
    let count = core::cell::Cell::new(0);
    let input = Feedback(|t: f64, q: &UnitQuaternion<f64>, z: &SVector<f64, 3>| {
        count.set(count.get() + 1);
        WEIGHT.0(t, q, z)
    });
    let problem = SystemProblem { system: &TOP, form: VelocityForm, input };
    let nobody = &mut |_: &State<_>, _: &Rates<_>, _| core::ops::ControlFlow::Continue(());
    let end = f64::from(STEPS) * 0.0625;
    let run = Adams::<_, 10>::new(0.0625).drive(&problem, start_by_velocity(), end, 100, nobody);
    assert!(run.is_ok());
    assert_eq!(count.get(), 1 + 4 * 12 + 5 + 2 * (STEPS - 9));
}

/// The first steps are made two or three at once: what lies between is as good as their ends. With steps of 2⁻⁵
/// Hermite's polynomial of K = 10 is off by 87 ε next to the start, in proportion to the tenth power: a thousandth of
/// that is below rounding, which is 64 ε here.
#[test]
fn states_between_the_first_steps_are_those_of_the_motion() {
    fn check<const K: usize>() {
        let h = 1.0 / 64.0;
        let mut states = Vec::new();
        let problem = SystemProblem { system: &TOP, form: VelocityForm, input: WEIGHT };
        let keep = &mut |state: &State<_>, _: &Rates<_>, _| {
            states.push(*state);
            core::ops::ControlFlow::Continue(())
        };
        Adams::<_, K>::new(h).drive(&problem, start_by_velocity(), 20.0 * h, 20, keep).expect("runs");
        assert_eq!(states.len(), 21);
        for (n, state) in states.iter().enumerate().take(K).skip(1) {
            assert_eq!(state.t, n as f64 * h);
            let error = distance(state, &run(&Fixed::new(h / 8.0), WEIGHT, state.t));
            assert!(error < 64.0 * f64::EPSILON, "{K} steps, state {n}: {error:e}");
        }
    }
    check::<9>();
    check::<10>();
    check::<11>();
    check::<12>();
}

/// Quaternions keep norm 1, and a run too coarse to be stable ends with an error or a finite state, not with a panic.
#[test]
fn norms_are_kept_and_long_steps_do_no_harm() {
    let state = run(&Adams::<_, 10>::new(0.05), WEIGHT, 500.0);
    assert!((state.q.quaternion().norm() - 1.0).abs() < 4.0 * f64::EPSILON);
    let problem = SystemProblem { system: &TOP, form: VelocityForm, input: WEIGHT };
    let nobody = &mut |_: &State<_>, _: &Rates<_>, _| core::ops::ControlFlow::Continue(());
    let coarse = Adams::<_, 12>::new(0.7).drive(&problem, start_by_velocity(), 200.0, 1000, nobody);
    let finite = |state: State<FreeTop<f64>>| state.q.is_finite() && VectorSpace::<f64>::is_finite(&state.y);
    assert!(coarse.map_or(true, finite));
}
