//! Steps that keep a tolerance.

use gauss_contact::{ContactErrorKind, ContactSteps, StepScheme, SteppedRun};
use gauss_runtime::contact::Contact;
use gauss_runtime::nalgebra::SMatrix;
use gauss_runtime::prelude::*;

use crate::common::{Layout, Scene, V};

const G: f64 = 9.81;

pub struct Ground;
impl Layout for Ground {
    const CONTACTS: &'static [Contact] = &[Contact::new("ground", 0, 1)];
}

/// A mass of 1 at (x, h) above a floor: gap h, slip ẋ.
pub fn block(mu: f64, e: f64) -> Scene<Ground, 2, 1, 2> {
    let rows = SMatrix::<f64, 2, 2>::new(0.0, 1.0, 1.0, 0.0);
    Scene::linear(V::from([1.0, 1.0]), V::from([0.0, -G]), V::zeros(), rows).friction([mu]).restitution([e])
}

type Run<'k> = SteppedRun<'k, Scene<Ground, 2, 1, 2>>;

#[test]
fn smooth_parts_keep_the_tolerance_at_the_order_of_the_scheme() {
    // Slid against friction and drag: v = (v₀ + k) exp(−c t) − k, k = μ g/c.
    let (mu, c, v) = (0.3, 0.8, 9.0);
    let kernel = block(mu, 0.0).force(move |_, _, z| V::from([-c * z[0], -G]));
    let (k, t) = (mu * G / c, 1.0_f64);
    let (speed, way) = ((v + k) * (-c * t).exp() - k, (v + k) * (1.0 - (-c * t).exp()) / c - k * t);
    for scheme in [StepScheme::Midpoint, StepScheme::MoreauJean] {
        let run = |tolerance: f64| -> Run {
            let steps = ContactSteps::new(&kernel, 0.5).scheme(scheme).adaptive(0.0, tolerance);
            steps.run(V::zeros(), V::from([v, 0.0]), 0.0..t).unwrap()
        };
        let [coarse, fine] = [1e-4, 1e-6].map(run);
        for (run, tolerance) in [(&coarse, 1e-4), (&fine, 1e-6)] {
            let (end, statistics) = (run.samples.last().unwrap(), run.statistics);
            assert_eq!((end.state.t, end.state.z[1], end.state.q[1]), (t, 0.0, 0.0));
            // Each step may err by the tolerance; errors of speeds decay, those of places are up to 1/c of them more.
            let off = (end.state.z[0] - speed).abs().max((end.state.q[0] - way).abs());
            assert!(
                off <= (1.0 + 1.0 / c) * statistics.accepted as f64 * tolerance,
                "{scheme:?} {off:e} {statistics:?}"
            );
            // A control that wastes would show here: within a factor of thirty of what is allowed.
            assert!(off >= statistics.accepted as f64 * tolerance / 30.0, "{scheme:?} {off:e} {statistics:?}");
            assert_eq!((statistics.changes, statistics.beyond), (0, 0), "{statistics:?}");
            assert!(statistics.largest <= 1.0 && statistics.rejected <= 8, "{statistics:?}");
            assert!(run.samples.iter().all(|step| step.report.estimate <= 1.0));
        }
        // Lengths go with the root of the local order.
        let found = 100.0_f64.ln() / (fine.statistics.accepted as f64 / coarse.statistics.accepted as f64).ln();
        assert!((found - 3.0).abs() < 0.3, "{scheme:?} {found}");
    }
}

#[test]
fn an_oscillator_with_dry_friction_rests_where_it_should() {
    // About the centres ∓1 by turns, seven turns, from (12, 6) to rest at 15 − √205.
    let kernel = block(1.0, 0.0).force(|_, q, _| V::from([-q[0], -1.0]));
    for tolerance in [1e-4, 1e-6] {
        let steps = ContactSteps::new(&kernel, 0.2).adaptive(0.0, tolerance).shortest(1e-9);
        let run = steps.run(V::from([12.0, 0.0]), V::from([6.0, 0.0]), 0.0..30.0).unwrap();
        let (end, statistics) = (run.samples.last().unwrap(), run.statistics);
        assert_eq!(end.state.z, V::<2>::zeros());
        let off = (end.state.q[0] - (15.0 - 205.0_f64.sqrt())).abs();
        // An oscillation keeps errors: at most one tolerance for each step.
        assert!(off <= statistics.accepted as f64 * tolerance, "{off:e} {statistics:?}");
        assert!((7..=24).contains(&statistics.changes) && statistics.beyond == 0, "{statistics:?}");
        // From there on it takes the longest steps.
        let last = run.samples.windows(2).last().unwrap();
        assert!(last[1].state.t - last[0].state.t > 0.1, "{statistics:?}");
    }
}

