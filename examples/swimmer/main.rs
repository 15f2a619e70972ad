//! A fish of three ellipses that swims through a perfect fluid by changing its shape, and where its impulse says it
//! must be.
//!
//! `cargo run --release --example swimmer [-- FOLDER]` draws into `FOLDER`, by default `target/gauss`.

use std::error::Error;
use std::f64::consts::{FRAC_PI_2, TAU};

use gauss_charts::drawing::{COLOURS, INK};
use gauss_examples::plots::{Line, Plot, sheet, write, write_page};
use gauss_playback::{Playback, Shape};
use gauss_runtime::prelude::*;

mod fish;
#[cfg(test)]
mod tests;

use fish::{Fish, FishKernel, LONG, SHORT, start};

/// rad: how far the hinges turn.
const AMPLITUDE: f64 = 1.0;
const STROKES: u32 = 3;

fn main() -> Result<(), Box<dyn Error>> {
    let fish = Fish::new(AMPLITUDE, FRAC_PI_2);
    let kernel = fish.kernel()?;
    println!("A FISH OF THREE ELLIPSES IN A PERFECT FLUID\n");
    println!("Its hinges turn by sin t and sin(t − π/2). Nothing acts on it, and water and fish begin at rest.");
    println!("One evaluation: {}.\n", FishKernel::OPERATIONS.acceleration);
    let path = swim(&fish, STROKES)?;
    let end = &path[path.len() - 1];
    let hand = fish.by_hand(end.t, 20_000);
    let apart = (end.q.translation.vector - hand.translation.vector).norm();
    println!("impulse zero    its rate as a function of shape, integrated by hand: {apart:.1e} lengths apart");
    let impulse = path.iter().map(|s| kernel.momentum(s.t, &s.q, &s.z).amax()).fold(0.0, f64::max);
    println!("                the impulse that the kernel keeps: {impulse:.1e}");
    let per_stroke = end.q.translation.vector.norm() / f64::from(STROKES);
    println!(
        "one stroke      {per_stroke:.4} semi-axes; ending where its shape began, it is elsewhere: a geometric phase"
    );

    // A phase knows no time: twice as fast it goes as far. Back and forth on one way through the shapes it goes
    // nowhere.
    let idle = Fish::new(AMPLITUDE, 0.0);
    let nowhere = swim(&idle, 1)?;
    let left = nowhere[nowhere.len() - 1].q.translation.vector.norm();
    println!("without a lag   the scallop: {left:.1e}");
    write("swimmer", &draw(&fish, &path)?)?;
    let mut page = Playback::of_samples("A fish in a perfect fluid", path).from_above();
    for (k, name) in ["head", "middle", "tail"].into_iter().enumerate() {
        let flat = |pose: Isometry2<f64>| {
            let [x, y]: [f64; 2] = pose.translation.vector.into();
            Isometry3::new(Vector3::new(x, y, 0.0), Vector3::z() * pose.rotation.angle())
        };
        let shape = Shape::elliptic_cylinder([LONG, SHORT], 0.3);
        page = page.body(name, |s| flat(fish.poses(s.t, &s.q)[k]), [shape]);
    }
    write_page("swimmer", &page.trace("middle", [0.0; 3]).energy(&kernel))
}

/// States that are kept of a stroke.
const STATES: u32 = 64;

fn swim(fish: &Fish, strokes: u32) -> Result<Vec<Sample<FishKernel>>, Box<dyn Error>> {
    let kernel = fish.kernel()?;
    let (q, z) = start(fish);
    let mut samples = vec![Sample { t: 0.0, q, z, p: kernel.momentum(0.0, &q, &z) }];
    for n in 0..STATES * strokes {
        let last = samples[samples.len() - 1];
        let part = TAU / f64::from(STATES);
        let interval = part * f64::from(n)..part * f64::from(n + 1);
        samples.push(Simulation::new(&kernel).adaptive(1e-12, 1e-13).run_to_end(last.q, last.z, interval)?.sample);
    }
    Ok(samples)
}

/// The outline of an ellipse.
fn outline(pose: &Isometry2<f64>) -> Vec<(f64, f64)> {
    let point = |k: u32| {
        let (sin, cos) = (TAU * f64::from(k) / 48.0).sin_cos();
        let p = pose.translation.vector + pose.rotation * Vector3::new(LONG * cos, SHORT * sin, 0.0).xy();
        (p.x, p.y)
    };
    (0..=48).map(point).collect()
}

fn draw(fish: &Fish, path: &[Sample<FishKernel>]) -> Result<String, Box<dyn Error>> {
    let [blue, orange, green] = [COLOURS[0], COLOURS[1], COLOURS[2]];
    // One stroke, a fish below the other.
    let shapes: Vec<Line> = (0..=4)
        .flat_map(|quarter| {
            let sample = &path[STATES as usize / 4 * quarter];
            let down = 2.6 * quarter as f64;
            fish.poses(sample.t, &sample.q).into_iter().enumerate().map(move |(part, pose)| {
                let colour = if part == 1 { blue } else { INK };
                Line::new("", colour, outline(&pose).into_iter().map(|(x, y)| (x, y - down)))
            })
        })
        .collect();
    let stroke = Plot::new(
        "one stroke, top to bottom in quarters",
        ("semi-axes", -4.0..4.0),
        ("semi-axes; each fish 2.6 below the last", -12.6..2.0),
        shapes,
    )
    .to_scale();
    let track: Vec<(f64, f64)> = path.iter().map(|s| (s.q.translation.vector.x, s.q.translation.vector.y)).collect();
    let range = |of: &dyn Fn(&(f64, f64)) -> f64| {
        let (low, high) = track.iter().map(of).fold((f64::MAX, f64::MIN), |(l, h), v| (l.min(v), h.max(v)));
        let air = 0.15 * (high - low).max(0.2);
        low - air..high + air
    };
    let way = Plot::new(
        "its middle over three strokes",
        ("x, semi-axes", range(&|p| p.0)),
        ("y, semi-axes", range(&|p| p.1)),
        vec![Line::new("kernel", blue, track.iter().copied())],
    )
    .to_scale()
    .marked(
        (0..=STROKES)
            .map(|n| {
                let (x, y) = track[(STATES * n) as usize];
                (x, y, format!("{n}"))
            })
            .collect(),
    );
    let lags: Vec<f64> = (0..=24).map(|k| TAU * f64::from(k) / 24.0 / 2.0).collect();
    let gain = |amplitude: f64| -> Vec<(f64, f64)> {
        let far = |lag: f64| Fish::new(amplitude, lag).by_hand(TAU, 200).translation.vector.norm();
        lags.iter().map(|&lag| (lag.to_degrees(), far(lag))).collect()
    };
    let phases = Plot::new(
        "one stroke, by the hinges' lag",
        ("lag, °", 0.0..180.0),
        ("distance, semi-axes", 0.0..3.2),
        vec![
            Line::new("1.25 rad", orange, gain(1.25)),
            Line::new("1 rad", blue, gain(1.0)),
            Line::new("0.5 rad", green, gain(0.5)),
        ],
    );
    sheet("Swimming without an impulse", (1800, 900), &[vec![stroke, way, phases]])
}
