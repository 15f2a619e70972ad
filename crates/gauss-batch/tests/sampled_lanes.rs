//! Controllers that sample in lanes and on threads: each run has the bits of one of its own, and the closed form.

use gauss_batch::{Batch, Ensemble, LaneControl, RunOutcome, States};
use gauss_runtime::integrate::drive::event::Events;
use gauss_runtime::integrate::{Adams, Control, Fixed, IntegrationErrorKind, SamplingMistake};
use gauss_runtime::prelude::*;

/// A pendulum with a motor at its hinge.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(angle), input(torque), particle(mass = m, position = [l * sin(angle), 0, -l * cos(angle)]),
    drive(angle = torque),
)]
struct Swing<T> {
    m: T,
    l: T,
    #[gauss(gravity)]
    g: T,
}

/// A cart that a motor pushes.
#[derive(GaussDynamics)]
#[gauss(coordinates(x), input(push), particle(mass = m, position = [x, 0, 0]), drive(x = push))]
struct Cart<T> {
    m: T,
}

type Pack = Lanes<f64, 4>;
type One = SVector<f64, 1>;

fn swing<T: Real>() -> SwingKernel<T> {
    let [m, l, g] = [0.5, 0.7, 9.81].map(T::from_f64);
    Swing { m, l, g }.kernel().expect("a pendulum")
}

/// A law with a memory: of the last angle, and of a sum.
fn law<T: Real>() -> impl FnMut(T, &SVector<T, 1>, &SVector<T, 1>) -> SVector<T, 1> + Clone {
    let (mut before, mut sum) = (None::<T>, T::zero());
    move |t, q, _| {
        let [stiff, slow, little] = [6.0, 12.0, 0.5].map(T::from_f64);
        sum += q[0];
        let change = q[0] - before.replace(q[0]).unwrap_or(q[0]);
        SVector::from([-(stiff * q[0] + slow * change + little * sum) + T::from_f64(0.1) * t])
    }
}

fn start(i: usize) -> (One, One) {
    (SVector::from([0.3 + 0.17 * i as f64]), SVector::from([1.0 - 0.4 * i as f64]))
}

/// Eleven runs in lanes of four, and on threads, against as many alone, to the bit; with events, jumps and delays.
fn agree<C, D>((control, alone): (C, D), interval: (f64, f64))
where
    C: LaneControl<SwingKernel<Pack>> + Copy + Sync,
    D: Control<SwingKernel<f64>> + Copy,
{
    let (packed, single) = (swing::<Pack>(), swing::<f64>());
    let gust = |t: Pack, _: &SVector<Pack, 1>, _: &SVector<Pack, 1>| SVector::from([Pack::splat(0.2) * t]);
    let ready = || {
        Batch::new(&packed)
            .input(gust)
            .control(control)
            .sampled(0.1, law::<Pack>())
            .delayed(0.03)
            .initially(SVector::from([Pack::splat(0.4)]))
            .sampled(0.07, |_, _, z: &SVector<Pack, 1>| SVector::from([-z[0]]))
            .event(Crossing::Falling, |_, q: &SVector<Pack, 1>, _: &SVector<Pack, 1>| q[0] - Pack::splat(0.2))
            .then_through(|state: &mut Sample<SwingKernel<Pack>>| state.z[0] = Pack::splat(0.5) * state.z[0])
            .until(Crossing::Falling, |_, q: &SVector<Pack, 1>, _: &SVector<Pack, 1>| q[0] - Pack::splat(0.05))
    };
    let run = |in_threads: bool| {
        let mut states = States::<SwingKernel<Pack>>::from_fn(11, start);
        let span = interval.0..interval.1;
        let ends =
            if in_threads { ready().run_on_all_threads(span, &mut states) } else { ready().run(span, &mut states) };
        (states, ends)
    };
    let ((states, ends), (again, _)) = (run(false), run(true));
    let (mut jumped, mut stopped) = (0, 0);
    for (i, end) in ends.into_iter().enumerate() {
        let (q, z) = start(i);
        let own = Simulation::new(&single)
            .input(|t, _, _| SVector::from([0.2 * t]))
            .control(alone)
            .sampled(0.1, law::<f64>())
            .delayed(0.03)
            .initially(SVector::from([0.4]))
            .sampled(0.07, |_, _, z| SVector::from([-z[0]]))
            .event(Crossing::Falling, |_, q, _| q[0] - 0.2)
            .then_through(|state| state.z[0] *= 0.5)
            .until(Crossing::Falling, |_, q, _| q[0] - 0.05);
        let own = own.run_to_end(q, z, interval.0..interval.1).expect("runs");
        let end = end.expect("runs");
        assert_eq!((end.time, end.stopped_by, end.summary), (own.t, own.stopped_by, own.summary), "{i}");
        assert_eq!(states.get(i), (own.q, own.z), "{i}");
        (jumped, stopped) = (jumped + end.summary.jumps, stopped + u32::from(end.stopped_by.is_some()));
    }
    assert!(jumped > 3 && stopped > 0, "{jumped} {stopped}");
    assert!(states.iter().zip(again.iter()).all(|(a, b)| a == b));
}

