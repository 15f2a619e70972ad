//! Many states at once: the bits of single runs, remainders, parameters of their own, states that stop, threads.

mod ensembles;
mod one_length;

use std::ops::Range;

use gauss_batch::{Batch, BatchSystem, Packs, SingleConfiguration, SingleSpeeds, States};
use gauss_runtime::integrate::{Fixed, IntegrationErrorKind, OneStep, Rkmk, RunPart};
use gauss_runtime::prelude::*;
use gauss_runtime::simd::Packed;

/// A heavy body whose pole is not its centre of mass.
#[derive(GaussDynamics)]
#[gauss(chart = left_invariant, taylor)]
struct Thrown<T> {
    #[gauss(mass)]
    mass: T,
    #[gauss(center_of_mass)]
    center: Vector3<T>,
    #[gauss(inertia)]
    inertia: Vector3<T>,
    #[gauss(gravity)]
    g: T,
}

/// A body that turns about O, in Euler angles.
#[derive(GaussDynamics)]
#[gauss(motion = fixed_point, chart = jet(euler_zxz))]
struct Top<T> {
    #[gauss(mass)]
    mass: T,
    #[gauss(center_of_mass)]
    center: Vector3<T>,
    #[gauss(inertia)]
    inertia: Vector3<T>,
    #[gauss(gravity)]
    g: T,
}

/// A point in a bath, so thick that speeds decay within a part of a step.
#[derive(GaussDynamics)]
#[gauss(coordinates(x), particle(mass = 1, position = [x, 0, 0]), damping = thick / 2 * rate(x) * rate(x))]
struct Bath<T> {
    thick: T,
}

/// A point on a circle, in two coordinates and a constraint.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y),
    particle(mass = mass, position = [x, 0, y]),
    constraint(position = x * x + y * y - length * length),
)]
struct Pendulum<T> {
    mass: T,
    length: T,
    #[gauss(gravity)]
    g: T,
}

fn vector<T: Real>(components: [f64; 3]) -> Vector3<T> {
    Vector3::from(components.map(T::from_f64))
}

fn thrown<T: Real>(mass: T) -> ThrownKernel<T> {
    let inertia = Vector3::new(mass, mass + mass, T::from_f64(2.5) * mass);
    let body = Thrown { mass, center: vector([0.1, -0.05, 0.2]), inertia, g: T::from_f64(9.81) };
    body.kernel().expect("a body")
}

fn top<T: Real>() -> TopKernel<T> {
    let (mass, g) = (T::one(), T::from_f64(9.81));
    Top { mass, center: vector([0.0, 0.0, 0.5]), inertia: vector([0.75, 0.95, 0.3]), g }.kernel().expect("a body")
}

fn pendulum<T: Real>() -> PendulumKernel<T> {
    let number = T::from_f64;
    Pendulum { mass: number(0.5), length: T::one(), g: number(9.81) }.kernel().expect("parameters")
}

/// Numbers in [−1, 1] without a pattern.
fn spread(i: usize, k: usize) -> f64 {
    ((i * 7 + k * 13 + 3) as f64 * 0.618_033_988_749_894_9).fract() * 2.0 - 1.0
}

fn pose(i: usize) -> Isometry3<f64> {
    let turn = UnitQuaternion::from_euler_angles(spread(i, 0), spread(i, 1), 3.0 * spread(i, 2));
    Isometry3::from_parts(Translation3::new(spread(i, 3), spread(i, 4), spread(i, 5)), turn)
}

fn twist(i: usize) -> SVector<f64, 6> {
    SVector::from(std::array::from_fn(|k| 2.0 * spread(i, 6 + k)))
}

fn angles(i: usize) -> (SVector<f64, 3>, SVector<f64, 3>) {
    let rates = SVector::from(std::array::from_fn(|k| 3.0 * spread(i, 9 + k)));
    (SVector::from([spread(i, 0), 1.5 + 0.5 * spread(i, 1), spread(i, 2)]), rates)
}

