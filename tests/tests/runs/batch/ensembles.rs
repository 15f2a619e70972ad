//! Runs with steps of their own in lanes: the bits of single runs, their events, their reasons to stop.

use std::sync::atomic::{AtomicUsize, Ordering};

use gauss_batch::{Ended, LaneControl, RunOutcome};

use super::*;

/// A run of its own for each state of an ensemble.
pub(super) fn agree<P, S, C, D>(
    (packed, single): (&P, &S),
    (control, alone): (C, D),
    start: impl Fn(usize) -> (S::Configuration, S::Speeds),
    (count, interval): (usize, Range<f64>),
) where
    P: BatchSystem<Input = ()> + Sync,
    P::Configuration: Packed<Single = S::Configuration> + Send,
    P::Speeds: Packed<Single = S::Speeds> + Send,
    S: GaussSystem<Scalar = f64, Input = (), Configuration: PartialEq + Send, Speeds: PartialEq + Send>,
    C: LaneControl<P> + Copy + Sync,
    D: gauss_runtime::integrate::Control<S> + Copy,
{
    let initial = States::<P>::from_fn(count, |i| -> Start<P> { start(i) });
    let mut states = initial.clone();
    let ends = Batch::new(packed).control(control).run(interval.clone(), &mut states);
    assert_eq!(ends.len(), count);
    for (i, end) in ends.iter().enumerate() {
        let (q0, z0) = start(i);
        let run = Simulation::new(single).control(alone).run_to_end(q0, z0, interval.clone()).expect("runs");
        let (q, z) = states.get(i);
        assert!(q == run.q && z == run.z, "state {i}: {q:?} {z:?} for {:?} {:?}", run.q, run.z);
        let end = end.as_ref().expect("runs");
        assert_eq!((end.time, end.stopped_by, end.summary), (run.t, None, run.summary), "state {i}");
    }
    let mut in_threads = initial.clone();
    let again = Batch::new(packed).control(control).run_on_all_threads(interval.clone(), &mut in_threads);
    assert!(in_threads.iter().zip(states.iter()).all(|(a, b)| a.0 == b.0 && a.1 == b.1));
    assert!(
        again.iter().zip(&ends).all(|(a, b)| a.as_ref().expect("runs").summary == b.as_ref().expect("runs").summary)
    );

    let mut states = initial;
    let ends = Batch::new(packed).momentum_form().control(control).run(interval.clone(), &mut states);
    for (i, (q, z)) in states.iter().enumerate() {
        let (q0, z0) = start(i);
        let run = Simulation::new(single).momentum_form().control(alone);
        let run = run.run_to_end(q0, z0, interval.clone()).expect("runs");
        assert!(q == run.q && z == run.z && ends[i].is_ok(), "momentum form, state {i}");
    }
}

/// More states than lanes, so that lanes are handed on; tolerances above and below rounding; forwards and backwards.
#[test]
fn every_run_takes_the_steps_that_it_would_take_alone() {
    let start = |i| (pose(i), twist(i));
    let four = (&thrown(Lanes::<f64, 4>::splat(2.0)), &thrown(2.0));
    let eight = (&thrown(wide::f64x8::splat(2.0)), &thrown(2.0));
    for tolerance in [1e-7, 1e-17] {
        let control = Adaptive::new(tolerance, tolerance);
        agree(four, (control, control), start, (11, 0.3..1.3));
        let control = Adaptive::by(RungeKutta(DormandPrince5), tolerance.max(1e-9), tolerance);
        agree(eight, (control, control), start, (19, 0.2..-0.4));
    }
    agree(
        (&top::<wide::f64x4>(), &top::<f64>()),
        (Adaptive::new(1e-9, 0.0), Adaptive::new(1e-9, 0.0)),
        angles,
        (7, 0.0..0.3),
    );
}

