//! Columns as curves and points: panels below one another over a common axis, one for each unit.

mod axis;
mod points;

use std::ops::Range;

use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;

use crate::error::TableError;
use crate::table::Column;
use axis::Axis;

/// So many units of the drawing make a pixel: curves go through whole units, and would look jagged through whole
/// pixels.
const FINE: u32 = 8;
/// Pixels.
const WIDTH: u32 = 960;
const LOWEST: u32 = 190;
/// Clouds of points are looked at in both directions.
const LOWEST_CLOUD: u32 = 300;
const LABELS: (u32, u32) = (84, 26);
const NAME: u32 = 24;
const MARGIN: u32 = 14;
const TEXT: u32 = 15;
/// Radii of points in units of the drawing: of few, of more than these, and beside names.
const RADII: [u32; 3] = [2 * FINE, FINE, 3 * FINE];
const FEW: usize = 5000;
/// Part of the range of an axis that is left free at each end, so that points and curves are whole.
const FREE: f64 = 0.04;
/// The number of letters that fit next to the lowest panel.
const LETTERS: usize = 20;

/// From the palette of Okabe and Ito, told apart by every kind of colour vision.
const COLOURS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(86, 180, 233),
    RGBColor(230, 159, 0),
    RGBColor(120, 120, 120),
];
const INK: RGBColor = RGBColor(45, 45, 45);
const PALE: RGBColor = RGBColor(222, 222, 222);

/// Columns with one unit, or one without any.
struct Panel<'a> {
    columns: Vec<Column<'a>>,
}

/// All columns over the first one: those of each panel, or a panel for each unit.
pub fn draw(columns: &[Column<'_>], chosen: &[Vec<String>]) -> Result<String, TableError> {
    let Some((over, rest)) = columns.split_first() else { return Err(TableError::NothingToPlot) };
    let panels = if chosen.is_empty() { by_units(rest) } else { chosen_panels(columns, chosen)? };
    let Some(last) = panels.len().checked_sub(1) else { return Err(TableError::NothingToPlot) };
    if over.values.len() < 2 {
        return Err(TableError::NothingToPlot);
    }
    // Curves begin and end at the edges; points are whole there.
    let points = panels.iter().flat_map(|panel| &panel.columns).any(|column| column.points);
    let x = Axis::of(over.values, if points { FREE / 2.0 } else { 0.0 });
    // Names stand on the right, and all panels are as wide as one another.
    let longest = panels.iter().flat_map(Panel::names).map(|name| name.chars().count() as u32).max();
    let right = longest.map_or(2 * MARGIN, |count| (46 + 8 * count).min(WIDTH / 3));
    let heights: Vec<u32> = panels.iter().map(Panel::height).collect();
    let size = (WIDTH, heights.iter().sum::<u32>() + NAME + MARGIN);
    let mut svg = String::new();
    {
        let mut place = SVGBackend::with_string(&mut svg, (size.0 * FINE, size.1 * FINE)).into_drawing_area();
        place.fill(&WHITE).map_err(reason)?;
        for (n, (panel, height)) in panels.iter().zip(heights).enumerate() {
            let name = if n == last { NAME } else { 0 };
            let (here, below) = place.split_vertically(fine(height + name));
            panel.draw(&here, (over, &x), right, n == last).map_err(reason)?;
            place = below;
        }
        place.present().map_err(reason)?;
    }
    // The units stay those of the view box.
    let sized = |size: (u32, u32)| format!("width=\"{}\" height=\"{}\"", size.0, size.1);
    Ok(svg.replacen(&sized((size.0 * FINE, size.1 * FINE)), &sized(size), 1))
}

fn reason(error: impl ToString) -> TableError {
    TableError::Plot(error.to_string())
}

fn fine(pixels: u32) -> i32 {
    (pixels * FINE) as i32
}

fn writing(colour: RGBColor) -> TextStyle<'static> {
    ("sans-serif", f64::from(TEXT * FINE)).into_font().color(&colour)
}

fn chosen_panels<'a>(columns: &[Column<'a>], chosen: &[Vec<String>]) -> Result<Vec<Panel<'a>>, TableError> {
    let panel = |names: &Vec<String>| {
        let find = |name: &String| columns.iter().find(|column| column.name == name).copied();
        let columns: Vec<Column<'a>> = names.iter().filter_map(find).collect();
        if columns.iter().any(|column| column.unit != columns[0].unit) {
            return Err(TableError::MixedUnits { columns: columns.iter().map(ToString::to_string).collect() });
        }
        Ok(Panel { columns })
    };
    chosen.iter().filter(|names| !names.is_empty()).map(panel).collect()
}

fn by_units<'a>(columns: &[Column<'a>]) -> Vec<Panel<'a>> {
    let mut panels: Vec<Panel<'a>> = Vec::new();
    for &column in columns {
        match panels.iter_mut().find(|panel| column.unit.is_some() && panel.columns[0].unit == column.unit) {
            Some(panel) => panel.columns.push(column),
            None => panels.push(Panel { columns: vec![column] }),
        }
    }
    panels
}

/// Part of the drawing that a panel fills.
type Area<'s> = DrawingArea<SVGBackend<'s>, Shift>;