fn on_the_circle(i: usize) -> (SVector<f64, 2>, SVector<f64, 2>) {
    let (sine, cosine) = (2.0 * spread(i, 0)).sin_cos();
    let rate = spread(i, 1);
    (SVector::from([sine, -cosine]), SVector::from([rate * cosine, rate * sine]))
}

/// What the states of a batch in packs and single states have in common.
type Start<S> = (SingleConfiguration<S>, SingleSpeeds<S>);

/// Every state of a batch against a run of its own, in both forms, by any method: equal, bit by bit.
fn agrees_with_single_runs<P, S, M, N>(
    (packed, single): (&P, &S),
    (method, single_method): (M, N),
    start: impl Fn(usize) -> (S::Configuration, S::Speeds),
    (count, step, interval): (usize, f64, Range<f64>),
) where
    P: BatchSystem<Input = ()> + Sync,
    P::Configuration: Packed<Single = S::Configuration> + Send + Sync,
    P::Speeds: Packed<Single = S::Speeds> + Send + Sync,
    S: GaussSystem<Input = (), Configuration: PartialEq, Speeds: PartialEq>,
    S::Scalar: Real,
    M: OneStep<P> + Copy + Sync,
    N: OneStep<S> + Copy,
{
    let number = S::Scalar::from_f64;
    let control = Fixed::by(single_method, number(step));
    let ends = number(interval.start)..number(interval.end);
    let initial = States::<P>::from_fn(count, |i| -> Start<P> { start(i) });

    let mut states = initial.clone();
    Batch::new(packed).advance(&method, step, interval.clone(), &mut states).expect("all reach the end");
    assert_eq!(states.len(), count);
    for (i, (q, z)) in states.iter().enumerate() {
        let (q0, z0) = start(i);
        let end = Simulation::new(single).control(control).run_to_end(q0, z0, ends.clone()).expect("runs");
        assert!(q == end.q && z == end.z, "velocity form, state {i}: {q:?} {z:?} for {:?} {:?}", end.q, end.z);
    }
    let mut in_threads = initial.clone();
    Batch::new(packed).advance_on_all_threads(&method, step, interval.clone(), &mut in_threads).expect("runs");
    assert!(in_threads.iter().zip(states.iter()).all(|(a, b)| a.0 == b.0 && a.1 == b.1));

    let mut states = initial.clone();
    Batch::new(packed).momentum_form().advance(&method, step, interval.clone(), &mut states).expect("runs");
    for (i, (q, z)) in states.iter().enumerate() {
        let (q0, z0) = start(i);
        let run = Simulation::new(single).momentum_form().control(control);
        let end = run.run_to_end(q0, z0, ends.clone()).expect("runs");
        assert!(q == end.q && z == end.z, "momentum form, state {i}");
    }

    let accelerations = Batch::new(packed).accelerations(0.5, &initial);
    let in_threads = Batch::new(packed).accelerations_on_all_threads(0.5, &initial);
    assert_eq!(accelerations.len(), count);
    // In the place of those of fewer states.
    let mut replaced = Batch::new(packed).accelerations(0.5, &States::from_fn(1, &start));
    Batch::new(packed).accelerations_into(0.5, &initial, &mut replaced);
    assert_eq!(replaced.len(), count);
    assert!((0..count).all(|i| replaced.get(i) == accelerations.get(i)));
    for i in 0..count {
        let (q, z) = start(i);
        assert!(accelerations.get(i) == single.acceleration(number(0.5), &q, &z, &()), "acceleration {i}");
        assert!(accelerations.get(i) == in_threads.get(i));
    }
}

/// Runs with remainders in lanes and in time, forwards and backwards.
const RUNS: [(usize, f64, Range<f64>); 3] = [(21, 0.05, 0.0..1.02), (1, 0.05, 0.3..-0.3), (16, 0.02, 0.0..0.2)];

