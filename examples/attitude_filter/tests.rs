//! The filter of the example `attitude_filter`: its transition against differences of the very prediction, its update
//! against the closed form on three axes, and its consistency.

use gauss_charts::statistics::Random;
use gauss_runtime::prelude::*;

use crate::filter::{Estimate, Transition};
use crate::model::{DISTURBANCE, FIRST, LOOKS, STEP, STEPS, TRACKER, happens, nominal, spacecraft};
use crate::study::{DIMENSION, Followed, interval};

/// Ten steps of the filter are a map whose derivatives carry the covariance: differences of that map say the same.
#[test]
fn the_covariance_goes_with_the_prediction() {
    let kernel = spacecraft().kernel().unwrap();
    let predicted = |x: &Vector6<f64>| {
        let mut estimate = Estimate::first();
        let (q, z) = nominal();
        estimate.state = kernel.retract(&q, &z, x);
        estimate.predict(&kernel, 0, Transition::Exact, |_| ()).unwrap();
        estimate
    };
    let here = predicted(&Vector6::zeros());
    let size = 1e-4;
    let mut flow = Matrix6::zeros();
    for k in 0..6 {
        let axis = Vector6::ith(k, size);
        let (ahead, back) = (predicted(&axis), predicted(&-axis));
        flow.set_column(k, &((here.error(&kernel, &ahead.state) - here.error(&kernel, &back.state)) / (2.0 * size)));
    }
    let first = Estimate::first().covariance;
    let without_noise = flow * first * flow.transpose();
    // The unknown torque adds at most a little: its share of rates over ten seconds, and what that turns by.
    let noise = DISTURBANCE * DISTURBANCE * STEP * STEPS as f64 / 0.5_f64.powi(2);
    let seconds = STEP * STEPS as f64;
    let added = here.covariance - without_noise;
    for i in 0..6 {
        for j in 0..6 {
            let scale = |i: usize| if i < 3 { seconds } else { 1.0 };
            // Differences are off by size² times third derivatives: rates enter over T as (T δω)³.
            let differences =
                (seconds * size).powi(2) * without_noise.diagonal().map(f64::sqrt)[i] * FIRST.0.max(seconds * FIRST.1);
            assert!(added[(i, j)].abs() < noise * scale(i) * scale(j) + differences, "({i}, {j}): {:e}", added[(i, j)]);
        }
    }
    assert!(added.trace() > 0.0);
}

/// With independent axes an update weighs prior and measurement by their variances.
#[test]
fn a_look_weighs_by_variances() {
    let (kernel, mut estimate) = (spacecraft().kernel().unwrap(), Estimate::first());
    let seen = nominal().0.retract(&Vector3::new(1e-3, -2e-3, 5e-4));
    estimate.look(&kernel, &seen).unwrap();
    let prior = FIRST.0 * FIRST.0;
    let moved = nominal().0.difference(&estimate.state.0);
    let expected = nominal().0.difference(&seen);
    for i in 0..3 {
        let noise = TRACKER[i] * TRACKER[i];
        // The sum of two variances, a quotient, an exponential and a logarithm.
        assert!((moved[i] - expected[i] * prior / (prior + noise)).abs() < 20.0 * f64::EPSILON);
        // The axes of the new estimate are turned by half of the change: e₃, which is seen worst, enters the others to
        // second order.
        let variance = estimate.covariance[(i, i)] / (prior * noise / (prior + noise));
        let turned = moved.norm_squared() * (TRACKER[2] / TRACKER[i]).powi(2);
        assert!((variance - 1.0).abs() < turned + 1e-9, "{i}: {variance}");
    }
    assert_eq!(estimate.state.1, nominal().1);
    assert_eq!(
        estimate.covariance.fixed_view::<3, 3>(3, 3).into_owned(),
        Matrix3::from_diagonal_element(FIRST.1 * FIRST.1)
    );
}

/// Only the derivatives of the step leave the filter knowing how wrong it is.
#[test]
fn the_filter_knows_how_wrong_it_is() {
    let kernel = spacecraft().kernel().unwrap();
    let mut random = Random(2);
    let motions: Vec<_> = (0..40).map(|_| happens(&kernel, &mut random).unwrap()).collect();
    let follow = |transition| Followed::new(&kernel, &motions, transition).unwrap();
    let exact = follow(Transition::Exact);
    let (low, high) = interval(motions.len());
    let looks = exact.after_looks();
    // 57 of 60 are expected within, ±1.7 if looks were independent; neighbours are not quite, so more than thrice that
    // is allowed.
    let within = looks.iter().filter(|look| (low..high).contains(&look.normalised)).count();
    assert!(looks.len() == LOOKS && within >= 51, "{within}");
    let (mean, error) = exact.settled();
    assert!((mean - DIMENSION).abs() < 3.5 * error, "{mean} ± {error}");
    // Until the second look the rate is what is not known, and the first order of T ω = 0.5 is off by a tenth of T δω.
    let rough = follow(Transition::FirstOrderPerLook);
    assert!(rough.after_looks()[1].normalised > 10.0 * high, "{}", rough.after_looks()[1].normalised);
}
