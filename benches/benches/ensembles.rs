//! `RUSTFLAGS="-C target-cpu=native" cargo bench -p gauss-benches --bench ensembles [-- A B C]`: many runs with steps
//! of their own on one thread, beside runs one after another. `benches/peers/ensembles.py` is the same with heyoka.
//!
//! µs a trajectory and simulated second, the fastest of many rounds, and the largest error of the attitude at the end.
//! With `--features threads` a second table: more trajectories, on 1, 2, 4 … threads, in turn.

#[cfg(feature = "threads")]
#[path = "ensembles/threads.rs"]
mod threads;

use std::time::Instant;

use gauss_batch::{Batch, BatchSystem, LaneControl, States};
use gauss_benches::packs::{free_top, immersed, symmetric_top};
use gauss_exact::{FreeFlow, Scheme, Splitting};
use gauss_runtime::integrate::{Adams, Adaptive, Fixed, Taylor, Verner9};
use gauss_runtime::prelude::*;
use wide::f64x8;

/// How many trajectories there are.
const RUNS: usize = 64;

/// A trajectory: how long it lasts, where it starts, and the attitude at its end, from references with 25 digits.
struct Case<Q, Z> {
    name: &'static str,
    duration: f64,
    start: (Q, Z),
    end: UnitQuaternion<f64>,
}

/// The attitude of a configuration.
trait Attitude: Copy {
    fn attitude(&self) -> UnitQuaternion<f64>;
}

impl Attitude for UnitQuaternion<f64> {
    fn attitude(&self) -> UnitQuaternion<f64> {
        *self
    }
}

impl Attitude for Isometry3<f64> {
    fn attitude(&self) -> UnitQuaternion<f64> {
        self.rotation
    }
}

fn quaternion([x, y, z, w]: [f64; 4]) -> UnitQuaternion<f64> {
    UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z))
}

/// The angle between two attitudes, without loss where it is small.
fn angle(a: &UnitQuaternion<f64>, b: &UnitQuaternion<f64>) -> f64 {
    let between = (a.inverse() * b).coords;
    2.0 * Vector3::new(between[0], between[1], between[2]).norm()
}

/// µs of the fastest of some rounds.
fn fastest(rounds: usize, mut work: impl FnMut()) -> f64 {
    let time = |_| {
        let begun = Instant::now();
        work();
        begun.elapsed().as_secs_f64() * 1e6
    };
    (0..rounds).map(time).fold(f64::INFINITY, f64::min)
}

/// One line: one by one, and as an ensemble.
fn line<S, P, C, D>(
    case: &Case<S::Configuration, S::Speeds>,
    how: &str,
    (one, pack): (&S, &P),
    (control, in_lanes): (C, D),
) where
    S: GaussSystem<Scalar = f64, Input = (), Configuration: Attitude>,
    P: BatchSystem<Input = ()>,
    P::Configuration: gauss_runtime::simd::Packed<Single = S::Configuration>,
    P::Speeds: gauss_runtime::simd::Packed<Single = S::Speeds>,
    C: Copy + gauss_runtime::integrate::Control<S>,
    D: LaneControl<P>,
{
    let (q, z) = case.start;
    let run = || Simulation::new(one).control(control).run_to_end(q, z, 0.0..case.duration).expect("a smooth run");
    let end = run();
    let alone = fastest(60, || {
        std::hint::black_box(run());
    });
    let starts = States::<P>::from_fn(RUNS, |_| case.start);
    let mut states = starts.clone();
    let ensemble = Batch::new(pack).control(in_lanes);
    let together = fastest(60, || {
        states.clone_from(&starts);
        let ends = ensemble.run(0.0..case.duration, &mut states);
        assert!(ends.iter().all(Result::is_ok), "{}", case.name);
    });
    let error = states.iter().map(|(q, _)| angle(&q.attitude(), &case.end)).fold(0.0, f64::max);
    println!(
        "| {} | {how} | {} steps | {:.2} | {:.3} | {error:.0e} |",
        case.name,
        end.summary.steps,
        alone / case.duration,
        together / case.duration / RUNS as f64,
    );
}

/// Several ways to one trajectory.
macro_rules! case {
    ($case:expr, $kernel:ident, [$(($how:literal, $control:expr)),+ $(,)?]) => {{
        let case: &Case<_, _> = $case;
        let kernels = ($kernel::<f64>(), $kernel::<f64x8>());
        $(line(case, $how, (&kernels.0, &kernels.1), ($control, $control));)+
        kernels
    }};
}