/// By one method of each kind. In these steps nothing turns by half a radian.
#[test]
fn every_state_gets_the_bits_of_a_run_of_its_own() {
    type Pack = Lanes<f64, 4>;
    let kernels = (&thrown(Pack::splat(2.0)), &thrown(2.0));
    let start = |i| (pose(i), twist(i));
    for run in RUNS {
        let both = (RungeKutta(DormandPrince5), RungeKutta(DormandPrince5));
        agrees_with_single_runs(kernels, both, start, run.clone());
        agrees_with_single_runs(kernels, (CommutatorFree4, CommutatorFree4), start, run.clone());
        let both = (Rkmk::new(&Tableau::RK4), Rkmk::new(&Tableau::RK4));
        agrees_with_single_runs(kernels, both, start, run);
    }
}

/// In vectors of `wide`, in coordinates with trigonometry, in single precision, and in packs of one.
#[test]
fn so_it_does_in_other_scalars() {
    let both = (RungeKutta(Classical4), RungeKutta(Classical4));
    let single = |i| {
        let (q, z) = angles(i);
        (q.map(|x| x as f32), z.map(|x| x as f32))
    };
    for run in RUNS {
        let start = |i| (pose(i), twist(i));
        agrees_with_single_runs((&thrown(wide::f64x8::splat(2.0)), &thrown(2.0)), both, start, run.clone());
    }
    // Shorter than the way of these angles to their singularity.
    for run in [(19, 0.05, 0.0..0.52), (1, 0.05, 0.2..-0.1)] {
        agrees_with_single_runs((&top::<wide::f64x4>(), &top::<f64>()), both, angles, run.clone());
        agrees_with_single_runs((&top::<f64>(), &top::<f64>()), both, angles, run.clone());
        agrees_with_single_runs((&top::<wide::f32x16>(), &top::<f32>()), both, single, run);
    }
}

/// Projection is an iteration, which goes on until all lanes are done: the same up to rounding.
#[test]
fn constraints_hold_in_every_lane() {
    let (kernel, alone) = (pendulum::<Lanes<f64, 4>>(), pendulum::<f64>());
    let mut states = States::<PendulumKernel<Lanes<f64, 4>>>::from_fn(10, on_the_circle);
    Batch::new(&kernel).advance(&RungeKutta(Classical4), 0.01, 0.0..1.0, &mut states).expect("runs");
    for (i, (q, z)) in states.iter().enumerate() {
        assert!((q.norm() - 1.0).abs() < 4.0 * f64::EPSILON && q.dot(&z).abs() < 8.0 * f64::EPSILON * z.norm());
        let (q0, z0) = on_the_circle(i);
        let run = Simulation::new(&alone).control(Fixed::by(RungeKutta(Classical4), 0.01));
        let end = run.run_to_end(q0, z0, 0.0..1.0).expect("runs");
        // 100 steps of some thirty roundings of numbers up to 10, which this motion carries on hardly larger.
        assert!((q - end.q).norm() + (z - end.z).norm() < 100.0 * 30.0 * 10.0 * f64::EPSILON);
    }
}

#[test]
fn states_may_have_parameters_of_their_own() {
    type Pack = Lanes<f64, 8>;
    let mass = |i: usize| 1.0 + 0.1 * i as f64;
    let masses = Packs::<Pack>::from_fn(21, mass);
    let kernels: Vec<_> = masses.blocks().iter().map(|&mass| thrown(mass)).collect();
    assert_eq!(kernels.len(), 3);
    let mut states = States::<ThrownKernel<Pack>>::from_fn(21, |i| (pose(i), twist(i)));
    let before = states.clone();
    Batch::each(&kernels).advance(&RungeKutta(Classical4), 0.05, 0.0..1.0, &mut states).expect("runs");
    let accelerations = Batch::each(&kernels).accelerations(0.0, &before);
    for (i, (q, z)) in states.iter().enumerate() {
        let kernel = thrown(mass(i));
        let run = Simulation::new(&kernel).control(Fixed::by(RungeKutta(Classical4), 0.05));
        let end = run.run_to_end(pose(i), twist(i), 0.0..1.0).expect("runs");
        assert!(q == end.q && z == end.z, "state {i}");
        assert_eq!(accelerations.get(i), kernel.acceleration(0.0, &pose(i), &twist(i), &()));
    }
}

