//! Plots on logarithmic axes as SVG: for the page, where each has its legend beside it, and for the picture, where
//! they share one.

use std::fmt::Write;
use std::ops::Range;

use gauss_charts::panels::power_of_ten;

/// What a point looks like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// Nothing.
    None,
    /// A disc.
    Disc,
    /// A square.
    Square,
    /// A triangle on its base.
    Triangle,
    /// A square on its corner.
    Diamond,
}

/// How a line looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    /// A colour of the web.
    pub colour: &'static str,
    /// Lengths of dashes and gaps; empty: a whole line.
    pub dash: &'static str,
    /// At the points.
    pub mark: Mark,
    /// Of the line, px.
    pub width: f64,
}

/// A line through points.
#[derive(Clone, Debug)]
pub struct Series {
    /// In the legend.
    pub name: String,
    /// How it looks.
    pub style: Style,
    /// Along and up.
    pub points: Vec<(f64, f64)>,
}

/// An axis.
#[derive(Clone, Debug)]
pub struct Axis {
    /// What is measured, with the unit.
    pub label: String,
    /// From left to right or from bottom to top; of a logarithmic axis the powers of ten.
    pub ends: Range<f64>,
    /// Whether it is logarithmic.
    pub decades: bool,
}

/// A plot.
#[derive(Clone, Debug)]
pub struct Chart {
    /// Above it.
    pub title: String,
    /// A second line, smaller and paler.
    pub subtitle: String,
    /// Along.
    pub x: Axis,
    /// Up.
    pub y: Axis,
    /// The first one lies at the bottom.
    pub series: Vec<Series>,
    /// Width and height in px, without the legend.
    pub size: (f64, f64),
    /// Height of letters, px.
    pub letters: f64,
}

/// Text in which SVG reads no marks.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

/// Words at a place; `anchor` is `start`, `middle` or `end`.
pub fn words(text: &str, (x, y): (f64, f64), size: f64, anchor: &str, colour: &str) -> String {
    format!(
        "<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"{size:.1}\" text-anchor=\"{anchor}\" fill=\"{colour}\">{}</text>\n",
        escaped(text)
    )
}

/// The head of a picture of this size on white.
pub fn picture((width, height): (f64, f64), inside: &str) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" \
         viewBox=\"0 0 {width:.0} {height:.0}\" font-family=\"sans-serif\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n{inside}</svg>\n"
    )
}

const INK: &str = "#2d2d2d";
const PALE: &str = "#e2e2e2";
const DIM: &str = "#6a6a6a";

impl Style {
    /// A piece of the line with its mark, as in a legend.
    pub fn sample(&self, (x, y): (f64, f64), length: f64) -> String {
        self.line(&[(x, y), (x + length, y)]) + &self.marks(&[(x + 0.5 * length, y)])
    }

    fn line(&self, points: &[(f64, f64)]) -> String {
        let list: Vec<String> = points.iter().map(|(x, y)| format!("{x:.1},{y:.1}")).collect();
        format!(
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" stroke-dasharray=\"{}\" \
             stroke-linejoin=\"round\"/>\n",
            list.join(" "),
            self.colour,
            self.width,
            if self.dash.is_empty() { "none" } else { self.dash }
        )
    }

    fn marks(&self, points: &[(f64, f64)]) -> String {
        let r = 1.9 * self.width;
        let mut svg = String::new();
        for (x, y) in points {
            let shape = match self.mark {
                Mark::None => continue,
                Mark::Disc => format!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{r:.1}\""),
                Mark::Square => {
                    format!("<rect x=\"{:.1}\" y=\"{:.1}\" width=\"{2:.1}\" height=\"{2:.1}\"", x - r, y - r, 2.0 * r)
                }
                Mark::Triangle => {
                    let (top, foot, half) = (y - 1.3 * r, y + 0.8 * r, 1.25 * r);
                    format!("<path d=\"M{x:.1} {top:.1}L{:.1} {foot:.1}H{:.1}Z\"", x + half, x - half)
                }
                Mark::Diamond => {
                    let d = 1.4 * r;
                    format!(
                        "<path d=\"M{x:.1} {:.1}L{:.1} {y:.1}L{x:.1} {:.1}L{:.1} {y:.1}Z\"",
                        y - d,
                        x + d,
                        y + d,
                        x - d
                    )
                }
            };
            // Writing to a string does not fail.
            let _ = writeln!(svg, "{shape} fill=\"{}\"/>", self.colour);
        }
        svg
    }
}

impl Axis {
    /// Where a value is between the ends, from 0 to 1.
    fn place(&self, value: f64) -> f64 {
        let value = if self.decades { value.log10() } else { value };
        (value - self.ends.start) / (self.ends.end - self.ends.start)
    }

