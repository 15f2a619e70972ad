//! The panels of the picture: curves over time on a logarithmic axis, the path in space, bars.

use std::error::Error;
use std::ops::Range;

use gauss_runtime::prelude::*;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::drawing::{Area, COLOURS, INK, PALE, text_style};
use crate::simulate::{Moment, Run};
use crate::timing::Timing;
use crate::vehicle::LENGTH;

/// A curve over time.
pub struct Curve {
    /// Time and value; the value is drawn on a logarithmic axis.
    pub points: Vec<(f64, f64)>,
    /// Its colour.
    pub colour: RGBColor,
    /// Its width in pixels.
    pub width: u32,
    /// Whether it is broken up.
    pub dashed: bool,
}

/// Words at a place of a panel.
pub struct Note {
    t: f64,
    decade: f64,
    words: String,
}

impl Note {
    /// Words that begin at a time, at a power of ten.
    #[must_use]
    pub fn new(t: f64, decade: f64, words: String) -> Self {
        Self { t, decade, words }
    }
}

/// Curves over time on a logarithmic axis.
pub struct LogPanel {
    /// What is drawn, with its unit.
    pub title: &'static str,
    /// Powers of ten at the ends of the axis; smaller values are drawn at its lower end, a curve of zeros too.
    pub decades: Range<f64>,
    /// What is written among the curves.
    pub notes: Vec<Note>,
}

impl LogPanel {
    /// Draws the curves, the first one at the bottom.
    ///
    /// # Errors
    /// When the panel cannot be laid out.
    pub fn draw(&self, area: &Area<'_>, curves: &[Curve]) -> Result<(), Box<dyn Error>> {
        let end = curves.iter().flat_map(|c| c.points.last()).map(|p| p.0).fold(0.0, f64::max);
        let lowest = self.decades.start;
        area.draw(&Text::new(self.title, (80, 12), text_style(23, INK)))?;
        let mut chart = ChartBuilder::on(area)
            .margin_top(56)
            .margin_right(36)
            .margin_bottom(6)
            .x_label_area_size(50)
            .y_label_area_size(80)
            .build_cartesian_2d(0.0..end, lowest..self.decades.end)?;
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(PALE)
            .axis_style(INK)
            .x_desc("time, s")
            .axis_desc_style(text_style(19, INK))
            .label_style(text_style(18, INK))
            .y_labels(10)
            .y_label_formatter(&|decade| power_of_ten(*decade))
            .x_label_formatter(&|t| format!("{t:.0}"))
            .draw()?;
        for curve in curves {
            // A zero now and then is rounding that happens to vanish: the line goes on to the next value.
            let null = curve.points.iter().all(|p| p.1 == 0.0);
            let drawn = curve.points.iter().filter(|p| null || p.1 != 0.0);
            let points = drawn.map(|&(t, value)| (t, value.log10().max(lowest)));
            let style = curve.colour.stroke_width(curve.width);
            if curve.dashed {
                chart.draw_series(DashedLineSeries::new(points, 14, 8, style))?;
            } else {
                chart.draw_series(LineSeries::new(points, style))?;
            }
        }
        let note = |note: &Note| Text::new(note.words.clone(), (note.t, note.decade), text_style(18, INK));
        chart.draw_series(self.notes.iter().map(note))?;
        Ok(())
    }
}

/// `10⁻¹²`.
#[must_use]
pub fn power_of_ten(decade: f64) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let superscript = |c: char| c.to_digit(10).map_or('⁻', |digit| DIGITS[digit as usize]);
    let exponent: String = format!("{decade:.0}").chars().map(superscript).collect();
    format!("10{exponent}")
}

/// A point in space as it is seen from the south-east, above; metres on the paper.
fn project(north: f64, east: f64, depth: f64) -> (f64, f64) {
    let (azimuth, elevation) = (-38.0_f64.to_radians(), 40.0_f64.to_radians());
    let right = north * azimuth.cos() - east * azimuth.sin();
    let away = east * azimuth.cos() + north * azimuth.sin();
    (right, -depth * elevation.cos() - away * elevation.sin())
}

fn on_paper(point: &Vector3<f64>) -> (f64, f64) {
    project(point.x, point.y, point.z)
}

/// The box of whole steps around values, with some air.
fn bounds(values: impl Iterator<Item = f64>, step: f64) -> (f64, f64) {
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
    ((low / step - 0.3).floor() * step, (high / step + 0.3).ceil() * step)
}

/// What is shown of a path.
#[derive(Clone, Copy, Debug)]
pub struct View {
    /// So much of its beginning, s.
    pub seconds: f64,
    /// Every so many moments the vehicle, in its true size; 0: nowhere.
    pub vehicle_every: usize,
    /// Distance of the lines on the floor and of the marks on the axis of depth, m.
    pub grid: f64,
    /// Widths of the four lines that lie on each other, in pixels.
    pub strokes: [u32; 4],
}