/// One state is undefined from the start, one turns too fast, one meets the singularity of its angles: each is named
/// with its own time and reason, and stays where it stopped; its neighbours get the bits that they would get without
/// it.
#[test]
fn states_that_stop_are_named_and_do_not_hinder_others() {
    fn check<T: Real + Packed<Single = f64>>() {
        let start = |i: usize| {
            let (mut q, mut z) = (pose(i), twist(i));
            match i {
                3 => z[1] = f64::NAN,
                6 => q.translation.x = f64::INFINITY,
                12 => z[4] = 80.0,
                _ => {}
            }
            (q, z)
        };
        let (kernel, alone) = (thrown(T::from_f64(2.0)), thrown(2.0));
        let mut states = States::<ThrownKernel<T>>::from_fn(13, start);
        let method = RungeKutta(Classical4);
        let error = Batch::new(&kernel).advance(&method, 0.05, 0.0..1.0, &mut states).expect_err("three stop");
        assert_eq!(error.failures.iter().map(|failure| failure.state).collect::<Vec<_>>(), [3, 6, 12]);
        for i in 0..13 {
            let (q0, z0) = start(i);
            let run = Simulation::new(&alone).control(Fixed::by(method, 0.05));
            let failure = error.failures.iter().find(|failure| failure.state == i);
            let (q, z) = states.get(i);
            match (failure, run.run_to_end(q0, z0, 0.0..1.0)) {
                (Some(failure), Err(alone)) => {
                    assert_eq!((failure.time, failure.kind), (alone.time, alone.kind), "state {i}");
                    // All three stop before the first step is made.
                    let same = |a: f64, b: f64| a.to_bits() == b.to_bits();
                    assert!(z.iter().zip(z0.iter()).all(|(&a, &b)| same(a, b)));
                    assert!(same(q.translation.x, q0.translation.x));
                }
                (None, Ok(end)) => assert!(q == end.q && z == end.z, "state {i}"),
                other => panic!("state {i}: {other:?}"),
            }
        }
        assert!(error.to_string().starts_with("state 3 stopped at t = 0: "), "{error}");
        assert!(error.to_string().ends_with("; and 2 more"), "{error}");
    }
    check::<Lanes<f64, 4>>();
    check::<wide::f64x8>();
    check::<f64>();
}

/// The same in the middle of a run: angles that meet their singularity at different times.
#[test]
fn a_state_that_stops_on_the_way_stays_at_its_last_good_state() {
    let method = RungeKutta(DormandPrince5);
    // The middle angle of every third state goes to π, faster and faster from state to state.
    let start = |i: usize| {
        let (q, z) = angles(i);
        if i.is_multiple_of(3) { (q, SVector::from([0.0, 2.0 + 0.2 * i as f64, 0.0])) } else { (q, z) }
    };
    let level = |mass: f64| Lanes::<f64, 8>::splat(mass);
    let weightless =
        Top { mass: level(1.0), center: vector([0.0; 3]), inertia: vector([0.75, 0.75, 0.3]), g: level(0.0) };
    let kernel = weightless.kernel().expect("a body");
    let alone = Top { mass: 1.0, center: vector([0.0; 3]), inertia: vector([0.75, 0.75, 0.3]), g: 0.0 }
        .kernel()
        .expect("a body");
    let mut states = States::<TopKernel<Lanes<f64, 8>>>::from_fn(18, start);
    let failures = match Batch::new(&kernel).advance(&method, 0.02, 0.0..1.0, &mut states) {
        Ok(()) => Vec::new(),
        Err(error) => error.failures,
    };
    let mut last_samples = 0;
    for (i, (q, z)) in states.iter().enumerate() {
        let (q0, z0) = start(i);
        let run = Simulation::new(&alone).control(Fixed::by(method, 0.02));
        let (path, error) = run.attempt(q0, z0, 0.0..1.0);
        let failure = failures.iter().find(|failure| failure.state == i);
        assert_eq!(failure.map(|f| (f.time, f.kind)), error.map(|e| (e.time, e.kind)), "state {i}");
        let last = path.last();
        assert!(q == last.q && z == last.z, "state {i}");
        last_samples += usize::from(failure.is_some_and(|failure| failure.time > 0.1));
    }
    assert!(last_samples >= 3, "{last_samples} of 18 stop on the way");
}

