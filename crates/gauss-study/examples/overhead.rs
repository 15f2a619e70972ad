//! What a study costs beside its runs: drawing ten parameters, and writing them with four results.
//!
//! `cargo run --release -p gauss-study --example overhead [-- RUNS]`

use std::error::Error;
use std::time::Instant;

use gauss_study::{Declaration, Plan, normal, uniform};

fn main() -> Result<(), Box<dyn Error>> {
    let runs: u64 = std::env::args().nth(1).map_or(Ok(1_000_000), |runs| runs.parse())?;
    let declared = |plan| {
        let mut study = Declaration::new("overhead", 1, runs).plan(plan);
        (0..5).for_each(|k| _ = study.parameter(&format!("u{k}"), "", uniform(0.0, 1.0)));
        (0..5).for_each(|k| _ = study.parameter(&format!("n{k}"), "", normal(0.0, 1.0)));
        study
    };
    for plan in [Plan::Random, Plan::LatinHypercube, Plan::Sobol] {
        let (sampler, clock) = (declared(plan).sampler()?, Instant::now());
        let sum: f64 = (0..runs).map(|run| sampler.sample(run).values().iter().sum::<f64>()).sum();
        let each = clock.elapsed().as_secs_f64() / runs as f64;
        println!("{plan:?}: {:.2} µs a run on one thread (mean {:.4})", 1e6 * each, sum / runs as f64);
    }
    let mut study = declared(Plan::Random);
    let results: Vec<_> = (0..3).map(|k| study.number(&format!("r{k}"), "")).collect();
    let word = study.text("outcome");
    let study = study.study(|draw, row| {
        results.iter().zip(draw.values()).for_each(|(column, value)| row.set(*column, *value));
        row.set(word, if draw.values()[0] < 0.5 { "stands" } else { "tips over" });
        Ok::<_, String>(())
    })?;
    for threads in [1, 2] {
        let folder = std::env::temp_dir().join(format!("gauss_overhead_{}_{threads}", std::process::id()));
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
        let clock = Instant::now();
        pool.install(|| study.run(&folder, |_| ()))?;
        let made = clock.elapsed().as_secs_f64();
        let clock = Instant::now();
        let bytes = std::fs::metadata(study.merge(&folder)?)?.len();
        let merged = clock.elapsed().as_secs_f64();
        println!(
            "{threads} threads: {:.2} µs a run, drawn and written; {:.1} bytes a run; merged at {:.0} MB/s",
            1e6 * made / runs as f64,
            bytes as f64 / runs as f64,
            1e-6 * bytes as f64 / merged
        );
        std::fs::remove_dir_all(folder)?;
    }
    Ok(())
}
