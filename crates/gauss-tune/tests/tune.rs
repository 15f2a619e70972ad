//! What tune chooses meets the error, by an independent measure; and what it refuses.

use std::cell::Cell;

// Modules that the included ones know as those of their crate.
use gauss_runtime::{chart, configuration, constraint, description, forces, integrate, real, system};

#[path = "../../../gauss-runtime/src/testing/mod.rs"]
#[allow(dead_code, reason = "tests of the runtime need more")]
mod testing;
#[path = "../../../gauss-runtime/src/triple.rs"]
#[allow(dead_code, reason = "the runtime needs more")]
mod triple;

use gauss_runtime::integrate::{Collocation, Fixed};
use gauss_runtime::prelude::*;
use gauss_tune::{Candidate, EitherForm, Method, Tune, TuneError};

use crate::testing::order::{TOP, TORQUE, start_by_velocity};

#[test]
fn what_is_chosen_meets_the_error_and_is_the_cheapest() {
    let start = start_by_velocity();
    let scene = Simulation::new(&TOP).input_from(TORQUE);
    let exact = scene.control(Fixed::with(&Tableau::DORMAND_PRINCE_8, 0.01));
    let exact = exact.run_to_end(start.q, start.y, 0.0..8.0).expect("runs");
    for wanted in [1e-3, 1e-6, 1e-10] {
        let tuned = scene.tune(start.q, start.y, 0.0..8.0, 0.0, wanted).expect("found");
        assert!(tuned.disagreement <= 0.1 && tuned.best == tuned.candidates[0] && tuned.best.error <= 1.0);
        assert_eq!(tuned.candidates.len(), 16, "{tuned}");
        for candidate in tuned.candidates.iter().filter(|candidate| candidate.error <= 1.0) {
            let end = scene.tuned(candidate).run_to_end(start.q, start.y, 0.0..8.0).expect("runs");
            let error = end.q.difference(&exact.q).max_norm().max((end.z - exact.z).amax());
            // The end is one of the times at which errors were measured, against a reference that is off by a tenth at
            // most.
            assert!(error <= wanted * (candidate.error + 0.1), "{candidate:?}: {error:e}");
            assert!(candidate.seconds >= tuned.best.seconds && candidate.steps > 0);
        }
    }
}

#[test]
fn figures_are_what_a_run_costs() {
    let start = start_by_velocity();
    let scene = Simulation::new(&TOP).input_from(TORQUE);
    let tuned = scene.tune(start.q, start.y, 5.0..1.0, 1e-6, 1e-6).expect("found");
    for candidate in &tuned.candidates {
        let count = Cell::new(0);
        let counted = scene.input(|t, q: &_, z: &_| {
            count.set(count.get() + 1);
            (TORQUE.0)(t, q, z)
        });
        let mut samples = 0;
        let seen =
            counted.observe(|_| samples += 1).tuned(candidate).run_to_end(start.q, start.y, 5.0..1.0).expect("runs");
        assert_eq!((seen.t, samples - 1, count.get()), (1.0, candidate.steps, candidate.evaluations), "{candidate:?}");
    }
    // One line each, with a heading and a remark.
    assert_eq!(tuned.to_string().lines().count(), tuned.candidates.len() + 2);
}

#[test]
fn what_cannot_be_measured_is_refused_in_words() {
    let start = start_by_velocity();
    let scene = Simulation::new(&TOP).input_from(TORQUE);
    for (relative, absolute) in [(0.0, 0.0), (f64::NAN, 1.0), (1e-6, -1.0)] {
        let error = scene.tune(start.q, start.y, 0.0..1.0, relative, absolute).expect_err("refused");
        assert_eq!(error, TuneError::InvalidTolerance);
    }
    let error = scene.tune(start.q, start.y, 0.0..8.0, 0.0, 1e-17).expect_err("refused");
    assert!(matches!(error, TuneError::NoReference { .. }), "{error}");
    let bad = SVector::from([f64::NAN, 0.0, 0.0]);
    let error = scene.tune(start.q, bad, 0.0..8.0, 0.0, 1e-6).expect_err("refused");
    assert!(error.to_string().contains("initial state"), "{error}");
}

#[test]
fn a_method_of_ones_own_is_measured_in_the_same_way() {
    let start = start_by_velocity();
    let scene = Simulation::new(&TOP).input_from(TORQUE).momentum_form();
    let interval = 0.0..8.0;
    let make = |step| Fixed::by(Collocation::order_6(), step);
    let found = scene.tune_steps(start.q, start.y, interval.clone(), (0.0, 1e-6), 6, make).expect("found");
    let tuned = scene.tune(start.q, start.y, interval, 0.0, 1e-6).expect("found");
    let same = |c: &&Candidate<f64>| matches!(c.method, Method::Gauss6 { .. }) && c.form == EitherForm::Momentum;
    let listed = tuned.candidates.iter().find(same).expect("listed");
    assert_eq!((found.error, found.evaluations, found.steps), (listed.error, listed.evaluations, listed.steps));
    let never = scene.tune_steps(start.q, start.y, 0.0..8.0, (0.0, 1e-10), 1, |step: f64| Fixed::new(step.max(1.0)));
    assert!(matches!(never, Err(TuneError::NoCandidate)));
}
