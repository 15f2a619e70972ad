//! The picture: tracks across the river, and speeds of what drifts.

use std::error::Error;

use gauss_examples::figure::{Area, COLOURS, INK, text_style};
use gauss_examples::lines::{Axis, Line, Panel};
use gauss_runtime::prelude::*;
use plotters::prelude::*;

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
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, (1640, 1100)).into_drawing_area();
        root.fill(&WHITE)?;
        root.draw(&Text::new("A boat in a stream", (30, 22), text_style(36, INK)))?;
        let (_, body) = root.split_vertically(80);
        let (left, right) = body.split_horizontally(820);
        let (upper, lower) = right.split_vertically(510);
        ways_across(&left, crossings, ratio, width, stream)?;
        released(&upper, from_rest, stream)?;
        adrift(&lower, afloat, sunken, tidal)?;
        root.present()?;
    }
    Ok(svg)
}

type Drawn = Result<(), Box<dyn Error>>;
type Path<'a> = &'a [Sample<BoatKernel>];

fn line(points: Vec<(f64, f64)>, colour: RGBColor, name: (&'static str, f64, f64)) -> Line {
    Line { points, colour, width: 4, dashed: false, name }
}

fn ways_across(area: &Area<'_>, crossings: [Crossing<'_>; 3], ratio: f64, width: f64, stream: f64) -> Drawn {
    let [blue, orange, green, pink] = COLOURS;
    let bank = |north: f64| Line { width: 6, ..line(vec![(-6.0, north), (22.0, north)], INK, ("", 0.0, 0.0)) };
    let mut lines = vec![bank(0.0), bank(width)];
    let formula = line(pursuit(ratio, width), pink, ("the same without inertia", 6.5, 13.0));
    lines.push(Line { dashed: true, ..formula });
    let names = [(9.6, 23.0), (-5.6, 18.0), (6.5, 15.0)];
    for ((crossing, colour), (east, north)) in crossings.iter().zip([orange, blue, green]).zip(names) {
        let track = crossing.path.iter().map(|s| (s.q.translation.vector.y, s.q.translation.vector.x)).collect();
        lines.push(line(track, colour, (crossing.name, east, north)));
        let boats = crossing.path.iter().step_by(10);
        lines.extend(boats.map(|sample| Line { width: 2, ..line(outline(sample), INK, ("", 0.0, 0.0)) }));
    }
    Panel {
        title: format!("Three ways across; the water runs east at {stream} m/s"),
        x: Axis::linear("east, m", -6.0..22.0),
        y: Axis::linear("north, m", -2.0..width + 2.0),
        equal: true,
    }
    .draw(area, &lines)
}

/// Speeds to the east over time.
fn east(path: Path<'_>) -> Vec<(f64, f64)> {
    let observed = |s: &Sample<BoatKernel>| s.q.rotation * Vector3::new(s.z[0], s.z[1], 0.0).xy();
    path.iter().map(|s| (s.t, observed(s).y)).collect()
}

fn time() -> Axis {
    Axis::linear("time, s", 0.0..120.0)
}

fn released(area: &Area<'_>, from_rest: Path<'_>, stream: f64) -> Drawn {
    let [blue, orange, ..] = COLOURS;
    Panel {
        title: "Released at rest, athwart the stream".into(),
        x: time(),
        y: Axis::linear("speed to the east, m/s", 0.0..0.2),
        equal: false,
    }
    .draw(
        area,
        &[
            Line { dashed: true, ..line(vec![(0.0, stream), (120.0, stream)], orange, ("water", 6.0, 0.16)) },
            line(east(from_rest), blue, ("boat", 30.0, 0.1)),
        ],
    )
}

fn adrift(area: &Area<'_>, afloat: Path<'_>, sunken: Path<'_>, tidal: &Boat) -> Drawn {
    let [blue, orange, green, _] = COLOURS;
    let water = (0..=120).map(f64::from).map(|t| (t, (tidal.stream + tidal.tide * (tidal.frequency * t).sin()).y));
    Panel {
        title: "Adrift in a tide".into(),
        x: time(),
        y: Axis::linear("speed to the east, m/s", -0.1..0.45),
        equal: false,
    }
    .draw(
        area,
        &[
            line(east(sunken), green, ("twice as heavy as its water", 30.0, 0.4)),
            line(east(afloat), blue, ("afloat", 30.0, 0.34)),
            Line { dashed: true, ..line(water.collect(), orange, ("water", 44.0, 0.34)) },
        ],
    )
}
