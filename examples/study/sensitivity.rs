//! Which parameter of a touchdown matters: Sobol' indices of how far the struts are crushed.

use std::error::Error;
use std::f64::consts::TAU;
use std::path::Path;

use gauss_study::sensitivity::sobol_indices;
use gauss_study::{Declaration, Plan, Study, uniform};

use crate::lander::{Along, Parameters};

/// In the order of their declaration.
const NAMES: [&str; 11] =
    ["speed", "slope", "direction", "mu", "heading", "tilt_x", "tilt_y", "fall", "spin_x", "spin_y", "spin_z"];

/// So many points, with 13 runs each.
///
/// # Errors
/// None that this declaration has.
pub fn study<'a>(points: u64) -> Result<Study<'a>, Box<dyn Error>> {
    let group = NAMES.len() as u64 + 2;
    let study = Declaration::new("sensitivity", 1, group * points).plan(Plan::Saltelli).version("lander_legs 1");
    // Whole groups in every part.
    let mut study = study.runs_per_part(group * 64);
    let speed = study.parameter("speed", "m/s", uniform(0.0, 3.0));
    let slope = study.parameter("slope", "rad", uniform(0.0, 15.0_f64.to_radians()));
    let direction = study.parameter("direction", "rad", uniform(0.0, TAU));
    let parameters = Parameters::declare(&mut study, slope, Along::Polar { speed, direction });
    let crushed = study.number("crushed", "m");
    Ok(study.study(move |sample, row| {
        row.set(crushed, parameters.approach(sample).touch_down()?.crushed);
        Ok::<_, Box<dyn Error>>(())
    })?)
}

/// Makes some runs, and prints the indices.
///
/// # Errors
/// Where a file cannot be written or read.
pub fn print(folder: &Path, runs: u64) -> Result<(), Box<dyn Error>> {
    let points = (runs / (NAMES.len() as u64 + 2)).max(2);
    let study = study(points)?;
    study.run(folder, |_| ())?;
    study.merge(folder)?;
    let values = study.results(folder)?.numbers("crushed")?;
    let indices = sobol_indices(&values, NAMES.len()).ok_or("the struts are crushed alike in all runs")?;
    println!("\nHow far the struts are crushed, by {points} points: shares of the variance, and standard errors");
    println!("  parameter    first order        total");
    for (name, index) in NAMES.iter().zip(indices) {
        let [first, total] = index.errors;
        println!("  {name:<10} {:7.3} ± {first:.3}  {:7.3} ± {total:.3}", index.first, index.total);
    }
    Ok(())
}
