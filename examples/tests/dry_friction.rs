//! The claims of the example `dry_friction`: the exact solution of a slider; energy and friction times way; what is
//! decided at rest.

#[path = "../dry_friction/friction.rs"]
mod friction;
#[path = "../dry_friction/model.rs"]
mod model;

use friction::{Dry, Mode, Moment};
use gauss_runtime::prelude::*;
use model::{Arm, SWINGS, Slider, SmoothArm};

const LIMITS: [f64; 2] = [0.8, 0.3];

#[test]
fn a_slider_moves_as_its_exact_solution_says() {
    let (slider, f) = (Slider::desk(), 0.2);
    let kernel = slider.kernel().unwrap();
    let dry = Dry { kernel: &kernel, limits: [f] };
    let end = SWINGS * slider.half_swing() + 1.0;
    let moments = dry.run(SVector::from([slider.exact(f, 0.0)]), SVector::zeros(), end, 1e-12).unwrap();
    // The start, ten turns, and the end.
    assert_eq!(moments.len(), 12);
    for (n, m) in moments.iter().enumerate() {
        // Some hundred steps, each with an error of 1e-12 of a way of 0.1 m.
        assert!((m.q[0] - slider.exact(f, m.t)).abs() < 1e-10, "{n}: {m:?}");
        let turns = f64::from(u32::try_from(n).unwrap()).min(SWINGS) * slider.half_swing();
        assert!(n == 11 || (m.t - turns).abs() < 1e-9 && m.z[0] == 0.0, "{n}: {m:?}");
    }
    let [.., turned, last] = moments.as_slice() else { panic!("two moments at least") };
    assert_eq!(turned.modes, [Mode::Sticks]);
    // The spring and the friction that holds it, each rounded a few times, are what is left of an acceleration.
    let rounding = 4.0 * f64::EPSILON * f / slider.m * (last.t - turned.t);
    assert!(last.z[0].abs() <= rounding, "{last:?}");
    assert!((last.q - turned.q).amax() < 1e-15, "it stays where it sticks");
}

fn arm(end: f64, tolerance: f64) -> Vec<Moment<2>> {
    let kernel = Arm { g: 9.81 }.kernel().unwrap();
    let dry = Dry { kernel: &kernel, limits: LIMITS };
    dry.run(SVector::from([1.4, 0.9]), SVector::zeros(), end, tolerance).unwrap()
}

/// Between two events no rate changes its sign, so what friction takes is its size times how far each joint went.
#[test]
fn energy_is_lost_as_friction_times_way() {
    let kernel = Arm { g: 9.81 }.kernel().unwrap();
    let dry = Dry { kernel: &kernel, limits: LIMITS };
    let moments = arm(12.0, 1e-11);
    assert!(moments.iter().any(|m| m.modes[1] == Mode::Sticks && m.modes[0] != Mode::Sticks), "{moments:?}");
    for (n, pair) in moments.windows(2).enumerate() {
        let energy = |m: &Moment<2>| kernel.energy(m.t, &m.q, &m.z);
        let way = pair[1].q - pair[0].q;
        let taken = LIMITS[0] * way[0].abs() + LIMITS[1] * way[1].abs();
        // Some hundred steps at 1e-11 of some ten joules.
        assert!((energy(&pair[0]) - energy(&pair[1]) - taken).abs() < 1e-8, "{n}: {pair:?}");
        for k in 0..2 {
            let signed = match pair[0].modes[k] {
                Mode::Sticks => way[k].abs() < 1e-10,
                Mode::Slides(sign) => sign * way[k] > 0.0,
            };
            assert!(signed, "{n}: {pair:?}");
        }
    }
    // At the end both rest, and friction holds the weight.
    let last = moments.last().unwrap();
    assert_eq!(last.modes, [Mode::Sticks; 2]);
    let held = dry.forces(&last.modes, last.t, &last.q, &last.z).unwrap();
    assert!((0..2).all(|k| held[k].abs() <= LIMITS[k]), "{held}");
    assert!(kernel.acceleration(last.t, &last.q, &last.z, &held).amax() < 1e-12);
}

/// At rest the rates are those that make C + Σ f |ż| least, among all others.
#[test]
fn what_is_decided_at_rest_is_a_minimum() {
    let kernel = Arm { g: 9.81 }.kernel().unwrap();
    let dry = Dry { kernel: &kernel, limits: LIMITS };
    let (z, none) = (SVector::zeros(), SVector::zeros());
    for n in 0..40 {
        let angle = 0.157 * f64::from(n);
        let q = SVector::from([angle.sin() * 1.5, 0.3 * angle]);
        let modes = dry.decide(0.0, &q, &z).expect("one of the ways");
        let friction = dry.forces(&modes, 0.0, &q, &z).unwrap();
        let rates = kernel.acceleration(0.0, &q, &z, &friction);
        let cost = |a: &SVector<f64, 2>| {
            kernel.constraint_function(0.0, &q, &z, a, &none) + LIMITS[0] * a[0].abs() + LIMITS[1] * a[1].abs()
        };
        for m in 0..36 {
            let (sin, cos) = (0.1745 * f64::from(m)).sin_cos();
            for size in [1e-3, 1e-1, 10.0] {
                let other = rates + SVector::from([cos, sin]) * size;
                // C is a difference of terms of some hundred.
                assert!(cost(&other) >= cost(&rates) - 1e-12, "{n}, {m}: {modes:?}");
            }
        }
    }
}

/// Friction that is made smooth comes closer in proportion to its width, while the arm moves.
#[test]
fn smooth_friction_comes_closer() {
    let moments = arm(0.6, 1e-11);
    let end = moments.last().unwrap().q;
    let distance = |creep: f64| {
        let smooth = SmoothArm { g: 9.81, f_shoulder: LIMITS[0], f_elbow: LIMITS[1], creep }.kernel().unwrap();
        let run = Simulation::new(&smooth).adaptive(1e-10, 1e-10);
        (run.run_to_end(SVector::from([1.4, 0.9]), SVector::zeros(), 0.0..0.6).unwrap().sample.q - end).amax()
    };
    let [wide, narrow] = [1e-2, 1e-4].map(distance);
    // A hundredth of the width: ε² ln ε while it slides, ε where it turns.
    assert!(narrow < 0.05 * wide, "{wide:e} {narrow:e}");
}

/// What the page shows: the states between the events, in the order of time, to where the run ended.
#[test]
fn the_path_leads_through_all_events() {
    let kernel = Arm { g: 9.81 }.kernel().unwrap();
    let moments = arm(3.0, 1e-11);
    let path = Dry { kernel: &kernel, limits: LIMITS }.path(&moments, 0.01).unwrap();
    assert!(path.windows(2).all(|pair| pair[0].t < pair[1].t && pair[1].t - pair[0].t < 0.01 + 1e-12));
    for event in &moments {
        let beside = path.iter().find(|s| s.t == event.t).expect("every event");
        // Some hundred steps with a tolerance of 1e-9 from one event to the next.
        assert!((beside.q - event.q).amax() < 1e-7, "{}", event.t);
    }
}
