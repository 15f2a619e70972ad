//! A pendulum with dry friction, a spiral spring and a buffer: which element takes which part of the energy, and where
//! friction holds it in the end.
//!
//! `cargo run --release --example friction_pendulum [-- FOLDER]` draws the picture into `FOLDER`, by default
//! `target/gauss`.

mod picture;
mod scene;
#[cfg(test)]
mod tests;

use gauss_contact::{ContactError, ContactRun, ContactTrajectory, EventKind};
use gauss_examples::plots::{write, write_page};
use gauss_runtime::prelude::*;

use scene::{Pendulum, PendulumKernel, PendulumState};

/// Length of the run, s.
const DURATION: f64 = 12.0;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let pendulum = Pendulum::desk();
    let kernel = pendulum.kernel()?;
    println!("A rod with dry friction at its pivot, a spiral spring and a buffer at −0.5 rad, let go at 1.6 rad:\n");
    let control = Adaptive::new(1e-10, 1e-12).largest_step(0.01);
    let run = ContactRun::new(&kernel).control(control).tolerance(1e-10, 1e-12);
    let start = PendulumState { theta: 1.6, ..PendulumState::default() };
    let run = run.run(start.q(), start.z(), 0.0..DURATION)?;

    println!("what each element delivered in {DURATION} s, mJ:");
    let (friction, others) = (friction(&run, pendulum.dry), works(&kernel, &run)?);
    println!("  {:<40} {:+9.3}", "dry friction", 1e3 * friction);
    for (element, work) in PendulumKernel::ELEMENTS.iter().zip(&others) {
        println!("  {:<40} {:+9.3}", element.to_string(), 1e3 * work);
    }
    let (first, last) = (run.at(0.0)?, run.at(DURATION)?);
    let kinetic = |s: &Sample<PendulumKernel>| kernel.kinetic_energy(s.t, &s.q, &s.z);
    println!(
        "  kinetic energy less all work: {:+.1e} J",
        kinetic(&last) - kinetic(&first) - friction - others.iter().sum::<f64>()
    );
    let stops = run.events().iter().find(|event| event.kind == EventKind::Sticks).ok_or("it swings on")?;
    println!(
        "  it rests at {:.4} rad from {:.4} s on: friction holds it with {:+.4} N m of ±{:.4} N m, at {} rad/s",
        last.q[0],
        stops.time,
        run.forces(DURATION)?[0],
        pendulum.dry,
        last.z[0]
    );
    write("friction_pendulum", &picture::draw(&pendulum, &kernel, &run)?)?;
    write_page("friction_pendulum", &picture::page(&kernel, &run, pendulum.limit)?)
}

/// Friction times way, J: in no part of the run does the rod turn round.
fn friction(run: &ContactTrajectory<'_, PendulumKernel>, dry: f64) -> f64 {
    let ways = run.segments().iter().map(|part| part.trajectory().last().q - part.trajectory().first().q);
    -dry * ways.map(|way| way[0].abs()).sum::<f64>()
}

/// ∫ power dt of each element, J: Simpson's rule from sample to sample.
fn works(kernel: &PendulumKernel, run: &ContactTrajectory<'_, PendulumKernel>) -> Result<Vec<f64>, ContactError> {
    let powers = |s: &Sample<PendulumKernel>| kernel.powers(s.t, &s.q, &s.z, &());
    let samples: Vec<Sample<PendulumKernel>> = run.iter().collect();
    let mut sum = powers(&samples[0]) * 0.0;
    for pair in samples.windows(2).filter(|pair| pair[0].t < pair[1].t) {
        let [a, b] = [&pair[0], &pair[1]];
        let middle = run.at(0.5 * (a.t + b.t))?;
        sum += (powers(a) + powers(&middle) * 4.0 + powers(b)) * ((b.t - a.t) / 6.0);
    }
    Ok(sum.iter().copied().collect())
}
