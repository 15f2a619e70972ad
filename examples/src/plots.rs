//! Plots with plain axes: a title, a legend in a row of its own below it, curves, words among them.

use std::error::Error;
use std::ops::Range;
use std::path::{Path, PathBuf};

use gauss_playback::Playback;
use gauss_runtime::system::GaussSystem;
use plotters::prelude::*;

use gauss_charts::drawing::{Area, INK, PALE, png, text_style};

/// A curve of a plot.
#[derive(Clone, Debug)]
pub struct Line {
    /// Abscissa and ordinate.
    pub points: Vec<(f64, f64)>,
    /// Its colour.
    pub colour: RGBColor,
    /// Its width in pixels.
    pub width: u32,
    /// Whether it is broken up.
    pub dashed: bool,
    /// What the legend calls it; nothing: it is not in the legend.
    pub name: String,
}

impl Line {
    /// A whole line of 4 pixels.
    pub fn new(name: impl Into<String>, colour: RGBColor, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        Self { points: points.into_iter().collect(), colour, width: 4, dashed: false, name: name.into() }
    }

    /// The same, broken up.
    #[must_use]
    pub fn dashed(mut self) -> Self {
        self.dashed = true;
        self
    }

    /// The same with another width.
    #[must_use]
    pub fn wide(mut self, pixels: u32) -> Self {
        self.width = pixels;
        self
    }
}

/// Curves over two plain axes.
#[derive(Clone, Debug)]
pub struct Plot<'a> {
    /// What it shows.
    pub title: &'a str,
    /// Name and unit of the abscissa.
    pub x: (&'a str, Range<f64>),
    /// Name and unit of the ordinate.
    pub y: (&'a str, Range<f64>),
    /// Whether both axes have one scale: then the ranges are made wider to fill the place.
    pub equal: bool,
    /// The first one lies at the bottom.
    pub lines: Vec<Line>,
    /// Dots with words to their right.
    pub marks: Vec<(f64, f64, String)>,
    /// Rectangles below all else.
    pub cells: Vec<Cell>,
    /// Dots below the curves.
    pub dots: Vec<(f64, f64)>,
}

/// A rectangle between two corners, and its colour.
pub type Cell = ([(f64, f64); 2], RGBColor);

/// So many units of the drawing make a pixel: curves go through whole units, and would look jagged through whole
/// pixels.
const FINE: u32 = 8;
/// Heights of the head and the legend, sizes of labels and margins, in units.
const TITLE: i32 = 46 * FINE as i32;
const LEGEND: i32 = 40 * FINE as i32;
const LABELS: (u32, u32) = (104 * FINE, 76 * FINE);
const MARGIN: u32 = 34 * FINE;
/// Where titles begin: above the axis.
const LEFT: i32 = (LABELS.0 + MARGIN / 2) as i32;

/// So pale that curves are seen over dots, and so dark that dots are seen.
const DOTS: RGBColor = RGBColor(124, 172, 214);

/// Pixels in units.
const fn fine(pixels: i32) -> i32 {
    pixels * FINE as i32
}

fn writing(size: u32) -> TextStyle<'static> {
    text_style(size * FINE, INK)
}

impl<'a> Plot<'a> {
    /// Curves over axes with these names and ranges.
    pub fn new(title: &'a str, x: (&'a str, Range<f64>), y: (&'a str, Range<f64>), lines: Vec<Line>) -> Self {
        Self { title, x, y, equal: false, lines, marks: Vec::new(), cells: Vec::new(), dots: Vec::new() }
    }

    /// The same with one scale for both axes.
    #[must_use]
    pub fn to_scale(self) -> Self {
        Self { equal: true, ..self }
    }

    /// The same with dots, and words to their right.
    #[must_use]
    pub fn marked(self, marks: Vec<(f64, f64, String)>) -> Self {
        Self { marks, ..self }
    }

    /// The same with coloured rectangles below all else.
    #[must_use]
    pub fn with_cells(self, cells: Vec<Cell>) -> Self {
        Self { cells, ..self }
    }

    /// The same with many dots below the curves.
    #[must_use]
    pub fn with_dots(self, dots: Vec<(f64, f64)>) -> Self {
        Self { dots, ..self }
    }