impl Panel<'_> {
    /// One curve is named at the axis, if there is room for it.
    fn alone(&self) -> Option<String> {
        let [one] = &self.columns[..] else { return None };
        Some(one.to_string()).filter(|name| name.chars().count() <= LETTERS)
    }

    /// Names on the right of the panel.
    fn names(&self) -> impl Iterator<Item = &str> {
        let named = if self.alone().is_none() { &self.columns[..] } else { &[] };
        named.iter().map(|column| column.name)
    }

    fn height(&self) -> u32 {
        let lowest = if self.columns.iter().any(|column| column.points) { LOWEST_CLOUD } else { LOWEST };
        lowest.max(2 * MARGIN + LABELS.1 + (TEXT + 6) * self.names().count() as u32)
    }

    /// Label of the vertical axis.
    fn label(&self) -> String {
        self.alone().unwrap_or_else(|| self.columns[0].unit.unwrap_or_default().to_owned())
    }

    fn draw(
        &self,
        area: &Area<'_>,
        (over, x): (&Column<'_>, &Axis),
        right: u32,
        named: bool,
    ) -> Result<(), Box<dyn std::error::Error>> {
        let y = Axis::of(self.columns.iter().flat_map(|column| column.values), FREE);
        let height = self.height() - MARGIN - LABELS.1;
        let mut chart = ChartBuilder::on(area)
            .margin_top(fine(MARGIN))
            .margin_left(fine(MARGIN))
            .margin_right(fine(right))
            .x_label_area_size(fine(LABELS.1 + if named { NAME } else { 0 }))
            .y_label_area_size(fine(LABELS.0))
            .build_cartesian_2d(x.range(), y.range())?;
        let mut mesh = chart.configure_mesh();
        mesh.light_line_style(TRANSPARENT)
            .bold_line_style(PALE.stroke_width(FINE))
            .axis_style(INK.stroke_width(FINE))
            .set_all_tick_mark_size(fine(4))
            .axis_desc_style(writing(INK))
            .label_style(writing(INK))
            .x_labels(9)
            .y_labels((height / 32) as usize)
            .y_desc(self.label());
        if named {
            mesh.x_desc(over.to_string());
        }
        mesh.x_label_formatter(&|value| x.label(*value)).y_label_formatter(&|value| y.label(*value)).draw()?;
        for (n, column) in self.columns.iter().enumerate() {
            draw_column(&mut chart, n, (over.values, column), (x.range(), y.range()))?;
        }
        self.legend(area, right)?;
        Ok(())
    }

    fn legend(&self, area: &Area<'_>, right: u32) -> Result<(), Box<dyn std::error::Error>> {
        let left = WIDTH - right + 10;
        for (n, (name, column)) in self.names().zip(&self.columns).enumerate() {
            let (top, colour) = (MARGIN + (TEXT + 6) * n as u32, COLOURS[n % COLOURS.len()]);
            let at = |along: u32| (fine(left + along), fine(top + TEXT / 2));
            let strokes = if n < COLOURS.len() { &[(0, 18)][..] } else { &[(0, 7), (11, 18)] };
            if column.points {
                area.draw(&Circle::new(at(9), RADII[2], point_style(n, 1.0)))?;
            } else {
                for (from, to) in strokes {
                    let ends = vec![at(*from), at(*to)];
                    area.draw(&PathElement::new(ends, colour.stroke_width(2 * FINE)))?;
                }
            }
            area.draw(&Text::new(name.to_owned(), (fine(left + 24), fine(top)), writing(INK)))?;
        }
        Ok(())
    }
}

/// A chart of numbers.
type Chart<'a, 's> = ChartContext<'a, SVGBackend<'s>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// The column with a number within its panel, over the first one, as a curve or as points.
fn draw_column(
    chart: &mut Chart<'_, '_>,
    n: usize,
    (x, column): (&[f64], &Column<'_>),
    ranges: (Range<f64>, Range<f64>),
) -> Result<(), Box<dyn std::error::Error>> {
    if column.points {
        // Points in one pixel are one.
        let (width, height) = chart.plotting_area().dim_in_pixel();
        let cloud = points::cloud(x, column.values, ranges, (width / FINE, height / FINE));
        let radius = RADII[usize::from(cloud.len() > FEW)];
        chart.draw_series(cloud.into_iter().map(|place| Circle::new(place, radius, point_style(n, 0.65))))?;
        return Ok(());
    }
    let style = COLOURS[n % COLOURS.len()].stroke_width(2 * FINE);
    for line in points::lines(x, column.values, ranges) {
        if n < COLOURS.len() {
            chart.draw_series(LineSeries::new(line, style))?;
        } else {
            chart.draw_series(DashedLineSeries::new(line, fine(8), fine(5), style))?;
        }
    }
    Ok(())
}

/// Discs that cover only a part of what is below them; where colours come again, circles.
fn point_style(n: usize, covers: f64) -> ShapeStyle {
    let colour = COLOURS[n % COLOURS.len()];
    if n < COLOURS.len() { colour.mix(covers).filled() } else { colour.stroke_width(FINE) }
}
