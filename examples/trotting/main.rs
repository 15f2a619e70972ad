//! ANYmal trots, in steps of a millisecond; the torques that it gave are recorded and played back: the same steps give
//! the same bits. A start that is moved by a little shows how long torques alone keep it on its feet.
//!
//! `cargo run --release --example trotting [-- FOLDER]` writes the torques as a table and the motion as a page into
//! `FOLDER`, by default `target/gauss`.

mod page;
mod robot;
#[cfg(test)]
mod tests;

use std::error::Error;
use std::fmt::Write;

use gauss_contact::ContactStepper;
use gauss_examples::plots::write_page;
use gauss_runtime::prelude::*;

use robot::{Anymal, AnymalKernel, STEP, STRIDE, Torques, run, start, trot};

/// m/s, and s.
const WANTED: f64 = 0.3;
const LENGTH: f64 = 6.0;

fn main() -> Result<(), Box<dyn Error>> {
    let kernel = Anymal { mu: 0.8 }.kernel()?;
    let steps = (LENGTH / STEP).round() as usize;
    let mut torques: Vec<Torques> = Vec::with_capacity(steps);
    let (mut residual, mut lowest, mut deepest) = (0.0_f64, 0.0_f64, 0.0_f64);
    let mut last = start(&kernel);
    let mut places = Vec::new();
    let controller = |n: usize, q: &robot::Place, z: &robot::Speeds| {
        let torque = trot(n as f64 * STEP, q, z, WANTED);
        torques.push(torque);
        torque
    };
    run(&kernel, start(&kernel), steps, controller, |stepper| {
        let laws = stepper.report().residual;
        residual = residual.max(laws.signorini).max(laws.coulomb).max(laws.dissipation);
        lowest = lowest.min(kernel.gaps(0.0, stepper.configuration()).min());
        deepest = deepest.max(stepper.report().penetration);
        last = (*stepper.configuration(), *stepper.speeds());
        places.push(last.0.0.translation.x);
    })?;
    let stride = (STRIDE / STEP).round() as usize;
    let speed = |n: usize| (places[n] - places[n - stride]) / STRIDE;
    println!("{steps} steps of {STEP} s; strides of {STRIDE} s go on at");
    for n in (stride..steps).step_by(2 * stride) {
        print!("  {:.3}", speed(n));
    }
    println!("  m/s; {:.2} m in all", places[steps - 1]);
    println!(
        "residuals of the laws up to {residual:.0e} m/s; gaps down to {lowest:.0e} m at the ends of steps, before"
    );
    println!("they were closed to {:.0e} m", -deepest);

    let mut again = start(&kernel);
    let keep = |stepper: &ContactStepper<'_, AnymalKernel>| again = (*stepper.configuration(), *stepper.speeds());
    run(&kernel, start(&kernel), steps, |n, _, _| torques[n], keep)?;
    println!("\nThe torques again, without the controller: the same bits after {LENGTH} s: {}", again == last);
    moved_starts(&kernel, &torques, &places)?;

    let table = table(&torques)?;
    let folder = gauss_files::output_folder_or_argument();
    gauss_files::write(folder.join("trotting.csv"), &table)?;
    println!("written: {}", folder.join("trotting.csv").display());
    write_page("trotting", &page::page(&kernel, &torques)?)
}

/// The columns of the table, N m.
fn kernel_joints() -> Vec<String> {
    let legs = ["LF", "LH", "RF", "RH"];
    legs.iter().flat_map(|leg| ["HAA", "HFE", "KFE"].map(|joint| format!("{leg}_{joint}"))).collect()
}

/// How far torques alone keep it where it was, `places`, forward, m, from starts that are turned a little.
fn moved_starts(kernel: &AnymalKernel, torques: &[Torques], places: &[f64]) -> Result<(), Box<dyn Error>> {
    for moved in [1e-6, 1e-4, 1e-2] {
        let (mut q, z) = start(kernel);
        q.0.rotation *= UnitQuaternion::from_scaled_axis(Vector3::new(moved, 0.0, 0.0));
        q.0.translation.z -= kernel.gaps(0.0, &q).min();
        let (mut n, mut off) = (0, None);
        let ended = run(
            kernel,
            (q, z),
            torques.len(),
            |n, _, _| torques[n],
            |stepper| {
                n += 1;
                let apart = (stepper.configuration().0.translation.x - places[n - 1]).abs();
                off = off.or((apart > 0.05).then_some(n as f64 * STEP));
            },
        );
        // Nothing but its feet touches the ground: what comes after a fall says nothing.
        if off.is_none() {
            ended?;
        }
        match off {
            Some(t) => println!("turned by {moved:.0e} rad at the start: 5 cm away after {t:.2} s"),
            None => println!("turned by {moved:.0e} rad at the start: within 5 cm for {LENGTH} s"),
        }
    }
    Ok(())
}

/// The torques, N m, a row for each step.
fn table(torques: &[Torques]) -> Result<String, std::fmt::Error> {
    let mut table = String::from("t");
    kernel_joints().iter().for_each(|name| table += &format!(",{name}"));
    for (n, torque) in torques.iter().enumerate() {
        write!(table, "\n{}", n as f64 * STEP)?;
        torque.iter().try_for_each(|value| write!(table, ",{value}"))?;
    }
    Ok(table)
}