/// Of one order the series are those of single runs, too. Where the order is chosen, it is one for the lanes of a
/// block, and runs agree as their tolerances say.
#[test]
fn series_have_lengths_of_their_own() {
    let start = |i| (pose(i), twist(i));
    let kernels = (&thrown(Lanes::<f64, 4>::splat(2.0)), &thrown(2.0));
    let control = Taylor::new(1e-12, 1e-12).of_order(16);
    agree(kernels, (control, control), start, (11, 0.0..1.5));
    let mut states = States::<ThrownKernel<Lanes<f64, 4>>>::from_fn(11, start);
    let ends = Batch::new(kernels.0).taylor(1e-12, 1e-12).run(0.0..1.5, &mut states);
    for (i, (q, z)) in states.iter().enumerate() {
        let (q0, z0) = start(i);
        let run = Simulation::new(kernels.1).taylor(1e-12, 1e-12).run_to_end(q0, z0, 0.0..1.5).expect("runs");
        // A few steps of 1e-12 relative to sizes of some ten.
        assert!((z - run.z).norm() + (q.translation.vector - run.q.translation.vector).norm() < 1e-9, "state {i}");
        assert!(ends[i].as_ref().is_ok_and(|end| end.summary.steps < 2 * run.summary.steps + 2), "state {i}");
    }
}

#[test]
fn a_sweep_has_parameters_of_its_own_in_every_lane() {
    type Pack = Lanes<f64, 8>;
    let mass = |i: usize| 1.0 + 0.1 * i as f64;
    let kernels: Vec<_> = Packs::<Pack>::from_fn(21, mass).blocks().iter().map(|&mass| thrown(mass)).collect();
    let mut states = States::<ThrownKernel<Pack>>::from_fn(21, |i| (pose(i), twist(i)));
    let count = AtomicUsize::new(0);
    let ended = |_| {
        count.fetch_add(1, Ordering::Relaxed);
    };
    let ensemble = Batch::each(&kernels).adaptive(1e-9, 1e-9).progress(&ended);
    let ends = ensemble.run_on_all_threads(0.0..1.0, &mut states);
    assert_eq!((ends.len(), count.into_inner()), (21, 21));
    for (i, (q, z)) in states.iter().enumerate() {
        let alone = thrown(mass(i));
        let run = Simulation::new(&alone).adaptive(1e-9, 1e-9);
        let end = run.run_to_end(pose(i), twist(i), 0.0..1.0).expect("runs");
        assert!(q == end.q && z == end.z && ends[i].is_ok(), "state {i}");
    }
}

/// What is undefined from the start, what meets the singularity of its angles, what needs too many steps: each with the
/// time and the reason of a run of its own, at its last good state.
#[test]
fn runs_that_fail_do_so_as_they_would_alone() {
    type Pack = Lanes<f64, 4>;
    let adaptive = Adaptive::new(1e-8, 1e-8);
    let kinds = fail_as_alone((adaptive, adaptive), 120);
    for kind in ["ends", "undefined", "singular", "too many"] {
        assert!(kinds.contains(&kind), "{kind} is not among {kinds:?}");
    }
    let kernel = weightless(Pack::splat(1.0));
    let mut states = States::<TopKernel<Pack>>::from_fn(3, angles);
    let ends = Batch::new(&kernel).adaptive(-1.0, 0.0).run(0.0..1.0, &mut states);
    let refused = |end: &RunOutcome<TopKernel<Pack>>| {
        end.as_ref().is_err_and(|error| matches!(error.kind, IntegrationErrorKind::InvalidTolerance { .. }))
    };
    assert!(ends.len() == 3 && ends.iter().all(refused));
    assert!(Batch::new(&kernel).adaptive(1e-6, 0.0).run(0.0..1.0, &mut States::from_fn(0, angles)).is_empty());
    assert!(Batch::new(&kernel).adaptive(1e-6, 0.0).run(0.5..0.5, &mut states).iter().all(Result::is_ok));
}

/// A top without weight.
fn weightless<T: Real>(level: T) -> TopKernel<T> {
    let body = Top { mass: level, center: vector([0.0; 3]), inertia: vector([0.75, 0.75, 0.3]), g: T::zero() };
    body.kernel().expect("a body")
}

