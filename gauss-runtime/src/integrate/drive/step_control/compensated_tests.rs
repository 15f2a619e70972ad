//! Steps with and without what is carried; how rounding grows is in `tests/long_runs`.

use nalgebra::SVector;

use super::*;
use crate::integrate::{Crossing, Fixed, Simulation};
use crate::testing::order::{NONE, TOP, start_by_velocity};

#[test]
fn but_for_rounding_it_is_the_same_method() {
    let start = start_by_velocity();
    let run = Simulation::new(&TOP).input_from(NONE);
    let a =
        run.control(Compensated::with(&Tableau::DORMAND_PRINCE_5, 0.3)).run(start.q, start.y, 0.0..4.0).expect("runs");
    let b = run.control(Fixed::with(&Tableau::DORMAND_PRINCE_5, 0.3)).run(start.q, start.y, 0.0..4.0).expect("runs");
    assert_eq!(a.len(), b.len());
    for (a, b) in a.iter().zip(&b) {
        assert!(a.t == b.t && a.q.difference(&b.q).norm() < 1e-14 && (a.z - b.z).amax() < 1e-14);
    }
    let events = run.event(Crossing::Any, |_, _, z: &SVector<f64, 3>| z[1]);
    let events = events.control(Compensated::with(&Tableau::RK4, 0.05)).run(start.q, start.y, 0.0..40.0).expect("runs");
    assert!(
        events.events().len() > 1
            && events.events().iter().all(|event| event.sample.z[1].abs() < 8.0 * f64::EPSILON * event.sample.t)
    );
    // Errors are those of the method.
    let broken = Simulation::new(&TOP).input(|t, _, _| [if t > 1.0 { f64::NAN } else { 0.0 }; 3]);
    let error =
        broken.control(Compensated::with(&Tableau::RK4, 0.1)).run(start.q, start.y, 0.0..2.0).expect_err("stops");
    assert_eq!(error.kind, IntegrationErrorKind::NonFinite { part: RunPart::Step });
}