#[test]
fn impacts_take_steps_of_the_shortest_length_and_none_shorter() {
    let (e, h) = (0.5, 1.0_f64);
    let kernel = block(0.0, e);
    let first = (2.0 * h / G).sqrt();
    let mut errors = Vec::new();
    for shortest in [1e-4, 1e-6] {
        let steps = ContactSteps::new(&kernel, 0.1).adaptive(0.0, 1e-9).shortest(shortest);
        let run: Run = steps.run(V::from([0.0, h]), V::zeros(), 0.0..first + 0.4).unwrap();
        let statistics = run.statistics;
        assert_eq!(statistics.changes, 1, "{statistics:?}");
        assert!(statistics.beyond == 1 && statistics.largest_beyond > 1.0, "{statistics:?}");
        // A parabola is no work between impacts; a search by quarters costs a few steps for each quarter.
        assert!(statistics.accepted + statistics.rejected < 12 * 12, "{statistics:?}");
        let least = run.samples.windows(2).map(|pair| pair[1].state.t - pair[0].state.t).fold(1.0, f64::min);
        assert!(least >= shortest * (1.0 - 1e-9), "{least:e}");
        let (end, up) = (run.samples.last().unwrap(), e * G * first);
        let off = (end.state.q[1] - (0.4 * up - 0.5 * G * 0.16)).abs();
        // The time of the impact is known to a step: it moves by the change of speed, and of the speed by g.
        assert!(off <= (1.0 + e) * G * (first + 0.4) * shortest, "{off:e}");
        errors.push(off);
    }
    assert!(errors[1] < 0.1 * errors[0], "{errors:?}");
}

#[test]
fn bounces_that_pile_up_do_not_stop_a_run() {
    let kernel = block(0.3, 0.9);
    let steps = ContactSteps::new(&kernel, 0.05).adaptive(1e-6, 1e-6);
    let run: Run = steps.run(V::from([0.0, 1.0]), V::from([0.5, 0.0]), 0.0..12.0).unwrap();
    // √(2h/g)(1 + e)/(1 − e) is when they end. Flights lower than the tolerance, of 4.4 mm/s, may be left out: the last
    // 9 ms. The others, not a hundred, are each known to 5e-5.
    let rests = run.samples.iter().find(|step| step.state.z == V::<2>::zeros()).unwrap().state.t;
    assert!((rests - 8.578_949_178_728_9).abs() < 0.014, "{rests}");
    assert_eq!(run.samples.last().unwrap().state.z, V::<2>::zeros());
    assert!(run.samples.iter().all(|step| step.state.q[1] >= -1e-15));
    assert!(run.statistics.accepted < 10_000, "{:?}", run.statistics);
}

#[test]
fn mistakes_are_told() {
    let kernel = block(0.3, 0.0);
    let run = |h: f64, [relative, absolute]: [f64; 2], shortest: f64, end: f64| {
        let steps = ContactSteps::new(&kernel, h).adaptive(relative, absolute).shortest(shortest).max_steps(50);
        steps.run(V::zeros(), V::from([3.0, 0.0]), 0.0..end).err().map(|error| error.kind)
    };
    use ContactErrorKind::{InvalidInterval, InvalidStep, InvalidTolerance, TooManySteps};
    assert_eq!(run(0.1, [1e-6, 1e-6], 1e-5, 1.0), None);
    assert_eq!(run(0.0, [1e-6, 1e-6], 1e-5, 1.0), Some(InvalidStep { step: 0.0 }));
    assert_eq!(run(0.1, [1e-6, 1e-6], 0.2, 1.0), Some(InvalidStep { step: 0.2 }));
    assert!(matches!(run(0.1, [1e-6, 1e-6], f64::NAN, 1.0), Some(InvalidStep { .. })));
    for [relative, absolute] in [[0.0, 0.0], [-1.0, 1e-6], [1e-6, f64::INFINITY]] {
        assert_eq!(run(0.1, [relative, absolute], 1e-5, 1.0), Some(InvalidTolerance { relative, absolute }));
    }
    assert_eq!(run(0.1, [1e-6, 1e-6], 1e-5, f64::INFINITY), Some(InvalidInterval));
    assert_eq!(run(0.1, [1e-6, 1e-6], 1e-5, 100.0), Some(TooManySteps { limit: 50 }));
}

