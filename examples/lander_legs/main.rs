//! A lander's touchdown, a thousand times: approach, attitude, slope and friction are random; it stands, slides or
//! tips over. Contact in steps, on all threads; run i is a function of the seed and i.
//!
//! `cargo run --release --example lander_legs [-- FOLDER]` draws the picture into `FOLDER`, by default `target/gauss`.
//! `RUNS=100` before it: fewer runs; `SEED=2`: other ones.

// The example `study` takes more of it.
#[allow(dead_code, reason = "a module of two examples")]
mod lander;
mod picture;
#[cfg(test)]
mod tests;

use std::error::Error;
use std::time::Instant;

use gauss_examples::plots::{write, write_page};
use gauss_examples::runs;
use gauss_study::Declaration;

use lander::{LONGEST, Lander, Landing, OUTCOMES, Outcome, Parameters, Run, wilson};

fn main() -> Result<(), Box<dyn Error>> {
    let count = runs(1000);
    let seed = std::env::var("SEED").ok().and_then(|seed| seed.parse().ok()).unwrap_or(1);
    let clock = Instant::now();
    let mut study = Declaration::new("touchdowns", seed, count as u64);
    let parameters = Parameters::declare_all(&mut study);
    let ends = study.sampler()?.map(|sample| {
        let approach = parameters.approach(sample);
        let landing = approach.touch_down().map_err(|error| format!("run {}: {error}", sample.run()))?;
        Ok::<Run, String>((approach, landing))
    });
    let refused: Vec<String> = ends.iter().filter_map(|end| end.as_ref().err().cloned()).collect();
    let runs: Vec<Run> = ends.into_iter().flatten().collect();
    println!("{count} touchdowns of seed {seed} in {:.1} s\n", clock.elapsed().as_secs_f64());
    println!("                                               means: speed   fall    tilt   slope   slid   crushed");
    println!("  outcome     runs   share   95 % of it         m/s     m/s     °      °       m      m");
    for (outcome, name) in OUTCOMES {
        let of: Vec<&Run> = runs.iter().filter(|(_, landing)| landing.outcome == outcome).collect();
        let (low, high) = wilson(of.len(), count);
        let share = of.len() as f64 / count as f64;
        print!("  {name:<10} {:>5}   {share:.4}   {low:.4} to {high:.4}", of.len());
        if !of.is_empty() {
            let mean = |figure: fn(&Run) -> f64| of.iter().map(|run| figure(run)).sum::<f64>() / of.len() as f64;
            let [speed, fall] = [mean(|run| run.0.lateral), mean(|run| run.0.fall)];
            let [tilt, slope] = [mean(|run| run.0.tilt.to_degrees()), mean(|run| run.0.slope.to_degrees())];
            let [slid, crushed] = [mean(|run| run.1.slid), mean(|run| run.1.crushed)];
            print!("   {speed:.2}    {fall:.2}    {tilt:.1}    {slope:>4.1}   {slid:>5.2}   {crushed:.3}");
        }
        println!();
    }
    // They count as neither.
    println!("  refused    {:>5}", refused.len());
    refused.iter().for_each(|reason| println!("    {reason}"));
    let worst = |figure: fn(&Landing) -> f64| runs.iter().map(|(_, landing)| figure(landing)).fold(0.0, f64::max);
    let moving = runs.iter().filter(|(_, landing)| landing.outcome == Outcome::Slides && !landing.rests).count();
    println!("\n  {moving} of those that slide do so still after {LONGEST} s");
    println!("  residuals of the laws up to {:.0e} m/s, ", worst(|landing| landing.residual));
    println!("  gaps at the ends of steps down to {:.0e} m", -worst(|landing| -landing.lowest));
    let bound = Lander::small(1.0, 0.0).tips_above(1.25);
    println!("\nFlat on level ground, with feet that stick and struts that hold, it would tip above {bound:.3} m/s.");
    write("lander_legs", &picture::draw(&runs, bound)?)?;
    write_page("lander_legs", &picture::page(&runs)?)
}
