//! Runs that change over from events to steps where events pile up, and back.

use gauss_contact::{
    ChangingTrajectory, ContactErrorKind, ContactRun, ContactSteps, EventKind, Impact, RunPart, StepPart,
};
use gauss_runtime::contact::{Contact, ContactSystem};
use gauss_runtime::nalgebra::SMatrix;
use gauss_runtime::system::GaussSystem;

use crate::adaptive::block;
use crate::common::{Layout, Scene, V, numbers};

const G: f64 = 9.81;

fn steps<'a, 'k, K: ContactSystem<Scalar = f64>>(run: &'a ChangingTrajectory<'k, K>) -> Vec<&'a StepPart<'k, K>> {
    let part = |part: &'a RunPart<'k, K>| match part {
        RunPart::Steps(part) => Some(part),
        RunPart::Events(_) => None,
    };
    run.parts().iter().filter_map(part).collect()
}

struct Balls;
impl Layout for Balls {
    const CONTACTS: &'static [Contact] = &{
        let mut all = [Contact::new("", 0, 0); 49];
        let mut i = 0;
        while i < 49 {
            all[i] = Contact::new("ball", i, 0);
            i += 1;
        }
        all
    };
}

/// 49 balls of 10 kg, each above the floor for itself.
fn balls(e: f64) -> Scene<Balls, 49, 49, 49> {
    let rows = SMatrix::<f64, 49, 49>::identity();
    let scene = Scene::linear(V::repeat(10.0), V::repeat(-10.0 * G), V::zeros(), rows).restitution([e; 49]);
    Scene { gaps: Box::new(|q| *q), ..scene }
}

#[test]
fn forty_nine_balls_keep_their_energy() {
    let kernel = balls(1.0);
    let mut number = numbers(9);
    // All from 5 m, and each from a height of its own.
    for spread in [0.0, 0.4] {
        let start = V::<49>::from_fn(|_, _| 5.0 + spread * number());
        let energy = |q: &V<49>, z: &V<49>| kernel.energy(0.0, q, z);
        let first = energy(&start, &V::zeros());
        let run = ContactRun::new(&kernel).adaptive(1e-9, 1e-9).changing_over(1e-3);
        let run = run.run(start, V::zeros(), 0.0..20.0).unwrap();
        // Impacts at one time are one event: nothing piles up.
        assert_eq!(steps(&run).len(), 0, "{spread}");
        let RunPart::Events(part) = &run.parts()[0] else { panic!("events") };
        assert_eq!(part.tolerance, [1e-9, 1e-9]);
        // ½ + (20 − t₁)/2t₁ bounces of each.
        let impacts = part.trajectory.events().iter().filter(|event| matches!(event.kind, EventKind::Impact(_)));
        assert_eq!(impacts.count(), (0..49).map(|i| (20.0 / (2.0 * start[i] / G).sqrt() + 1.0) as usize / 2).sum());
        let off = run.iter().map(|state| (energy(&state.q, &state.z) / first - 1.0).abs()).fold(0.0, f64::max);
        assert!(off <= 1e-12, "{spread} {off:e}");
    }
    // In steps the speed turns where it is: they keep it as well.
    let start = V::<49>::from_fn(|i, _| 5.0 + 0.01 * i as f64);
    let run = ContactSteps::new(&kernel, 1e-2).run(start, V::zeros(), 0.0..20.0).unwrap();
    let first = kernel.energy(0.0, &start, &V::zeros());
    let energy = |step: &gauss_contact::StepSample<_>| kernel.energy(0.0, &step.state.q, &step.state.z);
    let off = run.iter().map(|step| (energy(step) / first - 1.0).abs()).fold(0.0, f64::max);
    assert!(off <= 1e-12, "{off:e}");
}

#[test]
fn a_ball_that_comes_to_rest_needs_no_steps() {
    let kernel = block(0.3, 0.9);
    let run = ContactRun::new(&kernel).adaptive(1e-9, 1e-9).changing_over(1e-3);
    let run = run.run(V::from([0.0, 1.0]), V::from([0.5, 0.0]), 0.0..12.0).unwrap();
    // Bounces that pile up at one gap have a closed form: events go on beyond it.
    assert_eq!((run.parts().len(), steps(&run).len()), (1, 0));
    let RunPart::Events(part) = &run.parts()[0] else { panic!("events") };
    let rests = part.trajectory.events().iter().find(|event| matches!(event.kind, EventKind::Rests { .. })).unwrap();
    // What is left out below speeds of 1e-9 (1 + 4.43) takes 2 v/g(1 − e) less than twenty times as much.
    let EventKind::Rests { remaining, .. } = rests.kind else { panic!("rests") };
    assert!((rests.time + remaining - 8.578_949_178_728_9).abs() < 1e-7, "{rests:?}");
    assert_eq!(run.last().unwrap().z, V::<2>::zeros());
}