    /// Draws it into a place.
    ///
    /// # Errors
    /// When the place is too small.
    pub fn draw(&self, area: &Area<'_>) -> Result<(), Box<dyn Error>> {
        area.draw(&Text::new(self.title.to_owned(), (LEFT, fine(14)), writing(32)))?;
        let head = TITLE + if self.legend(area)? { LEGEND } else { fine(6) };
        let (width, height) = area.dim_in_pixel();
        let inside = (
            width.saturating_sub(LABELS.0 + MARGIN + MARGIN / 2),
            height.saturating_sub(head as u32 + LABELS.1 + MARGIN / 2),
        );
        let (x, y) = self.ranges((f64::from(inside.0), f64::from(inside.1)));
        let mut chart = ChartBuilder::on(area)
            .margin_top(head)
            .margin_left(MARGIN / 2)
            .margin_right(MARGIN)
            .margin_bottom(MARGIN / 2)
            .x_label_area_size(LABELS.1)
            .y_label_area_size(LABELS.0)
            .build_cartesian_2d(x, y)?;
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(PALE.stroke_width(FINE))
            .axis_style(INK.stroke_width(2 * FINE))
            .set_all_tick_mark_size(fine(6))
            .x_desc(self.x.0)
            .y_desc(self.y.0)
            .axis_desc_style(writing(28))
            .label_style(writing(26))
            .x_labels((inside.0 / (57 * FINE)).clamp(3, 8) as usize)
            .y_labels(7)
            .x_label_formatter(&number)
            .y_label_formatter(&number)
            .draw()?;
        chart.draw_series(self.cells.iter().map(|&(corners, colour)| Rectangle::new(corners, colour.filled())))?;
        let dot = |&place| Circle::new(place, fine(3), DOTS.filled());
        chart.draw_series(self.dots.iter().filter(|dot| self.holds(dot)).map(dot))?;
        for line in &self.lines {
            let (style, points) = (line.colour.stroke_width(line.width * FINE), line.points.iter().copied());
            if line.dashed {
                chart.draw_series(DashedLineSeries::new(points, fine(14), fine(9), style))?;
            } else {
                chart.draw_series(LineSeries::new(points, style))?;
            }
        }
        for (x, y, words) in &self.marks {
            let dot = EmptyElement::at((*x, *y))
                + Circle::new((0, 0), fine(7), INK.filled())
                + Text::new(words.clone(), (fine(13), fine(-14)), writing(27));
            chart.draw_series([dot])?;
        }
        Ok(())
    }

    /// A dot that is half outside would lie over the axis.
    fn holds(&self, &(x, y): &(f64, f64)) -> bool {
        self.equal || self.x.1.contains(&x) && self.y.1.contains(&y)
    }

    /// Names of the lines in a row; whether there are any.
    fn legend(&self, area: &Area<'_>) -> Result<bool, Box<dyn Error>> {
        let named = self.lines.iter().filter(|line| !line.name.is_empty());
        let mut left = LEFT;
        for line in named {
            let (y, end) = (TITLE + fine(20), left + fine(38));
            let style = line.colour.stroke_width(line.width.max(5) * FINE);
            let strokes: &[(i32, i32)] =
                if line.dashed { &[(left, left + fine(15)), (left + fine(23), end)] } else { &[(left, end)] };
            for &(from, to) in strokes {
                area.draw(&PathElement::new(vec![(from, y), (to, y)], style))?;
            }
            area.draw(&Text::new(line.name.clone(), (end + fine(10), TITLE + fine(6)), writing(27)))?;
            left = end + fine(38) + fine(12) * line.name.chars().count() as i32;
        }
        Ok(left > LEFT)
    }

    /// The ranges of the axes in a rectangle of this width and height.
    fn ranges(&self, (width, height): (f64, f64)) -> (Range<f64>, Range<f64>) {
        let (x, y) = (self.x.1.clone(), self.y.1.clone());
        if !self.equal {
            return (x, y);
        }
        let scale = ((x.end - x.start) / width).max((y.end - y.start) / height);
        let widened = |range: Range<f64>, pixels: f64| {
            let (middle, half) = (0.5 * (range.start + range.end), 0.5 * scale * pixels);
            middle - half..middle + half
        };
        (widened(x, width), widened(y, height))
    }
}

