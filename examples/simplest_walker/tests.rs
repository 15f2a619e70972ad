//! The claims of the example `simplest_walker`: its gaits, and the multipliers of small deviations.

use crate::model::{FOOT, Gait, LONG, SHORT, step, walk};

#[test]
fn gaits_and_multipliers_are_those_of_the_limit() {
    let long = Gait::find(FOOT, 0.009, LONG).unwrap();
    // Published to 1e-10 (Garcia et al. 1998).
    assert!(
        (long.start[0] - 0.200_310_900_494_83).abs() < 1e-10 && (long.start[1] + 0.199_832_472_917_64).abs() < 1e-10
    );
    // The published equations of the limit with dual numbers, by the classical method of Runge and Kutta with steps of
    // 5e-4 (Python): digits that steps of 1e-3 leave. Runs here are known to some 1e-12, of slopes up to 10.
    assert!(
        (long.start[0] - 0.200_310_900_544_25).abs() < 1e-12 && (long.start[1] + 0.199_832_473_004_95).abs() < 1e-12
    );
    for multiplier in long.multipliers() {
        assert!((multiplier.re + 0.190_099_841_066).abs() < 1e-10, "{multiplier}");
        assert!((multiplier.im.abs() - 0.557_598_776_682).abs() < 1e-10, "{multiplier}");
    }
    let short = Gait::find(FOOT, 0.009, SHORT).unwrap();
    assert!((short.start[0] - 0.193_937_369_81).abs() < 1e-9, "{short:?}");
    // Published with four digits: 4.000 and 0.459.
    let [small, large] = short.multipliers().map(|m| m.re);
    assert!((small.max(large) - 4.0).abs() < 5e-3 && (small.min(large) - 0.459).abs() < 1e-3, "{small} {large}");
}

/// Differences of whole steps, with derivatives of a step that hits the ground far from the gait.
#[test]
fn derivatives_of_a_step_are_those_of_differences() {
    let start = [0.22, -0.225];
    let (end, derivative) = step(FOOT, 0.012, start).unwrap();
    let plain = |start| walk(FOOT, 0.012, start, |_| {}, 1).unwrap();
    assert!((0..2).all(|i| (plain(start)[i] - end[i]).abs() < 1e-12));
    for k in 0..2 {
        let central = |step: f64| {
            let mut both = [start; 2];
            both[0][k] += step;
            both[1][k] -= step;
            let [after, before] = both.map(plain);
            [0, 1].map(|i| (after[i] - before[i]) / (2.0 * step))
        };
        let (fine, coarse) = (central(2e-4), central(4e-4));
        for i in 0..2 {
            let slope = (4.0 * fine[i] - coarse[i]) / 3.0;
            // Errors of runs, 1e-11, over the step; h⁴ of a fifth derivative up to 1e6.
            assert!((derivative[(i, k)] - slope).abs() < 1e-6, "{i} {k}: {} {slope}", derivative[(i, k)]);
        }
    }
}
