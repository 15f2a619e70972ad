//! A vehicle driven by inputs from a log: `examples/data/recorded_inputs.csv`, made up to look like one, or a file of
//! yours.
//!
//! `cargo run --release --example recorded_inputs [-- FOLDER [FILE.csv]]` draws into `FOLDER`, by default
//! `target/gauss`.

use std::env;
use std::error::Error;
use std::fs::File;
use std::path::PathBuf;

use gauss_charts::drawing::COLOURS;
use gauss_charts::figure::torpedo;
use gauss_examples::plots::{self, Line, Plot, mosaic};
use gauss_playback::Playback;
use gauss_runtime::monitor::power_balance;
use gauss_runtime::prelude::*;

mod craft;
mod recording;
#[cfg(test)]
mod tests;

use craft::{Craft, CraftKernel, apart, replay, replay_by_hand};
use recording::{Recording, Row};

/// Where this package has its data.
const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/data/recorded_inputs.csv");

fn main() -> Result<(), Box<dyn Error>> {
    let folder = gauss_files::output_folder_or_argument();
    let file = env::args_os().nth(2).map_or_else(|| PathBuf::from(FILE), PathBuf::from);
    let recording = Recording::read(File::open(&file)?).map_err(|error| format!("{}, {error}", file.display()))?;
    let rows = recording.rows();
    let (from, to) = (rows[0].time, rows[rows.len() - 1].time);
    println!(
        "RECORDED INPUTS\n\n{} rows of thrust and rudder, {from} s to {to} s; the REMUS 100 in the plane.",
        rows.len()
    );

    let kernel = Craft::published().kernel()?;
    let samples = replay(&kernel, &recording)?;
    println!("One evaluation: {}\n", CraftKernel::OPERATIONS.acceleration);
    println!("     t/s  thrust/N  rudder/°   north/m    east/m     u/m/s     v/m/s     r/°/s");
    for (sample, row) in samples.iter().zip(rows).step_by(20) {
        let (place, [u, v, r]) = (sample.q.translation.vector, <[f64; 3]>::from(sample.z));
        println!(
            "{:8.1}{:10.3}{:10.2}{:10.3}{:10.3}{u:10.4}{v:10.4}{:10.3}",
            sample.t,
            row.thrust,
            row.rudder.to_degrees(),
            place.x,
            place.y,
            r.to_degrees()
        );
    }

    let [fine, coarse] = [40, 20].map(|steps| replay_by_hand(&recording, steps));
    println!("\nequations by hand, 40 Runge–Kutta steps between two rows: {:.1e} m apart", apart(&samples, &fine));
    println!("                   20 steps:                               {:.1e} m", apart(&samples, &coarse));
    // As long as only a constant thrust acts, from rest: u = √(X/|Xuu|) tanh(t √(X |Xuu|)/(m − Xu̇)).
    let craft = Craft::published();
    let same = |row: &&Row| row.thrust == rows[0].thrust && row.rudder == 0.0;
    let steady = rows.iter().take_while(same).count();
    let surge = craft.mass + craft.added[(0, 0)];
    let closed = |t: f64| {
        let (thrust, drag) = (rows[0].thrust, -craft.xuu);
        (thrust / drag).sqrt() * ((t - from) * (thrust * drag).sqrt() / surge).tanh()
    };
    let off = samples[..steady].iter().map(|s| (s.z[0] - closed(s.t)).abs()).fold(0.0, f64::max);
    println!("closed form of the first {} s, constant thrust from rest:  {off:.1e} m/s", rows[steady - 1].time - from);

    // Without a stop at every row the steps find the kinks by rejected steps.
    let whole = Simulation::new(&kernel).input_from(&recording).adaptive(1e-11, 1e-12);
    let path = whole.run(samples[0].q, samples[0].z, from..to)?;
    let end = samples[samples.len() - 1].q.translation.vector;
    let missed = (path.last().q.translation.vector - end).norm();
    println!("in one go over all kinks: {} steps, ends {missed:.1e} m elsewhere", path.len() - 1);
    println!("joules: {}", power_balance(&kernel, &path, |t, _, _| SVector::from(recording.at(t))));

    let svg = draw(&samples, rows)?;
    plots::write_into(&folder, "recorded_inputs", &svg)?;
    plots::write_page_into(&folder, "recorded_inputs", &page(&kernel, &recording, samples))
}

/// The vehicle, with what thrust, hull and fins push with.
fn page(kernel: &CraftKernel, recording: &Recording, samples: Vec<Sample<CraftKernel>>) -> Playback<CraftKernel> {
    let pose = |s: &Sample<CraftKernel>| kernel.pose(s.t, &s.q);
    let mut page = Playback::of_samples("A vehicle driven by recorded inputs", samples)
        .si()
        .up([0.0, 0.0, -1.0])
        .from_above()
        .body("REMUS 100", pose, torpedo())
        .follow("REMUS 100")
        .trace("REMUS 100", [0.0; 3]);
    // The speeds are (u, v, r): what acts on them are a force in body axes and a torque. Fins push 0.63 m behind O.
    for (k, element) in CraftKernel::ELEMENTS.iter().enumerate() {
        let at = if element.name == "fins" { Vector3::new(-0.63, 0.0, 0.0) } else { Vector3::zeros() };
        page = page.arrow(element.name, 0.15, |s| {
            let forces = kernel.element_forces(s.t, &s.q, &s.z, &SVector::from(recording.at(s.t)));
            let pose = pose(s);
            (
                pose.translation.vector + pose.rotation * at,
                pose.rotation * Vector3::new(forces[(0, k)], forces[(1, k)], 0.0),
            )
        });
    }
    page.curve("thrust / N", "recorded", |s| recording.at(s.t)[0])
        .curve("angle / °", "rudder", |s| recording.at(s.t)[1].to_degrees())
        .curve("angle / °", "drift", |s| (-s.z[1]).atan2(s.z[0]).to_degrees())
        .curve("speed / (m/s)", "ahead", |s| s.z[0])
        .energy(kernel)
}

/// What was recorded above, the way below.
fn draw(samples: &[Sample<CraftKernel>], rows: &[Row]) -> Result<String, Box<dyn Error>> {
    let [blue, orange, green, _] = COLOURS;
    let end = rows[rows.len() - 1].time;
    let recorded = |title, colour, y, value: fn(&Row) -> f64| {
        let line = Line::new("", colour, rows.iter().map(|row| (row.time, value(row))));
        Plot::new(title, ("time, s", 0.0..end), y, vec![line])
    };
    let thrust = recorded("Recorded thrust", orange, ("thrust, N", 0.0..6.0), |row| row.thrust);
    let rudder = recorded("Recorded rudder", green, ("rudder, °", -12.0..12.0), |row| row.rudder.to_degrees());
    let points: Vec<_> = samples.iter().map(|s| (s.q.translation.vector.y, s.q.translation.vector.x)).collect();
    let (first, last) = (points[0], points[points.len() - 1]);
    let marks = vec![(first.0, first.1, "start".into()), (last.0, last.1, "end".into())];
    let (x, y) = (("east, m", -56.0..4.0), ("north, m", -2.0..30.0));
    let way = Plot::new("The way of the vehicle", x, y, vec![Line::new("", blue, points)]).to_scale().marked(marks);
    let plots = [([0, 0, 850, 420], thrust), ([850, 0, 850, 420], rudder), ([0, 420, 1700, 700], way)];
    mosaic("A vehicle driven by recorded inputs", (1700, 1210), &plots)
}