/// A number at a tick. Ticks are sums of steps: what is left of their rounding is not written.
fn number(value: &f64) -> String {
    let text = format!("{value:.4}");
    let short = text.trim_end_matches('0').trim_end_matches('.');
    if short == "-0" { "0".to_owned() } else { short.replace('-', "−") }
}

/// A picture of a size in pixels, with plots side by side in rows of one height below a title.
///
/// # Errors
/// When it cannot be laid out.
pub fn sheet(title: &str, size: (u32, u32), rows: &[Vec<Plot<'_>>]) -> Result<String, Box<dyn Error>> {
    picture(title, size, |body| {
        for (plots, row) in rows.iter().zip(body.split_evenly((rows.len(), 1))) {
            for (plot, place) in plots.iter().zip(row.split_evenly((1, plots.len()))) {
                plot.draw(&place)?;
            }
        }
        Ok(())
    })
}

/// A picture of a size in pixels, with plots in rectangles below a title: their left and upper ends there, widths and
/// heights.
///
/// # Errors
/// When it cannot be laid out.
pub fn mosaic(title: &str, size: (u32, u32), plots: &[([u32; 4], Plot<'_>)]) -> Result<String, Box<dyn Error>> {
    picture(title, size, |body| {
        for (rectangle, plot) in plots {
            let [left, top, width, height] = rectangle.map(|pixels| pixels * FINE);
            plot.draw(&body.clone().shrink((left, top), (width, height)))?;
        }
        Ok(())
    })
}

/// A white page with a title, and what is drawn below it.
fn picture(
    title: &str,
    size: (u32, u32),
    draw: impl FnOnce(&Area<'_>) -> Result<(), Box<dyn Error>>,
) -> Result<String, Box<dyn Error>> {
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, (size.0 * FINE, size.1 * FINE)).into_drawing_area();
        root.fill(&WHITE)?;
        root.draw(&Text::new(title.to_owned(), (fine(40), fine(26)), writing(40)))?;
        let (_, body) = root.split_vertically(fine(90));
        draw(&body)?;
        root.present()?;
    }
    // The units stay those of the view box.
    let sized = |size: (u32, u32)| format!("width=\"{}\" height=\"{}\"", size.0, size.1);
    Ok(svg.replacen(&sized((size.0 * FINE, size.1 * FINE)), &sized(size), 1))
}

/// Writes `NAME.svg` and `NAME.png` into the folder named on the command line, by default `target/gauss`.
///
/// # Errors
/// When a file cannot be written, or the text is no SVG.
pub fn write(name: &str, svg: &str) -> Result<(), Box<dyn Error>> {
    write_into(&folder(), name, svg)
}

/// The same into a folder.
///
/// # Errors
/// When a file cannot be written, or the text is no SVG.
pub fn write_into(folder: &Path, name: &str, svg: &str) -> Result<(), Box<dyn Error>> {
    let put = |ending: &str, contents: &[u8]| {
        let file = folder.join(format!("{name}.{ending}"));
        gauss_files::write(&file, contents)?;
        println!("written: {}", file.display());
        Ok::<(), std::io::Error>(())
    };
    put("svg", svg.as_bytes())?;
    put("png", &png(svg)?)?;
    Ok(())
}

/// Writes `NAME.html`, the motion as a page that plays, beside the pictures.
///
/// # Errors
/// What the page says is wrong, or when the file cannot be written.
pub fn write_page<S: GaussSystem<Scalar = f64>>(name: &str, page: &Playback<S>) -> Result<(), Box<dyn Error>> {
    write_page_into(&folder(), name, page)
}

/// The same into a folder.
///
/// # Errors
/// As [`write_page`].
pub fn write_page_into<S: GaussSystem<Scalar = f64>>(
    folder: &Path,
    name: &str,
    page: &Playback<S>,
) -> Result<(), Box<dyn Error>> {
    let file = folder.join(format!("{name}.html"));
    page.write(&file)?;
    println!("written: {}", file.display());
    Ok(())
}

fn folder() -> PathBuf {
    gauss_files::output_folder_or_argument()
}