/// A block on a floor that is pushed; it sticks under less than μ m g.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, height),
    particle(mass = 2, position = [x, 0, height]),
    contact(floor, gap = height, slip = rate(x), friction = 0.4),
    input(push),
    drive(x = push),
)]
struct Block {
    #[gauss(gravity)]
    g: f64,
}

#[test]
fn a_push_that_is_longer_than_an_eighth_of_a_step_is_seen_wherever_it_comes() {
    let kernel = Block { g: G }.kernel().unwrap();
    let friction = 0.4 * 2.0 * G;
    for h in [0.1, 0.02] {
        for n in 0..40 {
            // Three times friction for a time w, from t on: it slides for that time, and until v = 2 μ g w is gone.
            let (w, t) = (0.14 * h * (1.0 + n as f64 / 10.0), 0.51 + 0.37 * n as f64 * h);
            let push = |at: f64| if (t..t + w).contains(&at) { 3.0 * friction } else { 0.0 };
            let run = ContactSteps::new(&kernel, h).input(move |at, _: &_, _: &_| SVector::from([push(at)]));
            let run = run.adaptive(1e-7, 1e-7).run(SVector::zeros(), SVector::zeros(), 0.0..t + 10.0 * h).unwrap();
            let v = 2.0 * 0.4 * G * w;
            let way = 0.5 * v * w + v * v / (2.0 * 0.4 * G);
            let end = run.samples.last().unwrap().state;
            assert!((end.q[0] - way).abs() < 1e-2 * way + 1e-5, "{h} {n} {} {way}", end.q[0]);
            assert_eq!(end.z[0], 0.0);
        }
    }
}

#[test]
fn a_push_that_swells_and_fades_moves_a_block_as_far_as_in_runs() {
    let kernel = Block { g: G }.kernel().unwrap();
    for w in [0.02, 0.1, 0.4] {
        let push = move |t: f64| SVector::from([3.0 * 0.4 * 2.0 * G * (-((t - 2.3) / w) * ((t - 2.3) / w)).exp()]);
        let steps = ContactSteps::new(&kernel, 0.05).input(move |t, _: &_, _: &_| push(t)).adaptive(1e-6, 1e-6);
        let run = steps.run(SVector::zeros(), SVector::zeros(), 0.0..4.0).unwrap();
        // By steps of a ten thousandth of the time.
        let fine = ContactSteps::new(&kernel, 1e-4).input(move |t, _: &_, _: &_| push(t));
        let fine = fine.run(SVector::zeros(), SVector::zeros(), 0.0..4.0).unwrap();
        let [x, other] = [run.samples.last().unwrap().state.q[0], fine.last().unwrap().state.q[0]];
        assert!((x - other).abs() < 0.01 * other, "{w} {x} {other}");
    }
}

/// The same block under a push that stands in the scene.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, height),
    particle(mass = 2, position = [x, 0, height]),
    contact(floor, gap = height, slip = rate(x), friction = 0.4),
    drive(x = p * exp(-(t - t0) * (t - t0) / (w * w))),
)]
struct PushedBlock {
    #[gauss(gravity)]
    g: f64,
    p: f64,
    t0: f64,
    w: f64,
}

#[test]
fn a_push_of_the_scene_moves_a_block_as_far_as_an_input_does() {
    let p = 3.0 * 0.4 * 2.0 * G;
    for (w, t0) in [0.02, 0.05].into_iter().flat_map(|w| (0..6).map(move |n| (w, 0.6 + 0.083 * f64::from(n)))) {
        let kernel = PushedBlock { g: G, p, t0, w }.kernel().unwrap();
        let run = ContactSteps::new(&kernel, 0.1).adaptive(1e-6, 1e-6);
        let run = run.run(SVector::zeros(), SVector::zeros(), 0.0..1.8).unwrap();
        let fine = ContactSteps::new(&kernel, 1e-4).run(SVector::zeros(), SVector::zeros(), 0.0..1.8).unwrap();
        let [x, other] = [run.samples.last().unwrap().state.q[0], fine.last().unwrap().state.q[0]];
        assert!((x - other).abs() < 0.01 * other, "{w} {t0} {x} {other}");
    }
}