/// Adams' method of K steps, so many in all.
fn adams<S, P, const K: usize>(case: &Case<S::Configuration, S::Speeds>, (one, pack): (&S, &P), steps: u32)
where
    S: GaussSystem<Scalar = f64, Input = (), Configuration: Attitude>,
    P: BatchSystem<Input = ()>,
    P::Scalar: gauss_runtime::simd::Packed<Single = f64>,
    P::Configuration: gauss_runtime::simd::Packed<Single = S::Configuration>,
    P::Speeds: gauss_runtime::simd::Packed<Single = S::Speeds>,
{
    let step = case.duration / f64::from(steps);
    let controls = (Adams::<_, K>::new(step), Adams::<_, K>::new(P::Scalar::from_f64(step)));
    line(case, &format!("Adams, {K} steps"), (one, pack), controls);
}

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with('-')).collect();
    let asked = |name: &str| words.is_empty() || words.iter().any(|word| word == name);
    println!("| | method | steps | one by one | ensemble | error |\n|---|---|---|---|---|---|");
    if asked("A") {
        a();
    }
    if asked("B") {
        b();
    }
    if asked("C") {
        c();
    }
    #[cfg(feature = "threads")]
    threads::table(asked);
}

fn case_a() -> Case<UnitQuaternion<f64>, Vector3<f64>> {
    Case {
        name: "A",
        duration: 100.0,
        start: (UnitQuaternion::identity(), Vector3::new(0.01, 1.0, 0.01)),
        end: quaternion([0.9654395742742695, -7.971609403978595e-05, -0.260156908801055, -0.015646241514854095]),
    }
}

fn a() {
    let case = case_a();
    let kernels = case!(
        &case,
        free_top,
        [
            ("order 8, 1e-12", Adaptive::new(1e-12, 1e-12)),
            ("order 9, 1e-12", Adaptive::by(RungeKutta(Verner9), 1e-12, 1e-12)),
            ("series, 1e-13", Taylor::new(1e-13, 1e-13)),
        ]
    );
    let kernels = (&kernels.0, &kernels.1);
    adams::<_, _, 10>(&case, kernels, 1600);
    adams::<_, _, 12>(&case, kernels, 1300);
    let alone = Splitting::exact(kernels.0, Scheme::STRANG).expect("a free body");
    let in_lanes = Splitting::with(kernels.1, Scheme::STRANG, FreeFlow::in_lanes::<_, 8>).expect("a free body");
    let controls = (Fixed::by(alone, 100.0), Fixed::by(in_lanes, f64x8::splat(100.0)));
    line(&case, "closed form", kernels, controls);
}

fn case_b() -> Case<UnitQuaternion<f64>, Vector3<f64>> {
    Case {
        name: "B",
        duration: 20.0,
        start: (quaternion([0.24740395925452294, 0.0, 0.0, 0.9689124217106447]), Vector3::new(0.0, 0.0, 15.0)),
        end: quaternion([-0.24875095621040977, -0.003645005941271747, -0.5907343441740279, -0.7675562587389774]),
    }
}

fn b() {
    let case = case_b();
    let kernels = case!(
        &case,
        symmetric_top,
        [
            ("order 8, 1e-12", Adaptive::new(1e-12, 1e-12)),
            ("order 9, 1e-12", Adaptive::by(RungeKutta(Verner9), 1e-12, 1e-12)),
            ("series, 1e-13", Taylor::new(1e-13, 1e-13)),
        ]
    );
    let kernels = (&kernels.0, &kernels.1);
    adams::<_, _, 10>(&case, kernels, 4400);
    adams::<_, _, 11>(&case, kernels, 3400);
}

fn case_c() -> Case<Isometry3<f64>, Vector6<f64>> {
    Case {
        name: "C",
        duration: 10.0,
        start: (Isometry3::identity(), Vector6::new(1.0, 0.2, -0.1, 0.5, -0.3, 0.4)),
        end: quaternion([-0.14624540214346288, -0.09108370747518893, 0.7755064251707701, -0.607376180882428]),
    }
}

fn c() {
    let case = case_c();
    let kernels = case!(
        &case,
        immersed,
        [
            ("order 8, 1e-13", Adaptive::new(1e-13, 1e-13)),
            ("order 9, 1e-13", Adaptive::by(RungeKutta(Verner9), 1e-13, 1e-13)),
            ("series, 1e-13", Taylor::new(1e-13, 1e-13)),
        ]
    );
    let kernels = (&kernels.0, &kernels.1);
    adams::<_, _, 8>(&case, kernels, 700);
    adams::<_, _, 10>(&case, kernels, 540);
    adams::<_, _, 11>(&case, kernels, 420);
    adams::<_, _, 12>(&case, kernels, 376);
}
