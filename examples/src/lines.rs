//! Panels of curves with their names beside them.

use std::error::Error;
use std::ops::Range;

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::figure::{Area, INK, PALE, text_style};
use crate::panels::power_of_ten;

/// A curve and its name.
pub struct Line {
    /// Along and up.
    pub points: Vec<(f64, f64)>,
    /// Its colour.
    pub colour: RGBColor,
    /// Its width in pixels.
    pub width: u32,
    /// Whether it is broken up.
    pub dashed: bool,
    /// Its name, and where that begins; nothing is written where the name is empty.
    pub name: (&'static str, f64, f64),
}

/// An axis: what it measures with the unit, and its ends.
pub struct Axis {
    /// As in `depth, m`.
    pub label: &'static str,
    /// From left to right, or from bottom to top: the start may be the larger one.
    pub ends: Range<f64>,
    /// Whether the values are decimal logarithms.
    pub decades: bool,
}

impl Axis {
    /// A linear axis.
    #[must_use]
    pub fn linear(label: &'static str, ends: Range<f64>) -> Self {
        Self { label, ends, decades: false }
    }

    fn tick(&self, value: f64) -> String {
        if self.decades { power_of_ten(value) } else { short(value) }
    }
}

/// A panel.
pub struct Panel {
    /// What is seen.
    pub title: String,
    /// Along.
    pub x: Axis,
    /// Up.
    pub y: Axis,
    /// Whether one unit is as long along as up; the ends then give way.
    pub equal: bool,
}

impl Panel {
    /// Draws the curves, the first one at the bottom.
    ///
    /// # Errors
    /// When the panel cannot be laid out.
    pub fn draw(&self, area: &Area<'_>, lines: &[Line]) -> Result<(), Box<dyn Error>> {
        const MARGIN: u32 = 24;
        const LEFT: u32 = 92;
        const BELOW: u32 = 68;
        area.draw(&Text::new(self.title.clone(), (30, 14), text_style(27, INK)))?;
        let (_, canvas) = area.split_vertically(62);
        let (width, height) = canvas.dim_in_pixel();
        let (mut x, mut y) = (self.x.ends.clone(), self.y.ends.clone());
        if self.equal {
            let (along, up) = (f64::from(width - LEFT - 2 * MARGIN), f64::from(height - BELOW));
            let unit = ((x.end - x.start).abs() / along).max((y.end - y.start).abs() / up);
            x = about_middle(&x, unit * along);
            y = about_middle(&y, unit * up);
        }
        let mut chart = ChartBuilder::on(&canvas)
            .margin_left(MARGIN)
            .margin_right(MARGIN)
            .x_label_area_size(BELOW)
            .y_label_area_size(LEFT)
            .build_cartesian_2d(x, y)?;
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(PALE)
            .axis_style(INK)
            .x_labels(7)
            .y_labels(7)
            .x_desc(self.x.label)
            .y_desc(self.y.label)
            .axis_desc_style(text_style(24, INK))
            .label_style(text_style(23, INK))
            .x_label_formatter(&|value| self.x.tick(*value))
            .y_label_formatter(&|value| self.y.tick(*value))
            .draw()?;
        for line in lines {
            let style = line.colour.stroke_width(line.width);
            let points = line.points.iter().copied();
            if line.dashed {
                chart.draw_series(DashedLineSeries::new(points, 12, 9, style))?;
            } else {
                chart.draw_series(LineSeries::new(points, style))?;
            }
        }
        chart.draw_series(lines.iter().filter(|line| !line.name.0.is_empty()).map(|line| {
            let (words, along, up) = line.name;
            let style = text_style(24, darker(line.colour)).pos(Pos::new(HPos::Left, VPos::Center));
            Text::new(words, (along, up), style)
        }))?;
        Ok(())
    }
}

/// An interval of a length about the same middle, in the same direction.
fn about_middle(ends: &Range<f64>, length: f64) -> Range<f64> {
    let (middle, half) = (0.5 * (ends.start + ends.end), 0.5 * length * (ends.end - ends.start).signum());
    middle - half..middle + half
}

/// `0.5`, `12`, without digits that say nothing.
fn short(value: f64) -> String {
    // Ticks are multiples of round numbers: what is beyond four decimals is rounding.
    let text = format!("{value:.4}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.replace('-', "−") }
}

/// The colour as letters can be read in it.
fn darker(RGBColor(red, green, blue): RGBColor) -> RGBColor {
    let part = |value: u8| (f64::from(value) * 0.8) as u8;
    RGBColor(part(red), part(green), part(blue))
}
