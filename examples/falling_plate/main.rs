//! A plate falls in a fluid: it flutters or tumbles, depending on its weight; in an ideal fluid it does neither.
//!
//! `cargo run --release --example falling_plate [-- FOLDER]` draws the picture into `FOLDER`, by default
//! `target/gauss`.

mod picture;
mod reference;
mod scene;
#[cfg(test)]
mod tests;

use std::f64::consts::PI;

use gauss_examples::plots::{write, write_page};
use gauss_runtime::monitor::power_balance;
use gauss_runtime::prelude::*;

use scene::{FLUTTERING, IdealPlate, IdealPlateKernel, Plate, PlateKernel, THICKNESS, TUMBLING, places, released};

/// Length of the runs, in units of a/U.
const DURATION: f64 = 60.0;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("An elliptic cylinder, 1 : 14, falls in a fluid. Lengths in half-widths a, speeds in U, time in a/U.\n");
    println!("{}\n", IdealPlateKernel::EQUATIONS);
    println!("acceleration in an ideal fluid: {}", IdealPlateKernel::OPERATIONS.acceleration);
    println!("with lift, drag and braking:    {}\n", PlateKernel::OPERATIONS.acceleration);

    let (fluttering, tumbling) = (Plate::new(FLUTTERING).kernel()?, Plate::new(TUMBLING).kernel()?);
    let (flutter, tumble) = (fall(&fluttering)?, fall(&tumbling)?);
    for (words, ratio, path) in [("flutters", FLUTTERING, &flutter), ("tumbles", TUMBLING, &tumble)] {
        report(words, ratio, path)?;
    }

    let ideal = IdealPlate::new(FLUTTERING);
    let kernel = ideal.kernel()?;
    let (pose, _) = released();
    let run = Simulation::new(&kernel).adaptive(1e-11, 1e-11).largest_step(0.02);
    let sinking = run.run(pose, Vector3::zeros(), 0.0..8.0)?;
    in_an_ideal_fluid(&ideal, &kernel, &sinking);

    let svg = picture::draw(&sinking, &flutter, &tumble)?;
    write("falling_plate", &svg)?;
    write_page("falling_plate", &picture::page(&tumbling, &tumble)?)
}

fn fall(kernel: &PlateKernel) -> Result<Trajectory<'_, PlateKernel>, IntegrationError> {
    let (pose, twist) = released();
    Simulation::new(kernel).adaptive(1e-11, 1e-11).largest_step(0.02).run(pose, twist, 0.0..DURATION)
}

/// How it falls, what does it, and how far that is from equations typed by hand.
fn report(words: &str, ratio: f64, path: &Trajectory<PlateKernel>) -> Result<(), Box<dyn std::error::Error>> {
    let kernel = Plate::new(ratio).kernel()?;
    let places = places(path);
    let late: Vec<_> = places.iter().filter(|(t, _)| *t > 0.5 * DURATION).collect();
    let (first, last) = (late[0].1, late[late.len() - 1].1);
    let widest = late.iter().map(|(_, [.., angle])| angle.abs()).fold(0.0, f64::max);
    let rate = |i: usize| (last[i] - first[i]) / (0.5 * DURATION);
    println!("I* = {ratio}: it {words}. In the second half it sinks at {:.3} and drifts at {:+.3};", -rate(1), rate(0));
    println!("  largest |angle| {:.1}°, {:+.1} turns", widest.to_degrees(), (last[2] - first[2]) / (2.0 * PI));

    let powers = |s: &Sample<PlateKernel>| kernel.powers(s.t, &s.q, &s.z, &());
    let mut works = powers(path.first()) * 0.0;
    for (a, b) in path.iter().zip(path.iter().skip(1)) {
        let middle = path.at(0.5 * (a.t + b.t)).expect("inside the run");
        works += (powers(a) + powers(&middle) * 4.0 + powers(b)) * ((b.t - a.t) / 6.0);
    }
    println!("  work of each element, in ρ a² U²:");
    for (element, work) in PlateKernel::ELEMENTS.iter().zip(works.iter()) {
        println!("    {:<40} {work:+10.4}", element.to_string());
    }
    println!("    balance: {}", power_balance(&kernel, path, |_, _, _| ()));

    // At this step its own error is far below what is printed: steps four times as long change its place by 1e-9.
    let (pose, twist) = released();
    let start = [0.0, 0.0, pose.rotation.angle(), twist.x, twist.y, twist.z];
    let typed = |_: f64, y| reference::falling_card(ratio, THICKNESS, y);
    let states = reference::runge_kutta(typed, start, 1.0 / 2000.0, 40_000);
    let largest = states.iter().enumerate().step_by(1000).map(|(n, y)| {
        let s = path.at(n as f64 / 2000.0).expect("inside the run");
        f64::hypot(s.q.translation.x - y[0], s.q.translation.y - y[1])
    });
    println!(
        "  from the equations of the paper, typed by hand: {:.1e} apart until t = 20\n",
        largest.fold(0.0, f64::max)
    );
    Ok(())
}

/// Impulse and angle against what is known of them.
fn in_an_ideal_fluid(plate: &IdealPlate, kernel: &IdealPlateKernel, path: &Trajectory<IdealPlateKernel>) {
    let weight = (plate.mass - plate.displaced) * plate.g;
    let (mut sideways, mut down) = (0.0_f64, 0.0_f64);
    for s in path.iter() {
        let impulse = kernel.space_momentum(s.t, &s.q, &s.z);
        sideways = sideways.max(impulse[0].abs());
        down = down.max((impulse[1] + weight * s.t).abs());
    }
    let masses = [plate.mass + plate.added[0], plate.mass + plate.added[1], plate.inertia + plate.added[5]];
    let start = [path.first().q.rotation.angle(), 0.0];
    let states = reference::runge_kutta(|t, y| reference::chaplygin(masses, weight, t, y), start, 1.0 / 2000.0, 16_000);
    let angle = places(path).last().expect("a run has an end").1[2];
    println!("The same plate in an ideal fluid, from rest, until t = 8: the impulse is that of the weight,");
    println!("  sideways within {sideways:.1e}, down within {down:.1e} of {:.2}", 8.0 * weight);
    println!("  angle {angle:.9}; by Chaplygin's equation {:.9}\n", states[states.len() - 1][0]);
}
