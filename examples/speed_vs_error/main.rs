//! Speed against error: every method of Gauss on every chart, and what one would otherwise use, on scenes whose ends
//! are known.
//!
//! `cargo run --release --example speed_vs_error [-- [--quick] [--to FOLDER] [SCENE…]]` measures all scenes (three to
//! four minutes of an idle core; `--quick`: a rough look in a quarter of a minute) and writes a page, a picture and
//! tables into `FOLDER`, by default `target/gauss`.
//!
//! A method is one line in `measure/methods.rs`; a scene is one entry in `measure/catalogue.rs` with a struct for the
//! derive, its data and its equations by hand.

use std::env;
use std::error::Error;
use std::path::PathBuf;

use gauss_charts::drawing;
use gauss_comparisons::measure;
use indicatif::{ProgressBar, ProgressStyle};

mod report;

use measure::catalogue::scenes;
use measure::scene::Scene;
use measure::study::{Effort, Study, study};
use report::machine::Machine;
use report::{overview, page, tables};

/// What was asked for.
struct Order {
    quick: bool,
    folder: PathBuf,
    scenes: Vec<Scene>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let Order { quick, folder, scenes } = order()?;
    let effort = if quick { Effort::QUICK } else { Effort::FULL };
    let machine = Machine::here();
    println!("{}, {}, load {}\n", machine.processor, machine.compiler, machine.load);

    const PARTS: u64 = 1000;
    let bar = ProgressBar::new(PARTS * scenes.len() as u64);
    bar.set_style(ProgressStyle::with_template("{wide_bar} {percent:>3} %  {msg:<42} {eta:>5}")?);
    let mut studies: Vec<Study> = Vec::new();
    for (n, scene) in scenes.iter().enumerate() {
        bar.set_message(scene.about.title);
        let done = |part: f64| bar.set_position(n as u64 * PARTS + (part * PARTS as f64) as u64);
        studies.push(study(scene, &effort, &mut { done })?);
    }
    bar.finish_and_clear();

    println!("{}\n", tables::console(&studies));
    let picture = overview::overview(&studies, &machine);
    for (name, contents) in [
        ("speed_vs_error.html", page::page(&studies, &machine, quick).into_bytes()),
        ("speed_vs_error.csv", tables::csv(&studies)?),
        ("speed_vs_error.json", serde_json::to_vec(&tables::json(&studies, &machine))?),
        ("speed_vs_error.svg", picture.clone().into_bytes()),
        ("speed_vs_error.png", drawing::png(&picture)?),
    ] {
        let file = folder.join(name);
        gauss_files::write(&file, contents)?;
        println!("written: {}", file.display());
    }
    Ok(())
}

fn order() -> Result<Order, Box<dyn Error>> {
    let mut order = Order { quick: false, folder: gauss_files::output_folder(), scenes: Vec::new() };
    let all = scenes()?;
    let mut words = env::args().skip(1);
    while let Some(word) = words.next() {
        match word.as_str() {
            "--quick" => order.quick = true,
            "--to" => order.folder = words.next().ok_or("--to needs a folder")?.into(),
            name => {
                let known = || all.iter().map(|scene| scene.about.name).collect::<Vec<_>>().join(", ");
                let scene = all.iter().find(|scene| scene.about.name == name);
                order.scenes.push(scene.ok_or_else(|| format!("no scene {name}; there are {}", known()))?.clone());
            }
        }
    }
    if order.scenes.is_empty() {
        order.scenes = all;
    }
    Ok(order)
}
