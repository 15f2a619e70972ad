//! A leg that hops by model-predictive control: plans through touchdowns and lift-offs, from derivatives of steps with
//! contact.
//!
//! `cargo run --release --example hop_mpc`. Every hundredth of a second a plan of thrusts is improved by the method of
//! Gauss and Newton (iLQR) and its first thrust is applied; the plant takes steps a fifth as long, its body is heavier
//! than the model's, and it is struck on the way. Beside it the thrusts that were planned at the start are replayed.

mod model;
mod plan;
#[cfg(test)]
mod tests;

use std::error::Error;

use model::{HALF, Model, SAMPLE, STRUCK, by_plans, run, thrusts, wanted};

fn main() -> Result<(), Box<dyn Error>> {
    let samples = gauss_examples::runs(420).max(320);
    let model = Model::new(4.0)?;
    // One plan for all of the time, from guesses that get better piece by piece.
    let thrusts = thrusts(&model, samples).ok_or("no plan")?;
    let replayed = run(samples, |n, _| thrusts.get(n).copied());
    let mut most = 0.0_f64;
    let planned = by_plans(&model, samples, &thrusts, |thrust| most = most.max(thrust.abs()))?;
    let apex = wanted(0.5 * HALF)[0];
    println!(
        "A leg that is to hop to {apex:.3} m, struck at {:.1} s; its body is a tenth heavier than the model's.",
        SAMPLE * STRUCK.0 as f64
    );
    let listed = |apexes: &[f64]| apexes.iter().map(|apex| format!("{apex:.3}")).collect::<Vec<_>>().join(" ");
    println!(
        "  plans:  apexes {} m; off by {:.1e} m in the last second; thrusts up to {most:.0} N",
        listed(&planned.apexes),
        planned.off
    );
    match &replayed {
        Ok(run) => println!("  replay: apexes {} m; off by {:.1e} m in the last second", listed(&run.apexes), run.off),
        Err(error) => println!("  replay: {error}"),
    }
    let replay_is_off = replayed.map_or(true, |run| run.off > 5.0 * planned.off);
    if planned.off > 0.05 || !replay_is_off {
        return Err("the leg does not hop by its plans".into());
    }
    Ok(())
}
