//! The picture: the plate on its way down, three times; its angle and the powers of the elements.

use std::error::Error;
use std::f64::consts::PI;
use std::ops::Range;

use gauss_charts::drawing::{COLOURS, INK};
use gauss_examples::plots::{Line, Plot, mosaic};
use gauss_playback::{Playback, Shape};
use gauss_runtime::prelude::*;
use plotters::style::RGBColor;

use crate::scene::{FLUTTERING, IdealPlateKernel, Plate, PlateKernel, TUMBLING, places};

/// Every so many samples a point of a curve.
const THINNED: usize = 4;

/// Draws everything.
///
/// # Errors
/// When a panel cannot be laid out.
pub fn draw(
    ideal: &Trajectory<IdealPlateKernel>,
    flutter: &Trajectory<PlateKernel>,
    tumble: &Trajectory<PlateKernel>,
) -> Result<String, Box<dyn Error>> {
    let turns = |path| places(path).into_iter().step_by(THINNED).map(|(t, [.., angle])| (t, angle / (2.0 * PI)));
    let over_time = |title, y, ends, lines| Plot::new(title, ("time, a/U", 0.0..flutter.last().t), (y, ends), lines);
    let angles =
        vec![Line::new("it flutters", COLOURS[0], turns(flutter)), Line::new("it tumbles", COLOURS[1], turns(tumble))];
    mosaic(
        "A plate falls in a fluid: without friction, fluttering, tumbling",
        (1600, 1560),
        &[
            ([0, 0, 400, 980], fall("Ideal fluid, from rest", COLOURS[2], &places(ideal), 0.0..6.0, 0.25)),
            ([400, 0, 540, 980], fall("I* = 1.1: it flutters", COLOURS[0], &places(flutter), 21.0..46.0, 0.5)),
            ([940, 0, 660, 490], fall("I* = 1.4: it tumbles", COLOURS[1], &places(tumble), 21.0..46.0, 0.5)),
            ([940, 490, 660, 490], over_time("Angle", "turns", -4.0..1.0, angles)),
            (
                [0, 980, 800, 490],
                over_time("Power while it flutters", "ρ a U³", -9.0..9.0, powers(FLUTTERING, flutter)?),
            ),
            ([800, 980, 800, 490], over_time("Power while it tumbles", "ρ a U³", -9.0..9.0, powers(TUMBLING, tumble)?)),
        ],
    )
}

fn powers(ratio: f64, path: &Trajectory<PlateKernel>) -> Result<Vec<Line>, ParameterError> {
    let kernel = Plate::new(ratio).kernel()?;
    let power = |name: &str| -> Vec<(f64, f64)> {
        let of = |s: &Sample<PlateKernel>| Some((s.t, kernel.power(name, s.t, &s.q, &s.z, &())?));
        path.iter().step_by(THINNED).filter_map(of).collect()
    };
    Ok(vec![
        Line::new("weight", COLOURS[2], power("gravity")).wide(3),
        Line::new("drag", COLOURS[1], power("drag")).wide(3),
        Line::new("braking", COLOURS[3], power("braking")).wide(3),
        Line::new("lift", INK, power("lift")).dashed().wide(3),
    ])
}

/// The path of the middle during `times`, and the plate every so often; x and y at one scale.
fn fall(
    title: &'static str,
    colour: RGBColor,
    places: &[(f64, [f64; 3])],
    times: Range<f64>,
    every: f64,
) -> Plot<'static> {
    let shown: Vec<_> = places.iter().filter(|(t, _)| times.contains(t)).collect();
    let ends = |i: usize| {
        let values = shown.iter().map(|(_, place)| place[i]);
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        low - 1.2..high + 1.2
    };
    let mut lines = vec![Line::new("", colour, shown.iter().step_by(THINNED).map(|(_, [x, y, _])| (*x, *y))).wide(1)];
    let mut next = times.start;
    for (t, [x, y, angle]) in &shown {
        if *t + 1e-9 >= next {
            next += every;
            let (sine, cosine) = angle.sin_cos();
            lines.push(Line::new("", colour, [(x - cosine, y - sine), (x + cosine, y + sine)]).wide(5));
        }
    }
    let (x, y) = (("sideways, a", ends(0)), ("height, a", ends(1)));
    Plot::new(title, x, y, lines).to_scale()
}

/// The plate that tumbles, as a page.
pub fn page(kernel: &PlateKernel, path: &Trajectory<PlateKernel>) -> Result<Playback<PlateKernel>, Box<dyn Error>> {
    let page = Playback::new("A plate that tumbles", path)?
        .si()
        .up([0.0, 1.0, 0.0])
        .body("plate", |s| kernel.pose(s.t, &s.q), [Shape::elliptic_cylinder([1.0, 1.0 / 14.0], 2.0)])
        .follow("plate")
        .trace("plate", [0.0; 3]);
    Ok(page.energy(kernel))
}