/// How runs from states of all kinds end, the same in lanes and alone.
pub(super) fn fail_as_alone<C, D>((in_lanes, alone): (C, D), limit: u64) -> Vec<&'static str>
where
    C: LaneControl<TopKernel<Lanes<f64, 4>>>,
    D: gauss_runtime::integrate::Control<TopKernel<f64>> + Copy,
{
    type Pack = Lanes<f64, 4>;
    let start = |i: usize| {
        let (mut q, mut z) = angles(i);
        match i % 5 {
            1 => q[1] = f64::NAN,
            2 => (q, z) = (SVector::from([0.3, 1.5, 0.1]), SVector::from([0.0, 2.0 + 0.1 * i as f64, 0.0])),
            3 => z[2] = 1e200,
            4 => z *= 30.0,
            _ => {}
        }
        (q, z)
    };
    let (control, kernel, single) = (alone, weightless(Pack::splat(1.0)), weightless(1.0));
    let mut states = States::<TopKernel<Pack>>::from_fn(23, start);
    let ends = Batch::new(&kernel).control(in_lanes).max_steps(limit).run(0.0..1.2, &mut states);
    let mut kinds = Vec::new();
    for (i, end) in ends.iter().enumerate() {
        let (q0, z0) = start(i);
        let run = Simulation::new(&single).control(control).max_steps(limit);
        let (path, error) = run.attempt(q0, z0, 0.0..1.2);
        let (q, z) = states.get(i);
        let last = path.last();
        let same = |a: &SVector<f64, 3>, b: &SVector<f64, 3>| a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits());
        assert!(same(&q, &last.q) && same(&z, &last.z), "state {i}");
        match (end, error) {
            (Ok(_), None) => kinds.push("ends"),
            (Err(ours), Some(theirs)) => {
                assert_eq!((ours.state, ours.time), (i, theirs.time));
                // How far from the singularity the last trial came depends on nothing else; no number may differ.
                assert_eq!(ours.kind, theirs.kind, "state {i}");
                kinds.push(match ours.kind {
                    IntegrationErrorKind::NonFinite { .. } => "undefined",
                    IntegrationErrorKind::SingularChart { .. } => "singular",
                    IntegrationErrorKind::TooManySteps { .. } => "too many",
                    _ => "other",
                });
            }
            other => panic!("state {i}: {other:?}"),
        }
    }
    kinds
}

#[test]
fn events_are_those_of_each_run() {
    let control = Adaptive::new(1e-9, 1e-9);
    bounce_as_alone((control, control));
}

/// Bodies that bounce off a floor, are counted at a height and stop where they go too far: as each would alone.
pub(super) fn bounce_as_alone<C, D>((in_lanes, control): (C, D))
where
    C: LaneControl<ThrownKernel<wide::f64x8>>,
    D: gauss_runtime::integrate::Control<ThrownKernel<f64>> + Copy,
{
    type Pack = wide::f64x8;
    fn bounce<T: Real>(z: &mut SVector<T, 6>) {
        // Upwards, as fast as it fell, with another turn.
        let number = T::from_f64;
        *z = SVector::from([z[0], z[1] * number(0.9), z[2], z[3], z[4], z[5]].map(|x| x * number(-0.8)));
    }
    let start = |i: usize| {
        let mut q = pose(i);
        q.translation.z = 0.5 + 0.05 * i as f64;
        (q, twist(i) * 0.5)
    };
    let (kernel, alone) = (thrown(Pack::splat(2.0)), thrown(2.0));
    let mut states = States::<ThrownKernel<Pack>>::from_fn(21, start);
    let ends = Batch::new(&kernel)
        .control(in_lanes)
        .event(Crossing::Any, |_t, q: &Isometry3<Pack>, _z| q.translation.z - Pack::splat(0.3))
        .event(Crossing::Falling, |_t, q: &Isometry3<Pack>, _z| q.translation.z)
        .then(|state: &mut Sample<ThrownKernel<Pack>>| bounce(&mut state.z))
        .until(Crossing::Any, |_t, q: &Isometry3<Pack>, _z| q.translation.x - Pack::splat(0.2))
        .run(0.0..0.9, &mut states);
    let (mut jumps, mut stopped, mut through) = (0, 0, 0);
    for (i, end) in ends.into_iter().enumerate() {
        let (q0, z0) = start(i);
        let single = Simulation::new(&alone)
            .event(Crossing::Any, |_t, q, _z| q.translation.z - 0.3)
            .event(Crossing::Falling, |_t, q, _z| q.translation.z)
            .then(|state| bounce(&mut state.z))
            .until(Crossing::Any, |_t, q, _z| q.translation.x - 0.2)
            .control(control)
            .run(q0, z0, 0.0..0.9)
            .expect("runs");
        let Ended { time, stopped_by, summary, events, .. } = end.expect("runs");
        let last = single.last();
        assert_eq!((time, stopped_by, summary), (last.t, single.stopped_by(), *single.summary()), "state {i}");
        assert!(states.get(i) == (last.q, last.z), "state {i}");
        let theirs: Vec<_> = single.events().iter().map(|event| (event.number, event.sample.t)).collect();
        assert_eq!(events.iter().map(|event| (event.event, event.t)).collect::<Vec<_>>(), theirs, "state {i}");
        assert!(events.iter().zip(single.events()).all(|(a, b)| a.q == b.sample.q && a.z == b.sample.z));
        (jumps, stopped, through) = (
            jumps + summary.jumps,
            stopped + usize::from(stopped_by.is_some()),
            through + events.iter().filter(|event| event.event == 0).count(),
        );
    }
    assert!(jumps >= 10 && stopped >= 3 && through >= 20, "{jumps} {stopped} {through}");
}

