//! The claims of the example `held_ball`: a ball that is held does not creep by a bit, its weight is carried, and it
//! slides where friction is less than that needs.

use std::error::Error;

use crate::hand::{Hand, STEP, hold};
use gauss_runtime::prelude::*;

#[test]
fn a_held_ball_does_not_creep() -> Result<(), Box<dyn Error>> {
    let hand = Hand::around_a_ball(0.8);
    let kernel = hand.kernel()?;
    let (mut settled, mut carried, mut needed) = (None, 0.0, 0.0);
    hold(&hand, &kernel, (6.0 / STEP) as usize, |stepper| {
        let (t, q, report) = (stepper.time(), stepper.configuration(), stepper.report().residual);
        // Laws are solved until a solution is within 1e-12 of the largest rate, some m/s while it closes; gaps are
        // rounded at the size of coordinates, 0.1 m, a few times for each joint of a finger.
        let worst = report.signorini.max(report.coulomb).max(report.dissipation);
        assert!(worst < 1e-11 && kernel.gaps(0.0, q).min() > -1e-14, "{worst} m/s at {t} s");
        // Speeds of 1e-13 m/s are brought to rest by roundings of accelerations, ε g h = 1e-18 m/s a few dozen times in
        // each step: that takes some thousand steps.
        if t > 5.0 {
            let place = q.0.translation.vector;
            assert_eq!(place, *settled.get_or_insert(place), "it creeps at {t} s");
            let forces = (0..4).filter_map(|i| {
                let rows: Vec<f64> = stepper.impulses().as_slice()[3 * i..3 * i + 3].iter().map(|p| p / STEP).collect();
                kernel.contact_frame(i, t, q).map(|frame| frame.force(&rows))
            });
            // Whichever of both a contact pushes: here all push the ball up.
            carried = forces.map(|force| force.z.abs()).sum();
            needed = stepper.impulses()[1].hypot(stepper.impulses()[2]) / stepper.impulses()[0];
        }
    })?;
    // At rest nothing but the weight is carried; impulses are rounded at the size of normal forces, 2 N, some tens of
    // times, and speeds of 1e-13 m/s in each step of 5e-4 s are 1e-10 m/s².
    assert!((carried - hand.heavy * hand.g).abs() < 1e-10, "{carried} N");

    // By Coulomb's law. The weight comes at once at the start, and loads what bends under it by up to twice as much.
    for (friction, stays) in [(2.5 * needed, true), (0.9 * needed, false)] {
        let hand = Hand::around_a_ball(friction);
        let mut lowest = 0.0_f64;
        let ended = hold(&hand, &hand.kernel()?, (0.5 / STEP) as usize, |stepper| {
            lowest = lowest.min(stepper.configuration().0.translation.z);
        });
        assert!(ended.is_ok() || !stays, "{ended:?}");
        // It sags by 2 mm, as its fingers bend.
        assert_eq!(lowest > -4e-3, stays, "{lowest} m with {friction}");
    }
    Ok(())
}
