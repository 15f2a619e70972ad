//! The picture: tracks across the river, and speeds of what drifts.

use std::error::Error;

use gauss_charts::drawing::{COLOURS, INK};
use gauss_examples::plots::{Line, Plot, mosaic};
use gauss_playback::{Playback, Shape};
use gauss_runtime::prelude::*;

use crate::boat::{Boat, BoatKernel};

/// A track, with the boat every ten seconds.
pub struct Crossing<'a> {
    name: &'static str,
    path: &'a [Sample<BoatKernel>],
}

impl<'a> Crossing<'a> {
    pub fn new(name: &'static str, path: &'a [Sample<BoatKernel>]) -> Self {
        Self { name, path }
    }
}

/// The outline of the boat in its size, east and north.
fn outline(sample: &Sample<BoatKernel>) -> Vec<(f64, f64)> {
    let corners = [(0.63, 0.0), (0.3, 0.15), (-0.63, 0.15), (-0.63, -0.15), (0.3, -0.15), (0.63, 0.0)];
    let place = |(x, y): (f64, f64)| sample.q.translation.vector + sample.q.rotation * Vector3::new(x, y, 0.0).xy();
    corners.into_iter().map(place).map(|p| (p.y, p.x)).collect()
}

/// Where a boat without inertia goes that always points at the landing: `y = (D/2) (s^(1−k) − s^(1+k))` with the part s
/// of the width D that is left, and k the ratio of the speeds (Bouguer).
fn pursuit(ratio: f64, width: f64) -> Vec<(f64, f64)> {
    let point = |n: u32| {
        let left = 1.0 - f64::from(n) / 100.0;
        (0.5 * width * (left.powf(1.0 - ratio) - left.powf(1.0 + ratio)), width * (1.0 - left))
    };
    (0..=100).map(point).collect()
}

/// Draws everything: the crossings, the ratio of stream and speed, the width of the river; drifting from rest, afloat
/// and heavy in the tide.
///
/// # Errors
/// When a panel cannot be laid out.
pub fn draw(
    crossings: [Crossing<'_>; 3],
    ratio: f64,
    width: f64,
    [from_rest, afloat, sunken]: [&[Sample<BoatKernel>]; 3],
    (stream, tidal): (f64, &Boat),
) -> Result<String, Box<dyn Error>> {
    let [blue, orange, green, _] = COLOURS;
    let over_time =
        |title, ends, lines| Plot::new(title, ("time, s", 0.0..120.0), ("speed to the east, m/s", ends), lines);
    let released = vec![
        Line::new("boat", blue, east(from_rest)),
        Line::new("water", orange, [(0.0, stream), (120.0, stream)]).dashed(),
    ];
    let water = (0..=120).map(f64::from).map(|t| (t, (tidal.stream + tidal.tide * (tidal.frequency * t).sin()).y));
    let adrift = vec![
        Line::new("boat", blue, east(afloat)),
        Line::new("twice as heavy", green, east(sunken)),
        Line::new("water", orange, water).dashed(),
    ];
    let title = format!("Three ways across; the water runs east at {stream} m/s");
    let plots = [
        ([0, 0, 950, 1080], ways_across(&title, crossings, ratio, width)),
        ([950, 0, 750, 540], over_time("Released at rest, athwart the stream", 0.0..0.2, released)),
        ([950, 540, 750, 540], over_time("Adrift in a tide", -0.1..0.45, adrift)),
    ];
    mosaic("A boat in a stream", (1700, 1170), &plots)
}

/// Speeds to the east over time.
fn east(path: &[Sample<BoatKernel>]) -> impl Iterator<Item = (f64, f64)> {
    path.iter().map(|s| (s.t, (s.q.rotation * Vector3::new(s.z[0], s.z[1], 0.0).xy()).y))
}

fn ways_across<'a>(title: &'a str, crossings: [Crossing<'_>; 3], ratio: f64, width: f64) -> Plot<'a> {
    let [blue, orange, green, pink] = COLOURS;
    let bank = |north: f64| Line::new("", INK, [(-6.0, north), (22.0, north)]).wide(6);
    let mut lines = vec![bank(0.0), bank(width)];
    let mut boats = Vec::new();
    for (crossing, colour) in crossings.iter().zip([orange, blue, green]) {
        let track = crossing.path.iter().map(|s| (s.q.translation.vector.y, s.q.translation.vector.x));
        lines.push(Line::new(crossing.name, colour, track));
        boats.extend(crossing.path.iter().step_by(10).map(|sample| Line::new("", INK, outline(sample)).wide(2)));
    }
    lines.push(Line::new("no inertia", pink, pursuit(ratio, width)).dashed());
    lines.append(&mut boats);
    let (x, y) = (("east, m", -6.0..22.0), ("north, m", -2.0..width + 2.0));
    Plot::new(title, x, y, lines).to_scale()
}

/// A crossing as a page.
pub fn page(kernel: &BoatKernel, path: Vec<Sample<BoatKernel>>, stream: Vector3<f64>) -> Playback<BoatKernel> {
    let place = |s: &Sample<BoatKernel>| kernel.pose(s.t, &s.q).translation.vector;
    let velocity = |s: &Sample<BoatKernel>| s.q.rotation * s.z.fixed_rows::<2>(0);
    Playback::of_samples("A boat crosses a river, steering for the landing", path)
        .si()
        .up([0.0, 0.0, -1.0])
        .from_above()
        .body(
            "boat",
            |s| kernel.pose(s.t, &s.q),
            [
                Shape::ellipsoid([0.63, 0.145, 0.12]),
                Shape::cuboid([0.3, 0.16, 0.16]).at(&Isometry3::translation(0.25, 0.0, -0.1)).colour("#444444"),
            ],
        )
        .trace("boat", [0.0; 3])
        .arrow("velocity", 5.0, |s| (place(s), Vector3::new(velocity(s).x, velocity(s).y, 0.0)))
        .arrow("stream", 5.0, move |s| (place(s), stream))
        .curve("angle / °", "heading", |s| s.q.rotation.angle().to_degrees())
        .curve("velocity / (m/s)", "to the north", move |s| velocity(s).x)
        .curve("velocity / (m/s)", "to the east", move |s| velocity(s).y)
}