#[test]
fn every_run_has_the_bits_of_its_own() {
    agree((Adaptive::new(1e-9, 1e-9), Adaptive::new(1e-9, 1e-9)), (0.0, 2.0));
    agree((Adaptive::new(1e-5, 1e-5), Adaptive::new(1e-5, 1e-5)), (-0.35, 1.9));
    agree((Fixed::new(Pack::splat(0.013)), Fixed::new(0.013)), (0.0, 2.0));
    agree((Adams::<_, 4>::new(Pack::splat(0.004)), Adams::<_, 4>::new(0.004)), (0.0, 2.0));
}

/// A cart under a force that is held for a period is x⁺ = x + h v + h² u/4, v⁺ = v + h u/2 for 2 kg.
#[test]
fn held_forces_make_a_matrix() {
    let kernel = Cart { m: Pack::splat(2.0) }.kernel().unwrap();
    let mut states = States::<CartKernel<Pack>>::from_fn(7, start);
    let h = 0.05;
    let held = |_: Pack, q: &SVector<Pack, 1>, z: &SVector<Pack, 1>| {
        SVector::from([Pack::splat(-8.0) * q[0] - Pack::splat(6.0) * z[0]])
    };
    let ends = Batch::new(&kernel).adaptive(1e-12, 1e-12).sampled(h, held).run(0.0..2.0, &mut states);
    assert!(ends.iter().all(Result::is_ok));
    for i in 0..7 {
        let ([x], [v]): ([f64; 1], [f64; 1]) = (start(i).0.into(), start(i).1.into());
        let (x, v) = (0..40).fold((x, v), |(x, v), _| {
            let u = -8.0 * x - 6.0 * v;
            (x + h * v + 0.25 * h * h * u, v + 0.5 * h * u)
        });
        let (q, z): (One, One) = states.get(i);
        // Forty periods of a few roundings, of numbers of order 1.
        assert!((q[0] - x).abs() < 1e-12 && (z[0] - v).abs() < 1e-12, "{i}: {q} {z} for {x} {v}");
    }
}

fn kinds<F, I, C, E, Kind>(
    ensemble: &Ensemble<'_, SwingKernel<Pack>, F, I, C, E>,
    span: (f64, f64),
) -> Vec<IntegrationErrorKind>
where
    F: gauss_runtime::integrate::Form<SwingKernel<Pack>>,
    I: gauss_batch::LaneInput<SwingKernel<Pack>, Kind>,
    C: LaneControl<SwingKernel<Pack>>,
    E: Events<SwingKernel<Pack>> + Clone,
{
    let mut states = States::from_fn(6, start);
    let ends: Vec<RunOutcome<SwingKernel<Pack>>> = ensemble.run(span.0..span.1, &mut states);
    ends.into_iter().filter_map(Result::err).map(|error| error.kind).collect()
}

/// A run whose controller fails ends by itself; a period that is none ends all.
#[test]
fn mistakes_are_those_of_each_run() {
    let kernel = swing::<Pack>();
    let none = |_: Pack, q: &SVector<Pack, 1>, _: &SVector<Pack, 1>| {
        SVector::from([if q[0].lane(0) > 1.0 { Pack::splat(f64::NAN) } else { Pack::splat(0.0) }])
    };
    let wrong = |mistake| IntegrationErrorKind::Sampling { controller: 0, mistake };
    let batch = || Batch::new(&kernel).adaptive(1e-9, 1e-9);
    // One of six begins beyond 1 rad.
    assert_eq!(kinds(&batch().sampled(0.1, none), (0.0, 0.05)), [wrong(SamplingMistake::Input); 1]);
    let ones = |_: Pack, _: &SVector<Pack, 1>, _: &SVector<Pack, 1>| SVector::from([Pack::splat(1.0)]);
    assert_eq!(kinds(&batch().sampled(0.0, ones), (0.0, 1.0)), [wrong(SamplingMistake::Period(0.0)); 6]);
    assert_eq!(kinds(&batch().sampled(0.1, ones), (1.0, 0.0)), [wrong(SamplingMistake::Backward); 6]);
}
