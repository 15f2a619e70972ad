//! A pendulum with dry friction, a spiral spring and a buffer: which element takes which part of the energy; and dry
//! friction itself, as a force that jumps and made smooth, against its exact solution.
//!
//! `cargo run --release --example friction_pendulum [-- FOLDER]` draws the picture into `FOLDER`, by default
//! `target/gauss`.

mod picture;
mod scene;
mod slide;

use gauss_examples::plots::{write, write_page};
use gauss_runtime::monitor::power_balance;
use gauss_runtime::prelude::*;

use scene::{Pendulum, PendulumKernel, PendulumState, Slider};
use slide::{Sliding, slide};

/// Length of the run of the pendulum, s.
const DURATION: f64 = 12.0;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let pendulum = Pendulum::desk();
    let kernel = pendulum.kernel()?;
    println!("A rod with dry friction at its pivot, a spiral spring and a buffer at −0.5 rad, let go at 1.6 rad:\n");
    let run = Simulation::new(&kernel).adaptive(1e-10, 1e-12).largest_step(0.01);
    let start = PendulumState { theta: 1.6, ..PendulumState::default() };
    let path = run.run(start.q(), start.z(), 0.0..DURATION)?;

    println!("what each element delivered in {DURATION} s, mJ:");
    for (element, work) in PendulumKernel::ELEMENTS.iter().zip(works(&kernel, &path)) {
        println!("  {:<40} {:+9.3}", element.to_string(), 1e3 * work);
    }
    let balance = power_balance(&kernel, &path, |_, _, _| ());
    println!("  balance, J: {balance}");
    let (end, pull) = (path.last(), pull(&kernel, path.last()));
    println!(
        "  it rests at {:.4} rad: gravity and springs pull with {pull:+.4} N m, friction holds up to ±{:.4} N m\n  and creeps at {:+.1e} rad/s\n",
        end.q[0], pendulum.dry, end.z[0]
    );

    let slider = Slider::desk();
    println!(
        "Dry friction by itself: a mass on a spring, exact solution known, ten half swings, {:.3} s",
        slider.rests()
    );
    println!("  friction                      tolerance    steps    largest error, mm");
    for tolerance in [1e-6, 1e-8, 1e-10] {
        let (steps, error) = against_exact(&slider.kernel()?, &slider, tolerance)?;
        println!("  f·signum(v), a jump             {tolerance:.0e}   {steps:6}    {:.2e}", 1e3 * error);
    }
    for creep in [1e-2, 1e-3, 1e-4] {
        let (steps, error) = against_exact(&slider.smooth(creep).kernel()?, &slider, 1e-10)?;
        println!("  f·v/√(v² + ε²), ε = {creep:.0e} m/s   1e-10   {steps:6}    {:.2e}", 1e3 * error);
    }
    let (jumping, smooth) = (slider.kernel()?, slider.smooth(1e-4).kernel()?);
    let (reached, steps) = at_rest(&jumping, &slider);
    println!("\nOne second more, at rest, tolerance 1e-8, at most 10 000 attempted steps:");
    println!("  with the jump, steps shrink to nothing: {steps} of them cover {:.1e} s", reached - slider.rests());
    let (reached, steps) = at_rest(&smooth, &slider);
    println!("  with ε = 1e-4 m/s {steps} steps cover {:.3} s", reached - slider.rests());

    let svg = picture::draw(&pendulum, &kernel, &path, &slider)?;
    write("friction_pendulum", &svg)?;
    write_page("friction_pendulum", &picture::page(&kernel, &path, pendulum.limit)?)
}

/// ∫ power dt of each element, J: Simpson's rule from sample to sample.
fn works(kernel: &PendulumKernel, path: &Trajectory<PendulumKernel>) -> Vec<f64> {
    let powers = |s: &Sample<PendulumKernel>| kernel.powers(s.t, &s.q, &s.z, &());
    let mut sum = powers(path.first()) * 0.0;
    for (a, b) in path.iter().zip(path.iter().skip(1)) {
        let middle = path.at(0.5 * (a.t + b.t)).expect("inside the run");
        sum += (powers(a) + powers(&middle) * 4.0 + powers(b)) * ((b.t - a.t) / 6.0);
    }
    sum.iter().copied().collect()
}

/// The torque of all that has a potential, N m.
fn pull(kernel: &PendulumKernel, s: &Sample<PendulumKernel>) -> f64 {
    let forces = kernel.element_forces(s.t, &s.q, &s.z, &());
    PendulumKernel::ELEMENTS.iter().zip(forces.iter()).filter(|(e, _)| e.conservative).map(|(_, force)| force).sum()
}

/// Its steps, and its largest distance from the exact solution, m.
fn against_exact<K: Sliding>(kernel: &K, slider: &Slider, tolerance: f64) -> Result<(usize, f64), IntegrationError> {
    let path = slide(kernel, slider, tolerance)?;
    let error = path.iter().map(|s| (s.q[0] - slider.exact(s.t)).abs()).fold(0.0, f64::max);
    Ok((path.len() - 1, error))
}

/// A second at rest from the exact place on, within 10 000 steps: how far it comes, s, and the steps.
fn at_rest<K: Sliding>(kernel: &K, slider: &Slider) -> (f64, usize) {
    let rests = slider.rests();
    let run = Simulation::new(kernel).adaptive(1e-8, 1e-8).max_steps(10_000);
    let (path, _) = run.attempt(SVector::from([slider.exact(rests)]), SVector::from([0.0]), rests..rests + 1.0);
    (path.last().t, path.len() - 1)
}
