//! Ensembles on several threads: the same trajectories on 1, 2, 4 … of them, in turn.

use std::time::Instant;

use gauss_batch::{Batch, BatchSystem, LaneControl, States};
use gauss_benches::packs::{free_top, immersed, symmetric_top};
use gauss_runtime::integrate::{Adams, Taylor};
use gauss_runtime::simd::Packed;
use rayon::{ThreadPool, ThreadPoolBuilder};
use wide::f64x8;

use super::{Attitude, Case, angle, case_a, case_b, case_c};

/// How many trajectories there are: 64 for each of four threads, done before other programs want their processors.
const RUNS: usize = 256;

/// How often each number of threads is measured.
const ROUNDS: usize = 600;

/// Pools of 1, 2, 4 … threads, as far as there are processors.
struct Pools(Vec<ThreadPool>);

impl Pools {
    fn new() -> Self {
        let processors = std::thread::available_parallelism().map_or(1, usize::from);
        let powers = std::iter::successors(Some(1), |threads| Some(2 * threads));
        let pool = |threads| ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        Self(powers.take_while(|&threads| threads <= processors).map(pool).collect())
    }

    fn head(&self) {
        let threads: String = self.0.iter().map(|pool| format!(" {} |", pool.current_num_threads())).collect();
        println!("\n| | method |{threads} error |\n|---|---|{}---|", "---|".repeat(self.0.len()));
    }

    /// One line: µs a trajectory and simulated second, the fastest rounds; how many times those of one thread.
    fn line<P, D>(
        &self,
        case: &Case<<P::Configuration as Packed>::Single, <P::Speeds as Packed>::Single>,
        how: &str,
        pack: &P,
        control: D,
    ) where
        P: BatchSystem<
                Input = (),
                Configuration: Packed<Single: Attitude + Send> + Send,
                Speeds: Packed<Single: Send> + Send,
            > + Sync,
        D: LaneControl<P> + Sync,
    {
        let starts = States::<P>::from_fn(RUNS, |_| case.start);
        let mut states = starts.clone();
        let ensemble = Batch::new(pack).control(control);
        let mut fastest = vec![f64::INFINITY; self.0.len()];
        let (mut error, duration) = (0.0_f64, case.duration);
        for _ in 0..ROUNDS {
            for (pool, fastest) in self.0.iter().zip(&mut fastest) {
                states.clone_from(&starts);
                let (ends, took) = pool.install(|| {
                    let begun = Instant::now();
                    let ends = ensemble.run_on_all_threads(0.0..duration, &mut states);
                    (ends, begun.elapsed().as_secs_f64() * 1e6)
                });
                assert!(ends.iter().all(Result::is_ok), "{}", case.name);
                *fastest = fastest.min(took);
                error = states.iter().map(|(q, _)| angle(&q.attitude(), &case.end)).fold(error, f64::max);
            }
        }
        let time = |took: &f64| format!(" {:.3} ({:.2}) |", took / duration / RUNS as f64, fastest[0] / took);
        let times: String = fastest.iter().map(time).collect();
        println!("| {} | {how} |{times} {error:.0e} |", case.name);
    }
}

/// The fastest ways to the three trajectories.
pub(super) fn table(asked: impl Fn(&str) -> bool) {
    let pools = Pools::new();
    pools.head();
    if asked("A") {
        pools.line(&case_a(), "Adams, 12 steps", &free_top::<f64x8>(), adams::<12>(100.0 / 1300.0));
    }
    if asked("B") {
        let (case, kernel) = (case_b(), symmetric_top::<f64x8>());
        pools.line(&case, "series, 1e-13", &kernel, Taylor::new(1e-13, 1e-13));
        pools.line(&case, "Adams, 11 steps", &kernel, adams::<11>(20.0 / 3400.0));
    }
    if asked("C") {
        pools.line(&case_c(), "Adams, 11 steps", &immersed::<f64x8>(), adams::<11>(10.0 / 440.0));
    }
}

fn adams<const K: usize>(step: f64) -> Adams<f64x8, K> {
    Adams::new(f64x8::splat(step))
}