struct Stack;
impl Layout for Stack {
    const CONTACTS: &'static [Contact] =
        &[Contact::new("floor", 0, 0), Contact::new("first", 1, 0), Contact::new("second", 2, 0)];
}

#[test]
fn impacts_that_pile_up_at_several_gaps_go_over_to_steps_and_back() {
    // Three balls above one another, whose gaps come to zero together.
    let rows = SMatrix::<f64, 3, 3>::new(1., 0., 0., -1., 1., 0., 0., -1., 1.);
    let kernel: Scene<Stack, 3, 3, 3> =
        Scene::linear(V::from([3.0, 2.0, 1.0]), -G * V::from([3.0, 2.0, 1.0]), V::zeros(), rows).restitution([0.9; 3]);
    let (q, z) = (V::from([0.1, 0.3, 0.6]), V::zeros());
    let h = 1e-3;
    let exact = || ContactRun::new(&kernel).adaptive(1e-9, 1e-9);
    let alone = exact().max_events(20_000).run(q, z, 0.0..4.0).map(|_| ());
    let run = exact().changing_over(h).run(q, z, 0.0..4.0).unwrap();
    let parts = steps(&run);
    assert!(!parts.is_empty(), "{alone:?}");
    for part in &parts {
        use ContactErrorKind::{Chatter, EventsPile, Unsolved, Zeno};
        let kind = &part.because.kind;
        assert!(matches!(kind, EventsPile { .. } | Zeno { .. } | Chatter { .. } | Unsolved { .. }), "{kind:?}");
        assert_eq!(part.h, h);
        assert!(part.residual.signorini <= 1e-12 && part.impacts > 0, "{:?}", part.residual);
    }
    // They rest, and the end is made of events again: to the last bit, with a tolerance.
    let Some(RunPart::Events(last)) = run.parts().last() else { panic!("ends in events") };
    assert!(last.trajectory.events().iter().all(|event| !matches!(event.kind, EventKind::Impact(_))));
    let end = run.last().unwrap();
    assert_eq!((end.t, end.z), (4.0, V::zeros()));
    assert!(end.q.amax() <= 1e-15, "{}", end.q);
    // Parts follow one another in time, and energy does not grow.
    let all: Vec<_> = run.iter().collect();
    assert!(all.windows(2).all(|pair| pair[0].t <= pair[1].t));
    let energy: Vec<f64> = all.iter().map(|state| kernel.energy(0.0, &state.q, &state.z)).collect();
    // Errors of 1e-9 between events; in steps gaps are brought to zero from below by a closure of at most v h.
    assert!(energy.windows(2).all(|pair| pair[1] <= pair[0] + 6.0 * G * 2.0 * h * h), "grows");
}

struct Heap;
impl Layout for Heap {
    /// Four balls: floor, left and right wall of each, then pairs.
    const CONTACTS: &'static [Contact] = &{
        let mut all = [Contact::new("", 0, 0); 18];
        let mut i = 0;
        while i < 18 {
            all[i] = Contact::new(
                if i < 4 {
                    "floor"
                } else if i < 12 {
                    "wall"
                } else {
                    "pair"
                },
                i,
                0,
            );
            i += 1;
        }
        all
    };
}

const PAIRS: [[usize; 2]; 6] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];
const R: f64 = 0.1;

fn between(q: &V<8>, [a, b]: [usize; 2]) -> [f64; 2] {
    [q[2 * a] - q[2 * b], q[2 * a + 1] - q[2 * b + 1]]
}

/// Four smooth discs of radius 0.1 in a box as wide as 0.5.
fn heap(e: f64) -> Scene<Heap, 8, 18, 18> {
    let width = 0.5;
    let mut scene = Scene::linear(V::repeat(1.0), V::from_fn(|i, _| -G * (i % 2) as f64), V::zeros(), SMatrix::zeros());
    scene.gaps = Box::new(move |q| {
        V::from_fn(|i, _| match i {
            0..4 => q[2 * i + 1] - R,
            4..8 => q[2 * (i - 4)] - R,
            8..12 => width - R - q[2 * (i - 8)],
            _ => {
                let [x, y] = between(q, PAIRS[i - 12]);
                x.hypot(y) - 2.0 * R
            }
        })
    });
    scene.rows = Box::new(|q| {
        let mut rows = SMatrix::<f64, 18, 8>::zeros();
        for i in 0..4 {
            rows[(i, 2 * i + 1)] = 1.0;
            (rows[(4 + i, 2 * i)], rows[(8 + i, 2 * i)]) = (1.0, -1.0);
        }
        for (k, [a, b]) in PAIRS.into_iter().enumerate() {
            let [x, y] = between(q, [a, b]);
            let d = x.hypot(y);
            (rows[(12 + k, 2 * a)], rows[(12 + k, 2 * a + 1)]) = (x / d, y / d);
            (rows[(12 + k, 2 * b)], rows[(12 + k, 2 * b + 1)]) = (-x / d, -y / d);
        }
        rows
    });
    scene.gamma = Box::new(|q, z| {
        V::from_fn(|i, _| {
            if i < 12 {
                return 0.0;
            }
            let ([x, y], [u, v]) = (between(q, PAIRS[i - 12]), between(z, PAIRS[i - 12]));
            (x * v - y * u).powi(2) / x.hypot(y).powi(3)
        })
    });
    scene.restitution([e; 18])
}