/// The error of a state says why its steps could not go on, as that of a single run does, not where.
#[test]
fn a_state_that_stops_is_told_the_cause() {
    type Four = Lanes<f64, 4>;
    let (kernel, alone) = (Bath { thick: Four::splat(1e4) }.kernel(), Bath { thick: 1e4 }.kernel());
    let (kernel, alone) = (kernel.expect("a bath"), alone.expect("a bath"));
    // Every other one is at rest, and stays there.
    let start = |i: usize| (SVector::from([0.0]), SVector::from([(i % 2) as f64]));
    let mut states = States::<BathKernel<Four>>::from_fn(6, start);
    let stopped = Batch::new(&kernel).advance(&RungeKutta(Classical4), 0.01, 0.0..10.0, &mut states);
    let failures = stopped.expect_err("the moving ones stop").failures;
    assert_eq!(failures.iter().map(|failure| failure.state).collect::<Vec<_>>(), [1, 3, 5]);
    let run = Simulation::new(&alone).control(Fixed::by(RungeKutta(Classical4), 0.01));
    let (q, z) = start(1);
    let error = run.run_to_end(q, z, 0.0..10.0).expect_err("stiff");
    assert!(matches!(error.kind, IntegrationErrorKind::Stiff { .. }), "{error}");
    assert!(failures.iter().all(|failure| (failure.time, failure.kind) == (error.time, error.kind)), "{failures:?}");
}

#[test]
fn what_nobody_can_run_is_refused() {
    let kernel = top::<Lanes<f64, 4>>();
    let mut states = States::<TopKernel<Lanes<f64, 4>>>::from_fn(6, angles);
    let before: Vec<_> = states.iter().collect();
    for (step, interval, kind) in [
        (0.0, 0.0..1.0, IntegrationErrorKind::InvalidStep { step: 0.0 }),
        (0.1, 0.0..f64::INFINITY, IntegrationErrorKind::InvalidInterval),
    ] {
        let error = Batch::new(&kernel).advance(&RungeKutta(Classical4), step, interval, &mut states);
        let failures = error.expect_err("refused").failures;
        assert!(failures.len() == 6 && failures.iter().all(|failure| failure.kind == kind));
        assert_eq!(states.iter().collect::<Vec<_>>(), before);
    }
    let mut broken =
        States::<TopKernel<Lanes<f64, 4>>>::from_fn(2, |_| (SVector::from([f64::NAN; 3]), SVector::zeros()));
    let error = Batch::new(&kernel).advance(&RungeKutta(Classical4), 0.1, 0.0..1.0, &mut broken).expect_err("refused");
    assert_eq!(error.failures[1].kind, IntegrationErrorKind::NonFinite { part: RunPart::InitialState });
    let mut none = States::<TopKernel<Lanes<f64, 4>>>::from_fn(0, angles);
    assert!(none.is_empty() && Batch::new(&kernel).advance(&CommutatorFree4, 0.1, 0.0..1.0, &mut none).is_ok());
}

#[test]
fn single_values_can_be_read_and_replaced() {
    let mut packs = Packs::<Lanes<f64, 4>>::from_fn(6, |i| i as f64);
    packs.set(5, &50.0);
    packs.set(1, &10.0);
    assert_eq!(packs.iter().collect::<Vec<_>>(), [0.0, 10.0, 2.0, 3.0, 4.0, 50.0]);
    // The rest of the last block repeats the last value.
    assert_eq!(packs.blocks()[1], Lanes([4.0, 50.0, 50.0, 50.0]));
    assert_eq!((packs.len(), packs.is_empty(), packs.get(4)), (6, false, 4.0));
}