type Plane<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// The path of every run, one inside the other, with the attitude of the first one, over its shadow on the floor.
///
/// # Errors
/// When the panel cannot be laid out.
pub fn path(area: &Area<'_>, runs: &[Run], title: &str, view: View) -> Result<(), Box<dyn Error>> {
    let seen = |run: &Run| run.moments.iter().take_while(|m| m.t <= view.seconds + 1e-9).count();
    let moments = &runs[0].moments[..seen(&runs[0])];
    let positions = || moments.iter().map(|m| m.pose.translation.vector);
    let (south, north) = bounds(positions().map(|p| p.x), view.grid);
    let (west, east) = bounds(positions().map(|p| p.y), view.grid);
    let (top, floor) = bounds(positions().map(|p| p.z), view.grid);

    // One metre is the same length in both directions of the paper.
    let corners = [(south, west), (south, east), (north, west), (north, east)];
    // What is drawn: the floor, the upright axis, the path. Two upper corners of the box would be empty paper.
    let drawn = corners.iter().map(|&(n, e)| project(n, e, floor)).chain([project(south, west, top)]);
    let drawn = drawn.chain(positions().map(|p| on_paper(&p)));
    let (mut x, mut y) = ((f64::INFINITY, f64::NEG_INFINITY), (f64::INFINITY, f64::NEG_INFINITY));
    for (right, up) in drawn {
        x = (x.0.min(right), x.1.max(right));
        y = (y.0.min(up), y.1.max(up));
    }
    area.draw(&Text::new(title, (42, 12), text_style(23, INK)))?;
    let (_, canvas) = area.split_vertically(48);
    let (width, height) = canvas.dim_in_pixel();
    let margins = (120.0, 100.0);
    let metre = ((x.1 - x.0) / (f64::from(width) - margins.0)).max((y.1 - y.0) / (f64::from(height) - margins.1));
    let half = (0.5 * f64::from(width) * metre, 0.5 * f64::from(height) * metre);
    let centre = (0.5 * (x.0 + x.1), 0.5 * (y.0 + y.1) - 10.0 * metre);

    let mut chart = ChartBuilder::on(&canvas)
        .build_cartesian_2d(centre.0 - half.0..centre.0 + half.0, centre.1 - half.1..centre.1 + half.1)?;
    Frame { south, north, west, east, top, floor, grid: view.grid, pixel: metre }.draw(&mut chart)?;

    let shadow = positions().map(|p| project(p.x, p.y, floor));
    chart.draw_series(LineSeries::new(shadow, RGBColor(170, 170, 170).stroke_width(2)))?;
    // All four coincide: drawn one inside the other, so that each one is seen.
    for ((run, colour), stroke) in runs.iter().zip(COLOURS).zip(view.strokes) {
        let line = run.moments[..seen(run)].iter().map(|m| on_paper(&m.pose.translation.vector));
        chart.draw_series(LineSeries::new(line, colour.stroke_width(stroke)))?;
    }
    if view.vehicle_every > 0 {
        moments.iter().step_by(view.vehicle_every).try_for_each(|moment| vehicle(&mut chart, moment))?;
    }
    let last = &moments[moments.len() - 1];
    for moment in [&moments[0], last] {
        let (right, up) = on_paper(&moment.pose.translation.vector);
        let words = format!("{:.0} s", moment.t);
        chart.draw_series([Text::new(words, (right + 34.0 * metre, up - 4.0 * metre), text_style(18, INK))])?;
    }
    Ok(())
}

/// The box that the path is in.
struct Frame {
    south: f64,
    north: f64,
    west: f64,
    east: f64,
    top: f64,
    floor: f64,
    grid: f64,
    /// Metres in a pixel.
    pixel: f64,
}