#[test]
fn balls_dropped_in_a_heap_come_to_an_end_by_both() {
    let kernel = heap(0.5);
    let q = V::from([0.15, 0.4, 0.36, 0.45, 0.2, 0.8, 0.3, 1.1]);
    let h = 1e-3;
    let run = ContactRun::new(&kernel).adaptive(1e-8, 1e-8).changing_over(h).run(q, V::zeros(), 0.0..3.0).unwrap();
    assert_eq!(run.last().unwrap().t, 3.0);
    let parts = steps(&run);
    // The first blow is made of events.
    assert!(matches!(run.parts()[0], RunPart::Events(_)) && !parts.is_empty());
    // And what lies still: the last part has a tolerance.
    assert!(matches!(run.parts().last(), Some(RunPart::Events(_))));
    let lowest = run.iter().map(|state| kernel.gaps(0.0, &state.q).min()).fold(0.0, f64::min);
    // Gaps that are closed are brought to zero to rounding of places of about 1; between events to half of the digits.
    assert!(lowest >= -2e-8, "{lowest:e}");
    let energy: Vec<f64> = run.iter().map(|state| kernel.energy(0.0, &state.q, &state.z)).collect();
    assert!(energy.last() < energy.first());
    let grown = energy.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
    // By errors of 1e-8 of four balls' m g h; of steps by the closure of a gap, v h/2 with v up to 4.5, times m g.
    assert!(grown <= 4.0 * G * 4.5 * 0.5 * h, "{grown:e}");
}

#[test]
fn mistakes_are_told() {
    let kernel = block(0.3, 0.5);
    let run = |h: f64, law: Impact, quiet: f64| {
        let run = ContactRun::new(&kernel).adaptive(1e-8, 1e-8).law(law).changing_over(h).quiet(quiet);
        run.run(V::from([0.0, 1.0]), V::zeros(), 0.0..1.0).err().map(|error| error.kind)
    };
    assert_eq!(run(1e-3, Impact::Newton, 0.1), None);
    assert_eq!(run(0.0, Impact::Newton, 0.1), Some(ContactErrorKind::InvalidStep { step: 0.0 }));
    assert_eq!(run(1e-3, Impact::Newton, -1.0), Some(ContactErrorKind::InvalidStep { step: -1.0 }));
    assert_eq!(run(1e-3, Impact::Moreau, 0.1), Some(ContactErrorKind::LawWithoutSteps { law: Impact::Moreau }));
    // What is no piling up ends the run as ever.
    let kernel = block(-0.3, 0.5);
    let run = ContactRun::new(&kernel).adaptive(1e-8, 1e-8).changing_over(1e-3);
    let error = run.run(V::from([0.0, 0.0]), V::from([1.0, 0.0]), 0.0..1.0).err().unwrap();
    assert_eq!(error.kind, ContactErrorKind::InvalidFriction { friction: -0.3 });
}

/// Discs that come to rest push others below zero by rounding, which then fall: their gaps must close nonetheless.
#[test]
fn heaps_come_to_rest_by_events_alone() {
    for e in [0.3, 0.5] {
        let kernel = heap(e);
        let q = V::from([0.15, 0.4, 0.36, 0.45, 0.2, 0.8, 0.3, 1.1]);
        let run = ContactRun::new(&kernel).adaptive(1e-8, 1e-8).run(q, V::zeros(), 0.0..3.0).unwrap();
        let last = run.last().unwrap();
        assert!(last.z.norm() == 0.0, "{e}: {:?}", last.z);
        // Closed gaps to rounding of places of about 1; between events to half of the digits.
        let lowest = |q: &V<8>| kernel.gaps(0.0, q).min();
        assert!(lowest(&last.q) >= -4.0 * f64::EPSILON, "{e}: {:e}", lowest(&last.q));
        let worst = run.iter().map(|state| lowest(&state.q)).fold(0.0, f64::min);
        assert!(worst >= -2e-8, "{e}: {worst:e}");
        // Some of them lie upon others: the work of gravity is lost but for what they are still high.
        let energy = kernel.energy(0.0, &last.q, &last.z);
        let supported = kernel.gaps(0.0, &last.q).iter().filter(|gap| **gap < 1e-12).count();
        assert!(energy > 4.0 * G * R && supported >= 6, "{e}: {energy} {supported}");
    }
}