/// Projection is an iteration, which goes on until all lanes are done: the same up to rounding.
#[test]
fn constraints_hold_in_runs_of_their_own() {
    let (kernel, alone) = (pendulum::<Lanes<f64, 4>>(), pendulum::<f64>());
    let mut states = States::<PendulumKernel<Lanes<f64, 4>>>::from_fn(10, on_the_circle);
    let ends = Batch::new(&kernel).adaptive(1e-10, 1e-10).run(0.0..1.0, &mut states);
    for (i, (q, z)) in states.iter().enumerate() {
        assert!(ends[i].is_ok() && (q.norm() - 1.0).abs() < 4.0 * f64::EPSILON);
        assert!(q.dot(&z).abs() < 8.0 * f64::EPSILON * z.norm());
        let (q0, z0) = on_the_circle(i);
        let end = Simulation::new(&alone).adaptive(1e-10, 1e-10).run_to_end(q0, z0, 0.0..1.0).expect("runs");
        // As many roundings as with steps of one length, fewer steps.
        assert!((q - end.q).norm() + (z - end.z).norm() < 100.0 * 30.0 * 10.0 * f64::EPSILON, "state {i}");
    }
}

/// A cart that is at rest, or rolls, until it is pushed.
#[derive(GaussDynamics)]
#[gauss(coordinates(x), particle(mass = mass, position = [x, 0, 0]), input(push), drive(x = push))]
struct Cart<T> {
    mass: T,
}

fn pulse<T: Real>(t: T) -> T {
    let tau = (t - T::from_f64(5.3)) * T::from_f64(20.0);
    (-tau * tau).exp()
}

/// Each lane finds at the same steps what a run alone finds by its looks at the input.
#[test]
fn pushes_that_are_over_soon_are_seen_in_every_lane() {
    type Pack = Lanes<f64, 4>;
    let (packed, single) = (Cart { mass: Pack::splat(2.0) }.kernel(), Cart { mass: 2.0 }.kernel());
    let (packed, single) = (packed.expect("a cart"), single.expect("a cart"));
    let start = |i: usize| -> (SVector<f64, 1>, SVector<f64, 1>) { ([0.1 * i as f64].into(), [0.3 * i as f64].into()) };
    let mut states = States::<CartKernel<Pack>>::from_fn(7, start);
    let batch = Batch::new(&packed).input(|t: Pack, _: &SVector<Pack, 1>, _: &SVector<Pack, 1>| [pulse(t)].into());
    let ends = batch.control(Adaptive::new(1e-9, 1e-9)).run(0.0..10.0, &mut states);
    for (i, (q, z)) in states.iter().enumerate() {
        let run = Simulation::new(&single).input(|t, _, _| [pulse(t)].into()).adaptive(1e-9, 1e-9);
        let end = run.run_to_end(start(i).0, start(i).1, 0.0..10.0).expect("runs");
        let summary = ends[i].as_ref().expect("runs").summary;
        assert!(q == end.q && z == end.z && summary == end.summary, "state {i}: {q} {z} for {} {}", end.q, end.z);
        // Its impulse is √π/20.
        assert!((z[0] - start(i).1[0] - std::f64::consts::PI.sqrt() / 40.0).abs() < 1e-8, "state {i}: {z}");
    }
}
