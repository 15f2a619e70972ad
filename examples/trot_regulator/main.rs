//! A quadruped from its file that trots, held on its gait by a regulator that is made from the derivatives of its
//! steps.
//!
//! `cargo run --release --example trot_regulator [-- FOLDER]` draws the picture and the page that plays into `FOLDER`,
//! by default `target/gauss`. ANYmal trots on the spot by springs and dampers at its joints; states and torques of that
//! run are the gait. Along it each step of two milliseconds, with its touchdowns and lift-offs, is linearised, and the
//! equation of Riccati gives a gain for each. Then the trunk is pushed sideways: the torques of the gait alone let the
//! robot fall after any push, its springs bring it to stand elsewhere, gains bring it back.

mod gait;
mod page;
mod picture;
mod robot;
#[cfg(test)]
mod tests;

use std::error::Error;
use std::time::{Duration, Instant};

use gauss_examples::plots::{write, write_page};
use gauss_runtime::prelude::Vector3;

use gait::{BACK, Gains, Gait, LEAST, Ways, largest, pushed};
use robot::Robot;

/// Pushes of the table, m/s, and that of the picture.
const PUSHES: [f64; 9] = [0.0, 1e-3, 1e-2, 0.1, 0.2, 0.4, 0.6, 0.8, 1.0];
const SHOWN: f64 = 0.6;

fn main() -> Result<(), Box<dyn Error>> {
    let robot = Robot::new()?;
    // Two seconds, or half of them for a first look.
    let steps = if gauss_examples::runs(100) < 100 { 500 } else { 1000 };
    let each = |time: Duration| 1e6 * time.as_secs_f64() / steps as f64;
    let clock = Instant::now();
    let gait = Gait::record(&robot, steps)?;
    let plain = each(clock.elapsed());
    println!("ANYmal trots on the spot for {:.1} s in {steps} steps; feet land {} times;", gait.end(), gait.landings);
    println!("residuals of the laws up to {:.0e} m/s\n", gait.residual);
    let clock = Instant::now();
    let linear = gait.linearized(&robot)?;
    println!("a step takes {plain:.0} µs, with derivatives by 48 numbers {:.0} µs;", each(clock.elapsed()));
    println!("{} steps are at a change of a mode, {} have no derivative\n", linear.at_change, linear.none);
    let gains = Gains::of(&linear.steps);

    let ways = [Ways::Replayed, Ways::Springs, Ways::Regulated(&gains)];
    let aside = Vector3::y();
    println!("pushed sideways, m/s    torques alone        springs              gains");
    let mut rows = Vec::new();
    for push in PUSHES {
        print!("{push:>20}");
        let ends = ways.map(|way| pushed(&robot, &gait, &(aside * push), way));
        for end in &ends {
            match end.fell {
                Some(time) => print!("    falls at {time:.2} s "),
                None => print!("    off by {:.1e} m", end.off),
            }
        }
        println!();
        rows.push((push, ends.map(|end| end.off)));
    }
    let best = ways.map(|way| [aside, Vector3::x()].map(|direction| largest(&robot, &gait, &direction, way)));
    println!(
        "\nThe largest push after which the trunk is within {BACK} m of the gait at its end, m/s, in steps of {LEAST}:"
    );
    for (name, [aside, ahead]) in ["torques alone", "springs", "gains"].into_iter().zip(best) {
        println!("{name:>20}    sideways {aside:.2}, forward {ahead:.2}");
    }
    let shown = ways.map(|way| pushed(&robot, &gait, &(aside * SHOWN), way));
    write("trot_regulator", &picture::draw(&gait, SHOWN, &shown, &rows)?)?;
    write_page("trot_regulator", &page::page(&robot.plain, &shown[2], SHOWN)?)?;

    let holds = rows.iter().filter(|(push, _)| *push <= SHOWN).all(|(_, off)| off[2] < BACK);
    let falls = rows.iter().filter(|(push, _)| *push >= 0.2).all(|(_, off)| off[0] > BACK);
    if !(holds && falls && rows[0].1[0] < BACK) {
        return Err("the regulator does not hold the gait where torques alone do not".into());
    }
    Ok(())
}