    /// Values with grid lines, `most` at most beside the first, and what is written there.
    fn ticks(&self, most: f64) -> Vec<(f64, String)> {
        let (low, high) = (self.ends.start.min(self.ends.end), self.ends.start.max(self.ends.end));
        let step = if self.decades {
            ((high - low) / most).ceil().max(1.0)
        } else {
            let raw = (high - low) / most;
            let unit = 10.0_f64.powf(raw.log10().floor());
            unit * [1.0, 2.0, 5.0, 10.0].into_iter().find(|n| n * unit >= raw).unwrap_or(10.0)
        };
        let first = (low / step).ceil() as i64;
        let last = (high / step + 1e-9).floor() as i64;
        (first..=last)
            .map(|n| {
                let value = n as f64 * step;
                let text = if self.decades { power_of_ten(value) } else { format!("{}", (value * 1e6).round() / 1e6) };
                ((value - self.ends.start) / (self.ends.end - self.ends.start), text)
            })
            .collect()
    }
}

impl Chart {
    /// The plot without legend, its left and upper corner at a place.
    pub fn body(&self, (left, top): (f64, f64)) -> String {
        let a = self.letters;
        let (x0, x1) = (left + 4.6 * a, left + self.size.0 - 1.2 * a);
        let (y0, y1) = (top + self.size.1 - 3.6 * a, top + if self.subtitle.is_empty() { 2.4 } else { 4.0 } * a);
        let mut svg = words(&self.title, (x0, top + 1.3 * a), 1.12 * a, "start", INK);
        svg += &words(&self.subtitle, (x0, top + 2.8 * a), 0.95 * a, "start", DIM);
        let line = |from: (f64, f64), to: (f64, f64), colour: &str| {
            let ((a, b), (c, d)) = (from, to);
            format!("<path d=\"M{a:.1} {b:.1}L{c:.1} {d:.1}\" stroke=\"{colour}\" stroke-width=\"1.5\"/>\n")
        };
        // A label is three letters wide, with the gap before the next one.
        for (place, text) in self.x.ticks(((x1 - x0) / (3.0 * a)).floor().clamp(1.0, 8.0)) {
            let x = x0 + place * (x1 - x0);
            svg += &line((x, y0), (x, y1), PALE);
            svg += &words(&text, (x, y0 + 1.25 * a), 0.92 * a, "middle", INK);
        }
        for (place, text) in self.y.ticks(8.0) {
            let y = y0 + place * (y1 - y0);
            svg += &line((x0, y), (x1, y), PALE);
            svg += &words(&text, (x0 - 0.4 * a, y + 0.33 * a), 0.92 * a, "end", INK);
        }
        svg += &line((x0, y0), (x1, y0), INK);
        svg += &line((x0, y0), (x0, y1), INK);
        svg += &words(&self.x.label, (0.5 * (x0 + x1), y0 + 2.9 * a), a, "middle", INK);
        let (x, y) = (left + 1.0 * a, 0.5 * (y0 + y1));
        let _ = write!(
            svg,
            "<g transform=\"rotate(-90 {x:.1} {y:.1})\">{}</g>",
            words(&self.y.label, (x, y), a, "middle", INK)
        );
        for series in &self.series {
            // What lies outside is left out, not drawn over the frame.
            let places = series.points.iter().map(|&(x, y)| (self.x.place(x), self.y.place(y)));
            let inside = places.filter(|(x, y)| (-0.001..=1.001).contains(x) && (-0.001..=1.001).contains(y));
            let places: Vec<(f64, f64)> = inside.map(|(x, y)| (x0 + x * (x1 - x0), y0 + y * (y1 - y0))).collect();
            svg += &series.style.line(&places);
            svg += &series.style.marks(&places);
        }
        svg
    }

    /// The plot with its legend on the right.
    pub fn with_legend(&self) -> String {
        let a = self.letters;
        let longest = self.series.iter().map(|series| series.name.chars().count()).max().unwrap_or(0);
        let mut svg = self.body((0.0, 0.0));
        for (n, series) in self.series.iter().enumerate() {
            let y = 4.4 * a + 1.55 * a * n as f64;
            svg += &series.style.sample((self.size.0 + a, y - 0.33 * a), 2.6 * a);
            svg += &words(&series.name, (self.size.0 + 4.2 * a, y), 0.95 * a, "start", INK);
        }
        let height = self.size.1.max(4.4 * a + 1.55 * a * self.series.len() as f64);
        picture((self.size.0 + (5.2 + 0.6 * longest as f64) * a, height), &svg)
    }
}

/// The powers of ten that hold all values, and at least one decade.
pub fn decades(values: impl Iterator<Item = f64>) -> Range<f64> {
    let logs = values.filter(|value| *value > 0.0 && value.is_finite()).map(f64::log10);
    let (low, high) = logs.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    if low > high { 0.0..1.0 } else { low.floor()..high.ceil().max(low.floor() + 1.0) }
}
