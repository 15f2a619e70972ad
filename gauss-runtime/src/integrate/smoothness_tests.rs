//! Adaptive steps where accelerations are not smooth: oscillators with kinks and jumps against their exact solutions,
//! which are arcs of sines.

use core::cell::Cell;
use core::f64::consts::PI;
use core::marker::PhantomData;

use nalgebra::SVector;
use std::vec::Vec;

use super::*;
use crate::system::Smoothness;
use crate::testing::oscillator::{Dry, ForceLaw, OneSided, Oscillator};

/// The same force, said to be smooth.
struct Concealed<L>(PhantomData<L>);

impl<L: ForceLaw> ForceLaw for Concealed<L> {
    const SMOOTHNESS: Smoothness = Smoothness::Smooth;
    fn force(x: f64, v: f64) -> f64 {
        L::force(x, v)
    }
}

/// A scene with its exact solution [x, ẋ], which starts with the solution's values at 0.
struct Scene {
    end: f64,
    /// The largest of |x| and |ẋ|.
    size: f64,
    exact: fn(f64) -> [f64; 2],
}

/// Half periods of π/3 and π: ω = 3 on one side of the stop, 1 on the other.
const STOP: Scene = Scene {
    end: 30.0,
    size: 1.0,
    exact: |t| {
        let phase = t % (PI / 3.0 + PI);
        match phase - PI / 3.0 {
            left if left < 0.0 => [(3.0 * phase).sin() / 3.0, (3.0 * phase).cos()],
            left => [-left.sin(), -left.cos()],
        }
    },
};

/// Each half period turns about ±½ and takes 1 from the amplitude; 20¼ lasts for 19 of them without sticking.
const FRICTION: Scene = Scene {
    end: 19.0 * PI,
    size: 20.25,
    exact: |t| {
        let swing = (t / PI).floor();
        let (phase, sign) = (t - swing * PI, if swing % 2.0 == 0.0 { 1.0 } else { -1.0 });
        let amplitude = 19.75 - swing;
        [sign * (0.5 + amplitude * phase.cos()), -sign * amplitude * phase.sin()]
    },
};

/// Result of a run: its largest error of x and ẋ, its steps, its evaluations.
struct Outcome {
    error: f64,
    steps: u32,
    evaluations: u32,
}

fn outcome<L: ForceLaw>(control: impl Control<Oscillator<L>>, scene: &Scene) -> Outcome {
    let (system, evaluations) = (Oscillator::<L>::new(0.0), Cell::new(0));
    let mut outcome = Outcome { error: 0.0, steps: 0, evaluations: 0 };
    let drive = |_: f64, _: &SVector<f64, 1>, _: &SVector<f64, 1>| {
        evaluations.set(evaluations.get() + 1);
        0.0
    };
    let look = |sample: &Sample<Oscillator<L>>| {
        let [x, v] = (scene.exact)(sample.t);
        outcome.error = outcome.error.max((sample.q[0] - x).abs()).max((sample.z[0] - v).abs());
        outcome.steps += 1;
    };
    let [x, v] = (scene.exact)(0.0).map(|component| SVector::from([component]));
    let run = Simulation::new(&system).input(drive).control(control).observe(look);
    run.run_to_end(x, v, 0.0..scene.end).expect("runs");
    Outcome { evaluations: evaluations.get(), ..outcome }
}

const TOLERANCES: [f64; 4] = [1e-4, 1e-6, 1e-8, 1e-10];

/// Both pairs at all tolerances.
fn outcomes<L: ForceLaw>(scene: &Scene) -> Vec<(f64, Outcome)> {
    let five = TOLERANCES.map(|tolerance| (tolerance, outcome::<L>(Adaptive::new(tolerance, tolerance), scene)));
    let eight = TOLERANCES.map(|tolerance| {
        let pair = Adaptive::with(&Tableau::DORMAND_PRINCE_8, tolerance, tolerance);
        (tolerance, outcome::<L>(pair, scene))
    });
    five.into_iter().chain(eight).collect()
}

/// The error stays within what the steps were allowed. The flow of an arc keeps (x, ẋ) or (3x, ẋ) in length, so that an
/// error of one step is scaled by 3 at most until the end, and errors of steps add up.
///
/// And marking is worth it: without it the errors are several times as large (geometric mean over tolerances and pairs,
/// because what the estimate sees of one crossing depends on where in a step it lies), for no less than two thirds of
/// the evaluations.
fn stays_near_tolerance<L: ForceLaw>(scene: &Scene) {
    let (careful, careless) = (outcomes::<L>(scene), outcomes::<Concealed<L>>(scene));
    for (tolerance, Outcome { error, steps, .. }) in &careful {
        let bound = 3.0 * f64::from(*steps) * tolerance * (1.0 + scene.size);
        assert!(*error < bound, "tolerance {tolerance:e}: {error:e} in {steps} steps");
    }
    let mean = |list: &[(f64, Outcome)]| list.iter().map(|(_, o)| o.error.log10()).sum::<f64>() / list.len() as f64;
    let gain = mean(&careless) - mean(&careful);
    let work = |list: &[(f64, Outcome)]| list.iter().map(|(_, o)| o.evaluations).sum::<u32>();
    assert!(gain > 0.5, "only {gain} digits");
    assert!(2 * work(&careful) < 3 * work(&careless));
}

#[test]
fn a_stop_is_met_to_the_tolerance() {
    stays_near_tolerance::<OneSided>(&STOP);
}

#[test]
fn dry_friction_takes_the_same_from_every_swing() {
    stays_near_tolerance::<Dry>(&FRICTION);
}
