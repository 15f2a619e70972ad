//! The claims of the example `kirchhoff_vs_newton_euler`, on its first seconds.

use gauss_charts::measure::{
    Comparison, EVERYDAY_STEP, Fleet, PRECISE_RATE, energy_drift, largest_difference, largest_energy_drift,
    momenta_with_the_same_bits, momentum_drift, reversals, symmetric_momentum_drift,
};
use gauss_charts::{figure, report, timing};

/// Length of the runs, s.
const DURATION: f64 = 5.0;
/// Distance of the vehicle from Ω, m, rounded up.
const FAR: f64 = 75.0;

fn largest(series: &[(f64, f64)]) -> f64 {
    series.iter().map(|p| p.1).fold(0.0, |a, b| if b > a || b.is_nan() { b } else { a })
}

#[test]
fn four_charts_give_one_motion() {
    let comparison = Comparison::of(&Fleet::published().unwrap(), DURATION).unwrap();
    let steps = DURATION * f64::from(PRECISE_RATE);

    // Rounding: a position of size `FAR` is rounded once a step; speeds are of order 1 m/s and 1 rad/s and their
    // roundings are carried on for the length of the run. In the right-invariant chart u is a difference of numbers of
    // size `FAR`, and solving for ξ̂˙ multiplies by the lever once more.
    for run in &comparison.precise {
        let lever = if run.name == "Newton–Euler" { FAR * FAR } else { FAR };
        let rounding = f64::EPSILON * lever * steps * DURATION;
        let (metres, radians) = largest_difference(run, &comparison.reference);
        assert!(metres <= rounding, "{}: {metres:e} m against {rounding:e}", run.name);
        assert!(radians <= rounding, "{}: {radians:e} rad against {rounding:e}", run.name);

        // The energy and the momenta are sums of a dozen products; as above, once a step.
        let rounding = 12.0 * f64::EPSILON * lever * steps;
        let energy = largest_energy_drift(run);
        assert!(energy <= rounding, "{}: energy {energy:e} against {rounding:e}", run.name);
        let (linear, angular) = symmetric_momentum_drift(run);
        assert!(linear <= rounding && angular <= rounding, "{}: {linear:e}, {angular:e}", run.name);
    }

    // A chart that is integrated differently errs differently: the agreement above is not that of a thing with itself.
    let fine = largest_difference(&comparison.precise[0], &comparison.reference).0;
    for run in &comparison.everyday {
        let (metres, radians) = largest_difference(run, &comparison.reference);
        assert!(metres > 100.0 * fine, "{}: order 4 is as good as order 8: {metres:e} m", run.name);
        assert!(metres < 1e-3 && radians < 1e-2, "{}: {metres:e} m, {radians:e} rad", run.name);
    }
    assert!(reversals(&comparison.reference) >= 2, "the report says that the vehicle swings");
}

#[test]
fn newton_euler_momenta_keep_their_bits() {
    let comparison = Comparison::of(&Fleet::published().unwrap(), DURATION).unwrap();
    let [kirchhoff, _, velocity, momentum] = comparison.weightless.as_slice() else { panic!("four runs") };

    let (same, of) = momenta_with_the_same_bits(momentum);
    assert_eq!(same, of);
    assert_eq!(of, 51);
    // In velocity form they are recomputed and are not the same any more: the comparison of bits can fail.
    assert!(momenta_with_the_same_bits(velocity).0 < of);

    // Pose and twist give them back up to the rounding of p → z → p, which cancels once with the lever.
    let rounding = 12.0 * f64::EPSILON * FAR;
    assert!(largest(&momentum_drift(momentum)) <= rounding, "{:e}", largest(&momentum_drift(momentum)));
    // The other forms drift with the error of the method, far above that.
    for run in [kirchhoff, velocity] {
        let drift = largest(&momentum_drift(run));
        assert!(drift > 100.0 * rounding && drift < 1e-4, "{}: {drift:e} at steps of {EVERYDAY_STEP}", run.name);
    }
    assert!(comparison.weightless.iter().all(|run| largest(&energy_drift(run)) < 1e-4));
}

#[test]
fn text_and_picture_show_every_chart() {
    let fleet = Fleet::published().unwrap();
    let comparison = Comparison::of(&fleet, DURATION).unwrap();
    let timings = timing::time(&fleet, &comparison.reference, 20).unwrap();
    assert_eq!(timings.len(), 12);
    for timing in &timings {
        let [low, median, high] = timing.quartiles;
        assert!(0.0 < low && low <= median && median <= high, "{timing:?}");
        assert!(timing.operations.total() > 0, "{timing:?}");
    }

    let text = [report::introduction(&fleet), report::costs(&timings), report::results(&comparison)]
        .map(Result::unwrap)
        .concat();
    let svg = figure::svg(&comparison, &timings).unwrap();
    for run in &comparison.precise {
        assert!(text.contains(run.name) && svg.contains(run.name), "{}", run.name);
        assert!(report::all_equations(&fleet).unwrap().contains(run.name));
    }
    assert!(!text.contains("NaN") && !svg.contains("NaN"));

    #[cfg(feature = "png")]
    {
        let png = gauss_charts::drawing::png(&svg).unwrap();
        // The signature, then the first chunk with width and height.
        assert_eq!(&png[..8], b"\x89PNG\r\n\x1a\n");
        assert_eq!(png[16..24], [0, 0, 6, 64, 0, 0, 5, 20]);
    }
}