impl Frame {
    /// The floor with its grid, an upright axis of depth, and their labels.
    fn draw(&self, chart: &mut Plane<'_, '_>) -> Result<(), Box<dyn Error>> {
        let Self { south, north, west, east, top, floor, grid, pixel } = *self;
        let steps = |from: f64, to: f64, by: f64| {
            (0..=((to - from) / by).round() as u32).map(move |n| from + by * f64::from(n))
        };
        let mut line = |from: (f64, f64), to: (f64, f64), colour: RGBColor| {
            chart.draw_series(LineSeries::new([from, to], colour)).map(|_| ())
        };
        for n in steps(south, north, grid) {
            line(project(n, west, floor), project(n, east, floor), PALE)?;
        }
        for e in steps(west, east, grid) {
            line(project(south, e, floor), project(north, e, floor), PALE)?;
        }
        line(project(south, west, floor), project(south, west, top), INK)?;
        line(project(south, west, floor), project(south, east, floor), INK)?;
        line(project(south, east, floor), project(north, east, floor), INK)?;
        for depth in steps(top, floor, grid) {
            let (right, up) = project(south, west, depth);
            line((right, up), (right - 6.0 * pixel, up), INK)?;
        }

        let label = |words: String, (right, up): (f64, f64), shift: (f64, f64), h: HPos| {
            Text::new(
                words,
                (right + shift.0 * pixel, up + shift.1 * pixel),
                text_style(18, INK).pos(Pos::new(h, VPos::Center)),
            )
        };
        let mut labels = Vec::new();
        for depth in steps(top, floor, grid) {
            labels.push(label(format!("{depth:.0}"), project(south, west, depth), (-12.0, 0.0), HPos::Right));
        }
        for n in steps(south, north, grid).skip(1) {
            labels.push(label(format!("{n:.0}"), project(n, east, floor), (7.0, -11.0), HPos::Left));
        }
        for e in steps(west, east, grid).skip(1) {
            labels.push(label(format!("{e:.0}"), project(south, e, floor), (-7.0, -11.0), HPos::Right));
        }
        labels.push(label("depth, m".into(), project(south, west, top), (-40.0, 26.0), HPos::Left));
        labels.push(label("north, m".into(), project(0.5 * (south + north), east, floor), (34.0, -34.0), HPos::Left));
        labels.push(label("east, m".into(), project(south, 0.5 * (west + east), floor), (-34.0, -34.0), HPos::Right));
        chart.draw_series(labels)?;
        Ok(())
    }
}

/// A hull with its nose and its upper fin.
fn vehicle(chart: &mut Plane<'_, '_>, moment: &Moment) -> Result<(), Box<dyn Error>> {
    let half = 0.5 * LENGTH;
    let at = |x: f64, z: f64| {
        on_paper(&(moment.pose.translation.vector + moment.pose.rotation * Vector3::new(x * half, 0.0, z * half)))
    };
    chart.draw_series(LineSeries::new([at(-1.0, 0.0), at(-1.0, -0.5)], INK.stroke_width(2)))?;
    chart.draw_series(LineSeries::new([at(-1.0, 0.0), at(1.0, 0.0)], INK.stroke_width(5)))?;
    let nose = at(1.0, 0.0);
    chart.draw_series([
        Circle::new(nose, 6, RGBColor(240, 228, 66).filled()),
        Circle::new(nose, 6, INK.stroke_width(1)),
    ])?;
    Ok(())
}

/// The time of one evaluation, by chart and form. The momentum form needs z(p) beside ṗ: its bar has two parts.
///
/// # Errors
/// When the panel cannot be laid out.
pub fn bars(area: &Area<'_>, timings: &[Timing]) -> Result<(), Box<dyn Error>> {
    area.draw(&Text::new("One evaluation of the equations of motion, ns", (60, 12), text_style(23, INK)))?;
    let charts: Vec<[&Timing; 3]> = timings.chunks_exact(3).map(|three| [&three[0], &three[1], &three[2]]).collect();
    let nanoseconds = |timing: &Timing| timing.quartiles[1];
    let of_chart = |[z, p, v]: &[&Timing; 3]| nanoseconds(z).max(nanoseconds(p) + nanoseconds(v));
    let longest = charts.iter().map(of_chart).fold(0.0, f64::max);

    let (width, height) = area.dim_in_pixel();
    let (left, right, top) = (200, 210, 56);
    let row = (height as i32 - top - 30) / (2 * charts.len() as i32);
    let at = |ns: f64| left + (ns * f64::from(width as i32 - left - right) / longest) as i32;
    let style = |h| text_style(18, INK).pos(Pos::new(h, VPos::Center));
    let bar = |y: i32, name: &str, parts: &[(&Timing, f64)], colour: RGBColor| -> Result<(), Box<dyn Error>> {
        let mut from = 0.0;
        for &(timing, strength) in parts {
            let to = from + nanoseconds(timing);
            area.draw(&Rectangle::new([(at(from), y + 4), (at(to), y + row - 4)], colour.mix(strength).filled()))?;
            from = to;
        }
        let operations: u32 = parts.iter().map(|(timing, _)| timing.operations.total()).sum();
        area.draw(&Text::new(name.to_owned(), (left - 12, y + row / 2), style(HPos::Right)))?;
        let cost = format!("{from:.0} ns, {operations} operations");
        area.draw(&Text::new(cost, (at(from) + 10, y + row / 2), style(HPos::Left)))?;
        Ok(())
    };
    for (n, ([z, p, v], colour)) in charts.iter().zip(COLOURS).enumerate() {
        // The two of a chart stand together.
        let y = top + 2 * row * n as i32;
        bar(y + 4, "velocity form: ż", &[(z, 1.0)], colour)?;
        bar(y + row - 4, "momentum: ṗ + z(p)", &[(p, 0.6), (v, 0.3)], colour)?;
    }
    Ok(())
}
