//! The picture of the example `rolling_disk`: a hoop on a floor, and where it touched it.

use std::error::Error;

use gauss_runtime::prelude::*;
use plotters::prelude::*;

use gauss_charts::drawing::{COLOURS, INK, PALE, text_style};

/// A hoop at one time.
#[derive(Clone, Copy, Debug)]
pub struct Hoop {
    /// Its centre, m.
    pub centre: Vector3<f64>,
    /// Takes its axis from e₃, the direction from the contact to the centre from e₂.
    pub rotation: UnitQuaternion<f64>,
    /// m.
    pub radius: f64,
}

impl Hoop {
    fn contact(&self) -> Vector3<f64> {
        self.centre - self.rotation * Vector3::new(0.0, self.radius, 0.0)
    }

    fn rim(&self) -> impl Iterator<Item = Vector3<f64>> {
        let Self { centre, rotation, radius } = *self;
        (0..=72).map(move |n| {
            let (s, c) = (f64::from(n) * 5.0_f64.to_radians()).sin_cos();
            centre + rotation * Vector3::new(radius * c, radius * s, 0.0)
        })
    }
}

/// What is shown of the floor and of the hoops.
#[derive(Clone, Copy, Debug)]
pub struct Floor {
    /// Distance of its lines, m.
    pub grid: f64,
    /// So many of the last hoops are drawn, evenly chosen, beside the one at the end.
    pub shown: usize,
    /// Among how many of the last.
    pub among: usize,
}

/// Width and height in pixels, of which the lines are drawn through whole ones: many make them smooth.
const SIZE: (u32, u32) = (2200, 1520);

/// A point as it is seen from 40° above the floor; metres on the paper.
fn seen(point: Vector3<f64>) -> (f64, f64) {
    let (azimuth, elevation) = (28.0_f64.to_radians(), 40.0_f64.to_radians());
    let right = point.x * azimuth.cos() + point.y * azimuth.sin();
    let away = point.y * azimuth.cos() - point.x * azimuth.sin();
    (right, point.z * elevation.cos() + away * elevation.sin())
}

/// Least and largest.
fn range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)))
}

/// Draws the floor, the trace of the contact, and the last hoops, the pale ones before the one at the end.
///
/// # Errors
/// When the picture cannot be laid out.
pub fn draw(hoops: &[Hoop], floor: Floor, title: &str) -> Result<String, Box<dyn Error>> {
    let contacts = || hoops.iter().map(Hoop::contact);
    let whole =
        |(low, high): (f64, f64)| ((low / floor.grid - 0.3).floor() as i32, (high / floor.grid + 0.3).ceil() as i32);
    let (x, y) = (whole(range(contacts().map(|p| p.x))), whole(range(contacts().map(|p| p.y))));
    let node = |i: i32, j: i32| seen(Vector3::new(f64::from(i), f64::from(j), 0.0) * floor.grid);

    // One metre is the same length in both directions of the paper.
    let corners = [node(x.0, y.0), node(x.0, y.1), node(x.1, y.0), node(x.1, y.1)];
    let points = || corners.into_iter().chain(hoops.iter().flat_map(Hoop::rim).map(seen));
    let ((left, right), (low, high)) = (range(points().map(|p| p.0)), range(points().map(|p| p.1)));
    let (width, height) = (f64::from(SIZE.0) - 160.0, f64::from(SIZE.1) - 260.0);
    let metre = ((right - left) / width).max((high - low) / height);
    let half = (0.5 * f64::from(SIZE.0) * metre, 0.5 * f64::from(SIZE.1) * metre);
    let middle = (0.5 * (left + right), 0.5 * (low + high) + 60.0 * metre);

    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, SIZE).into_drawing_area();
        root.fill(&WHITE)?;
        root.draw(&Text::new(title.to_owned(), (72, 48), text_style(52, INK)))?;
        let mut chart = ChartBuilder::on(&root)
            .build_cartesian_2d(middle.0 - half.0..middle.0 + half.0, middle.1 - half.1..middle.1 + half.1)?;
        for i in x.0..=x.1 {
            chart.draw_series(LineSeries::new([node(i, y.0), node(i, y.1)], PALE.stroke_width(2)))?;
        }
        for j in y.0..=y.1 {
            chart.draw_series(LineSeries::new([node(x.0, j), node(x.1, j)], PALE.stroke_width(2)))?;
        }
        let words = format!("lines every {} m", floor.grid);
        root.draw(&Text::new(words, (72, SIZE.1 as i32 - 80), text_style(36, INK)))?;

        chart.draw_series(LineSeries::new(contacts().map(seen), COLOURS[1].stroke_width(6)))?;
        let recent = &hoops[hoops.len().saturating_sub(floor.among)..];
        for k in 0..=floor.shown {
            let Some(hoop) = recent.get((k * recent.len().saturating_sub(1)) / floor.shown.max(1)) else { continue };
            let end = k == floor.shown;
            let colour = COLOURS[0].mix(if end { 1.0 } else { 0.15 + 0.45 * k as f64 / floor.shown as f64 });
            let stroke = ShapeStyle { color: colour, filled: false, stroke_width: if end { 8 } else { 4 } };
            chart.draw_series(LineSeries::new(hoop.rim().map(seen), stroke))?;
        }
        for (hoop, words) in hoops.first().map(|h| (h, "start")).into_iter().chain(hoops.last().map(|h| (h, "end"))) {
            let (right, up) = seen(hoop.contact());
            chart.draw_series([
                Circle::new((right, up), 10, COLOURS[1].filled()).into_dyn(),
                Text::new(words, (right + 24.0 * metre, up - 12.0 * metre), text_style(36, INK)).into_dyn(),
            ])?;
        }
        root.present()?;
    }
    Ok(svg)
}
