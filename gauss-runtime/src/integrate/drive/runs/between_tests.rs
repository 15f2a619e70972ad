//! States between samples, against runs that end there.

use nalgebra::SVector;
use std::vec::Vec;

use crate::configuration::Configuration;
use crate::integrate::tests::slope;
use crate::integrate::{Crossing, Fixed, IntegrationErrorKind, Sample, Simulation, Tableau};
use crate::testing::FreeTop;
use crate::testing::constrained::pendulum;
use crate::testing::order::{TOP, TORQUE, start_by_velocity};

fn exact(t: f64) -> Sample<FreeTop<f64>> {
    let start = start_by_velocity();
    let run = Simulation::new(&TOP).input_from(TORQUE).control(Fixed::with(&Tableau::DORMAND_PRINCE_8, 0.01));
    run.run_to_end(start.q, start.y, 0.0..t).expect("runs").sample
}

fn distance(a: &Sample<FreeTop<f64>>, b: &Sample<FreeTop<f64>>) -> f64 {
    a.q.difference(&b.q).norm().max((a.z - b.z).amax()).max((a.p - b.p).amax())
}

#[test]
fn between_samples_the_order_is_that_of_the_method() {
    let start = start_by_velocity();
    let run = Simulation::new(&TOP).input_from(TORQUE);
    let mut by_steps = Vec::new();
    for h in [0.5, 0.4, 0.3, 0.2] {
        let control = Fixed::with(&Tableau::DORMAND_PRINCE_8, h);
        let dense = run.control(control).momentum_form().run(start.q, start.y, 0.0..3.0).expect("runs");
        let t = dense.get(4).expect("enough").t + 0.4 * h;
        let exact = exact(t);
        by_steps.push((h, distance(&dense.at(t).expect("inside"), &exact)));
    }
    assert!(slope(&by_steps) > 7.5, "{by_steps:?}");
}

#[test]
fn samples_apart_events_and_both_directions() {
    let start = start_by_velocity();
    let run = Simulation::new(&TOP).input_from(TORQUE).until(Crossing::Falling, |t, _, _| 2.345 - t);
    let run = run.event(Crossing::Any, |t, _, _| t - 1.0).adaptive(1e-11, 1e-11);
    for every in [1, 5] {
        let dense = run.every(every).run(start.q, start.y, 0.0..3.0).expect("runs");
        assert!((dense.last().t - 2.345).abs() < 4e-15 && dense.events().len() == 2);
        for t in [0.0, 0.123, 1.0, 1.777, 2.3] {
            let found = dense.at(t).expect("inside");
            assert_eq!(found.t, t);
            // A hundred steps of errors of 1e-11.
            assert!(distance(&found, &exact(t)) < 1e-9, "{every} {t}");
        }
        let last = *dense.last();
        assert_eq!(distance(&dense.at(last.t).expect("inside"), &last), 0.0);
        for t in [-0.1, 2.4, f64::NAN] {
            let error = dense.at(t).expect_err("outside");
            assert!(matches!(error.kind, IntegrationErrorKind::OutsideRun { .. }), "{error}");
        }
        let back = Simulation::new(&TOP).input_from(TORQUE).adaptive(1e-11, 1e-11).every(every);
        let back = back.run(last.q, last.z, last.t..0.0).expect("runs");
        assert!(distance(&back.at(1.234).expect("inside"), &exact(1.234)) < 1e-9);
    }
}

#[test]
fn what_is_between_satisfies_constraints() {
    let system = pendulum::<f64>(2.0);
    let (q, z) = (SVector::from([0.0, -1.0]), SVector::from([3.0, 0.0]));
    let run = Simulation::new(&system).fixed_step(0.1);
    let dense = run.run(q, z, 0.0..2.0).expect("runs");
    for n in 0..40 {
        let sample = dense.at(0.05 * f64::from(n)).expect("inside");
        // Of squares of lengths near 1, and of speeds up to 3 times them.
        let residual = (sample.q.norm() - 1.0).abs().max(sample.q.dot(&sample.z).abs());
        assert!(residual < 16.0 * f64::EPSILON * 3.0, "{n}: {residual:e}");
        // A run that ends there makes the same steps and a shorter one.
        let alone = run.run_to_end(q, z, 0.0..sample.t).expect("runs");
        // Only a few roundings of 20 steps differ, of numbers up to 3.
        let apart = (sample.q - alone.q).amax().max((sample.z - alone.z).amax());
        assert!(apart < 4.0 * 20.0 * f64::EPSILON * 3.0, "{apart:e}");
    }
}
