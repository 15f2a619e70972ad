//! A million touchdowns of a lander as a study on any number of machines: a map of two parameters that is drawn while
//! it fills, and which parameter matters.
//!
//! `cargo run --release --example study` makes a thousand of them in `target/gauss` and draws the map; `RUNS=20` before
//! it: fewer. With words it is the command of the study, of a million runs:
//!
//! ```text
//! study run [--shard k/N] [--threads T] --out DIR
//! study status DIR | merge DIR | show RUN
//! study map DIR                    draws what there is, until all is there
//! study sensitivity run --out DIR  the study of Sobol' indices, and so on
//! ```

mod map;
mod sensitivity;
// The picture of `lander_legs` takes more of it.
#[allow(dead_code, reason = "a module of two examples")]
#[path = "../lander_legs/lander.rs"]
mod lander;

use std::error::Error;
use std::f64::consts::TAU;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Mutex;
use std::thread;
use std::time::{Duration, Instant};

use gauss_examples::runs;
use gauss_study::{Declaration, Study, grid, uniform};

use lander::{Along, OUTCOMES, Parameters};
use map::{SLOPES, SPEEDS};

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let words: Vec<_> = std::env::args_os().skip(1).collect();
    match words.first().and_then(|word| word.to_str()) {
        None => first_look(runs(1000) as u64),
        Some("map") => {
            let folder = PathBuf::from(words.get(1).ok_or("`map` needs a folder")?);
            let study = touchdowns(1_000_000)?;
            while map::draw(&study, &folder)? < 1_000_000 {
                thread::sleep(Duration::from_secs(2));
            }
            Ok(ExitCode::SUCCESS)
        }
        Some("sensitivity") => Ok(gauss_study::main_from(&sensitivity::study(4096)?, words.into_iter().skip(1))),
        Some(_) => Ok(gauss_study::main(&touchdowns(1_000_000)?)),
    }
}

/// Touchdowns at all speeds and slopes in turn; what else there is is random.
fn touchdowns<'a>(runs: u64) -> Result<Study<'a>, Box<dyn Error>> {
    let mut study = Declaration::new("touchdowns", 1, runs).version("lander_legs 1");
    let speed = study.parameter("speed", "m/s", grid(0.0, 3.0, SPEEDS));
    let slope = study.parameter("slope", "rad", grid(0.0, 15.0_f64.to_radians(), SLOPES));
    let direction = study.parameter("direction", "rad", uniform(0.0, TAU));
    let parameters = Parameters::declare(&mut study, slope, Along::Polar { speed, direction });
    let outcome = study.text("outcome");
    let (crushed, slid) = (study.number("crushed", "m"), study.number("slid", "m"));
    let rests = study.flag("rests");
    Ok(study.study(move |sample, row| {
        let landing = parameters.approach(sample).touch_down()?;
        let name = OUTCOMES.iter().find(|(outcome, _)| *outcome == landing.outcome).map_or("", |(_, name)| name);
        row.set(outcome, name);
        row.set(crushed, landing.crushed);
        row.set(slid, landing.slid);
        row.set(rests, landing.rests);
        Ok::<_, Box<dyn Error>>(())
    })?)
}

/// A small study, its map while it fills, and which parameter matters.
fn first_look(runs: u64) -> Result<ExitCode, Box<dyn Error>> {
    let folder = gauss_files::output_folder().join(format!("study_{runs}"));
    let study = touchdowns(runs)?;
    let (clock, drawn) = (Instant::now(), Mutex::new(None::<Instant>));
    let end = study.run(&folder, |_| {
        // A thread that is late need not draw.
        let Ok(mut drawn) = drawn.try_lock() else { return };
        if drawn.is_none_or(|drawn| drawn.elapsed() > Duration::from_secs(2)) {
            if let Err(error) = map::draw(&study, &folder) {
                eprintln!("no map: {error}");
            }
            *drawn = Some(Instant::now());
        }
    })?;
    println!("{} runs in {:.1} s, {} failed", end.runs, clock.elapsed().as_secs_f64(), end.failed);
    println!("written: {}", study.merge(&folder)?.display());
    let outcomes = study.results(&folder)?.words("outcome")?;
    for (_, name) in OUTCOMES {
        let count = outcomes.iter().flatten().filter(|outcome| *outcome == name).count();
        println!("  {name:<10} {:.4}", count as f64 / end.runs as f64);
    }
    map::draw(&study, &folder)?;
    sensitivity::print(&gauss_files::output_folder().join(format!("sensitivity_{runs}")), runs)?;
    Ok(ExitCode::SUCCESS)
}
