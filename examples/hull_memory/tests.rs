//! The example `hull_memory`: states of radiated waves against the convolution that they stand for.

use gauss_runtime::prelude::*;

use crate::hull::{Hull, HullState};

#[test]
fn states_are_the_convolution_over_the_run() {
    let hull = Hull::boat();
    let kernel = hull.kernel().unwrap();
    let pose = Isometry3::new(Vector3::new(0.0, 0.0, 0.25), Vector3::new(0.0, -0.3, 0.1));
    let start = HullState { pose, u: Vector3::new(0.5, 0.1, -0.2), ..Default::default() };
    let run = Simulation::new(&kernel).input(|t, _: &_, _: &_| SVector::from([60.0 * f64::sin(t)]));
    let run = run.adaptive(1e-11, 1e-11).run(start.q(), start.z(), 0.0..6.0).unwrap();
    for t in [0.5, 1.7, 3.9, 6.0] {
        let (states, integral) = (hull.by_states(&run.at(t).unwrap()), hull.by_convolution(&run, t, 4000).unwrap());
        for (found, expected) in states.into_iter().zip(integral) {
            // Forces up to 200. Simpson's rule alone is off by (h/t)⁴ of that, 1e-12; what is interpolated between
            // steps has the third derivatives of speeds missing, at steps of 0.01 some 1e-8 of it.
            assert!((found - expected).abs() < 1e-5, "{t}: {found} for {expected}");
        }
    }
    // A propeller that is late by 0.8 s: ẏ = (60 sin t − y)/lag.
    let (lag, t) = (hull.lag, 6.0_f64);
    let exact = 60.0 * (t.sin() - lag * t.cos() + lag * (-t / lag).exp()) / (1.0 + lag * lag);
    let end = run.at(t).unwrap();
    assert!((HullState::of(&end.q, &end.z).thrust - exact).abs() < 1e-7);
}

#[test]
fn a_heaving_hull_follows_cummins_equation() {
    let hull = Hull { k35: 0.0, ..Hull::boat() };
    let kernel = hull.kernel().unwrap();
    let start = HullState { pose: Isometry3::translation(0.0, 0.0, 0.1), ..Default::default() };
    let run = Simulation::new(&kernel).input(|_, _: &_, _: &_| SVector::from([0.0])).adaptive(1e-11, 1e-11);
    let end = run.run_to_end(start.q(), start.z(), 0.0..4.0).unwrap();
    let found = HullState::of(&end.q, &end.z).pose.translation.z;
    let marched = |steps: usize| hull.heave_by_history(0.1, 4.0 / steps as f64, steps)[steps];
    let [coarse, fine, finer] = [1000, 2000, 4000].map(marched);
    // Of the second order: errors fall fourfold, up to terms of the fourth, (4e-3 · 4.3/s)² of them.
    let ratio = (coarse - found) / (fine - found);
    assert!((ratio - 4.0).abs() < 1e-2, "{ratio}");
    // Without the term of second order what is left is of the fourth: (2e-3 · 4.3/s)⁴ · 0.1 m, with a constant of the
    // order of the periods, three.
    let better = (4.0 * finer - fine) / 3.0;
    assert!((better - found).abs() < 1e-8, "{better} for {found}");
}
