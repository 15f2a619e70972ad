//! The map of times, and how many pendulums are left.

use std::error::Error;
use std::f64::consts::PI;

use gauss_charts::drawing::INK;
use gauss_examples::plots::{Cell, Line, Plot, mosaic};
use plotters::style::RGBColor;

use crate::map::{LONGEST, Map};

/// Of those that never flip.
const NEVER: RGBColor = RGBColor(250, 250, 250);
/// From soon to late: equally light steps from yellow to dark blue.
const SCALE: [RGBColor; 6] = [
    RGBColor(253, 231, 37),
    RGBColor(122, 209, 81),
    RGBColor(34, 168, 132),
    RGBColor(42, 120, 142),
    RGBColor(65, 68, 135),
    RGBColor(52, 10, 72),
];
/// How many colours there are between those.
const SHADES: f64 = 40.0;
/// The decimal logarithm of the first time that has a colour of its own.
const SOON: f64 = 0.4;

/// The colour of a time.
fn colour(time: f64) -> RGBColor {
    let share = ((time.log10() - SOON) / (LONGEST.log10() - SOON)).clamp(0.0, 1.0);
    let place = (share * SHADES).round() / SHADES * (SCALE.len() - 1) as f64;
    let below = (place as usize).min(SCALE.len() - 2);
    let weight = place - below as f64;
    let mixed = |a: u8, b: u8| (f64::from(a) + weight * (f64::from(b) - f64::from(a))).round() as u8;
    let (a, b) = (SCALE[below], SCALE[below + 1]);
    RGBColor(mixed(a.0, b.0), mixed(a.1, b.1), mixed(a.2, b.2))
}

/// Cells of one colour in a row are one rectangle.
fn cells(map: &Map) -> Vec<Cell> {
    let edge = |n: usize| 2.0 * n as f64 / map.side as f64 - 1.0;
    let colours: Vec<_> = map.flips.iter().map(|flip| flip.map_or(NEVER, |(time, _)| colour(time))).collect();
    let mut cells = Vec::new();
    for (row, colours) in colours.chunks(map.side).enumerate() {
        let mut first = 0;
        for same in colours.chunk_by(|a, b| a == b) {
            let last = first + same.len();
            cells.push(([(edge(first), edge(row)), (edge(last), edge(row + 1))], same[0]));
            first = last;
        }
    }
    cells
}

/// Where the energy at rest just suffices: 2 cos θ₁ + cos θ₂ = 1, in half turns.
fn boundary() -> Line {
    let widest = 0.5 * PI;
    let upper = (0..=400).map(|n| widest * (f64::from(n) / 200.0 - 1.0));
    let half: Vec<_> = upper.map(|upper| (upper, (1.0 - 2.0 * upper.cos()).clamp(-1.0, 1.0).acos())).collect();
    let back = half.iter().rev().map(|&(upper, lower)| (upper, -lower));
    let round = half.iter().copied().chain(back).map(|(upper, lower)| (upper / PI, lower / PI));
    Line::new("", RGBColor(213, 94, 0), round).wide(3)
}

/// How many have not flipped until a time; the colours of the map below.
fn left(map: &Map) -> Plot<'static> {
    let mut times: Vec<f64> = map.flips.iter().flatten().map(|&(time, _)| time).collect();
    times.sort_by(f64::total_cmp);
    let share = |flipped: usize| 100.0 * (1.0 - flipped as f64 / map.flips.len() as f64);
    let curve = times.iter().enumerate().step_by(times.len() / 500 + 1).map(|(n, time)| (time.log10(), share(n)));
    let (from, to) = (SOON, LONGEST.log10());
    let at = |n: f64| from + (to - from) * n / SHADES;
    let scale = (0..SHADES as u32).map(f64::from).map(|n| {
        let middle = 10.0_f64.powf(at(n + 0.5));
        ([(at(n), 0.0), (at(n + 1.0), 8.0)], colour(middle))
    });
    let line = Line::new("", INK, curve);
    let (x, y) = (("log₁₀ of the time, in √(ℓ/g)", from..to), ("states, %", 0.0..100.0));
    Plot::new("How many have not flipped yet", x, y, vec![line]).with_cells(scale.collect())
}

/// Both.
pub fn draw(map: &Map) -> Result<String, Box<dyn Error>> {
    let angles = |name| (name, -1.0..1.0);
    let (x, y) = (angles("upper arm at rest, half turns from hanging"), angles("lower arm, half turns"));
    let title = "When an arm first goes over the top; white: it does not; within the line it cannot";
    let plot = Plot::new(title, x, y, vec![boundary()]).with_cells(cells(map));
    // Axes of 800 by 800 pixels: cells are whole pixels.
    let plots = [([0, 0, 955, 945], plot), ([960, 220, 740, 560], left(map))];
    mosaic("Double pendulums let go from rest", (1720, 1060), &plots)
}
