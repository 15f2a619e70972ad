//! The claims of the example `contact_gradients`: which law has which derivatives through contact.

use crate::laws::{LAWS, STEP, difference};
use crate::model::{G, THROWS};

#[test]
fn runs_from_event_to_event_have_the_derivatives_of_closed_forms() {
    let (_, events) = LAWS[0];
    for throw in &THROWS {
        let (found, truth) = (events(&throw.varied()).unwrap(), throw.exact());
        // Tolerances of 1e-10 for each of some hundred steps; ends of slips are as sharp as a slip that counts as rest.
        assert!((found.value - truth.value).abs() < 1e-7, "{}: {} {}", throw.name, found.value, truth.value);
        for &k in throw.by {
            let off = (found.slopes[k] - truth.slopes[k]).abs();
            assert!(off < 1e-6, "{} {k}: {} {}", throw.name, found.slopes[k], truth.slopes[k]);
        }
    }
}

#[test]
fn steps_have_their_own_derivatives_and_do_not_know_when_a_body_lands() {
    let (_, steps) = LAWS[1];
    for throw in &THROWS {
        let (found, truth) = (steps(&throw.varied()).unwrap(), throw.exact());
        for &k in throw.by {
            // Of the first order in the step where forces depend on speeds: a stop is found to a step of it.
            let order = 2.0 * STEP * (1.0 + truth.slopes[k].abs()) * G;
            let off = (found.slopes[k] - truth.slopes[k]).abs();
            if throw.name == "falls, slides" && k == 1 {
                // The speed at the impact is that of whole steps: a height more does not change it.
                assert!(found.slopes[k].abs() < order && off > 0.2, "{} {}", found.slopes[k], truth.slopes[k]);
            } else {
                assert!(off < order, "{} {k}: {} {}", throw.name, found.slopes[k], truth.slopes[k]);
            }
            let own = difference(steps, throw, k).unwrap();
            // Stops move by a step here and there: what differences of a sum of steps see.
            assert!((own - found.slopes[k]).abs() < order, "{} {k}: {own} {}", throw.name, found.slopes[k]);
        }
    }
}
