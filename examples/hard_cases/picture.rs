//! The overview: every figure over its target, on one logarithmic axis, with what a naive program gets. Methods that
//! were measured in the same way share a row.

use std::error::Error;

use gauss_charts::drawing::{Area, COLOURS, INK, PALE, text_style};
use gauss_charts::panels::power_of_ten;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::report::{Results, figure};
use crate::suite::{Measure, Verdict};

const WIDTH: u32 = 1600;
/// Heights of the head, of a row and of what is below.
const HEAD: i32 = 270;
const ROW: i32 = 46;
const FOOT: i32 = 100;
/// Height of the keys.
const KEYS: i32 = 202;
/// What one has to know to read it.
const EXPLANATION: [&str; 3] = [
    "Each row is a scene that programs for rigid bodies get wrong, and an error that is measured there, mostly beside 30 to 36 digits.",
    "The black line is its target, argued case by case: what rounding and the scene itself leave to any program. Left of it is better.",
    "A cross is what a program gets whose formulas are right, written as textbooks have them: how far right it stands is what it loses.",
];
/// Where the axis begins and ends, and its powers of ten: figure over target.
const AXIS: (i32, i32) = (690, 1320);
const DECADES: (f64, f64) = (-6.0, 12.0);

/// Right ends of the two columns of numbers.
const REACHED: i32 = 1445;
const TARGET: i32 = 1570;

const GREY: RGBColor = RGBColor(110, 110, 110);

/// One row: a case, what was measured, and by which methods.
struct Row<'a> {
    case: &'a str,
    measures: Vec<&'a Measure>,
}

/// Where a ratio is drawn; what is beyond an end stands there, and so does what is no number.
fn place(ratio: f64) -> i32 {
    let decade = if ratio.is_nan() { DECADES.1 } else { ratio.log10().clamp(DECADES.0, DECADES.1) };
    let share = (decade - DECADES.0) / (DECADES.1 - DECADES.0);
    AXIS.0 + (share * f64::from(AXIS.1 - AXIS.0)).round() as i32
}

fn words(size: u32, colour: RGBColor, side: HPos) -> TextStyle<'static> {
    text_style(size, colour).pos(Pos::new(side, VPos::Center))
}

/// Rows in the order of the report. Counts whose target is zero have no ratio: they are in the table.
fn rows<'a>(results: &'a [Results<'a>]) -> Vec<Row<'a>> {
    let mut rows: Vec<Row<'a>> = Vec::new();
    for (case, measures) in results {
        for measure in measures.iter().filter(|measure| measure.target > 0.0) {
            match rows.iter_mut().find(|row| row.case == case.name && row.measures[0].what == measure.what) {
                Some(row) => row.measures.push(measure),
                None => rows.push(Row { case: case.name, measures: vec![measure] }),
            }
        }
    }
    rows
}

/// Draws everything.
pub fn draw(results: &[Results<'_>]) -> Result<String, Box<dyn Error>> {
    let rows = rows(results);
    let bottom = HEAD + ROW * rows.len() as i32;
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, (WIDTH, (bottom + FOOT) as u32)).into_drawing_area();
        root.fill(&WHITE)?;
        root.draw(&Text::new("Hard cases: error divided by its target", (30, 18), text_style(36, INK)))?;
        for (n, line) in EXPLANATION.iter().enumerate() {
            root.draw(&Text::new(*line, (30, 84 + 32 * n as i32), words(23, GREY, HPos::Left)))?;
        }
        let mut x = 40;
        for (text, colour, cross) in [
            ("target reached: a dot for each method of Gauss", COLOURS[0], false),
            ("short of it", COLOURS[1], false),
            ("a naive program", GREY, true),
        ] {
            mark(&root, (x, KEYS), colour, cross)?;
            root.draw(&Text::new(text, (x + 20, KEYS), words(24, INK, HPos::Left)))?;
            x += 70 + 13 * text.chars().count() as i32;
        }
        for (x, text) in [(REACHED, "best"), (TARGET, "target")] {
            root.draw(&Text::new(text, (x, HEAD - 22), words(24, INK, HPos::Right)))?;
        }
        for decade in (DECADES.0 as i32..=DECADES.1 as i32).step_by(3) {
            let x = place(10.0_f64.powi(decade));
            let style = if decade == 0 { INK.stroke_width(3) } else { PALE.stroke_width(2) };
            root.draw(&PathElement::new(vec![(x, HEAD - 4), (x, bottom)], style))?;
            let text = if decade == 0 { "1".into() } else { power_of_ten(f64::from(decade)) };
            root.draw(&Text::new(text, (x, bottom + 20), words(24, INK, HPos::Center)))?;
        }
        let below = "error over target, smaller to the left; what lies beyond an end of the axis stands at the end";
        root.draw(&Text::new(below, (WIDTH as i32 - 30, bottom + 64), words(24, INK, HPos::Right)))?;
        let mut before = "";
        for (n, row) in rows.iter().enumerate() {
            let y = HEAD + ROW * n as i32 + ROW / 2;
            if row.case != before {
                let line = vec![(30, y - ROW / 2), (TARGET, y - ROW / 2)];
                root.draw(&PathElement::new(line, PALE.stroke_width(1)))?;
                root.draw(&Text::new(row.case.replace('_', " "), (30, y), words(24, INK, HPos::Left)))?;
                before = row.case;
            }
            draw_row(&root, row, y)?;
        }
        root.present()?;
    }
    Ok(svg)
}

fn draw_row(root: &Area<'_>, row: &Row<'_>, y: i32) -> Result<(), Box<dyn Error>> {
    let first = row.measures[0];
    root.draw(&Text::new(first.what.clone(), (225, y), words(22, INK, HPos::Left)))?;
    let ratios = row.measures.iter().map(|m| (place(m.reached / m.target), m.verdict()));
    let dots: Vec<(i32, Verdict)> = ratios.collect();
    let mut ends: Vec<i32> = dots.iter().map(|dot| dot.0).collect();
    if let Some((_, naive)) = &first.naive {
        ends.push(place(naive / first.target));
    }
    let (least, most) = ends.iter().fold((i32::MAX, i32::MIN), |(a, b), &x| (a.min(x), b.max(x)));
    root.draw(&PathElement::new(vec![(least, y), (most, y)], PALE.stroke_width(5)))?;
    if let Some((_, naive)) = &first.naive {
        // Beside a dot, not on it.
        let x = place(naive / first.target);
        let hidden = dots.iter().any(|dot| (dot.0 - x).abs() < 14);
        mark(root, (if hidden { x + 22 } else { x }, y), GREY, true)?;
    }
    for (x, verdict) in dots {
        let colour = if verdict == Verdict::Pass { COLOURS[0] } else { COLOURS[1] };
        mark(root, (x, y), colour, false)?;
    }
    let best = row.measures.iter().fold(f64::INFINITY, |best, m| best.min(m.reached));
    let colour = if best <= first.target { INK } else { COLOURS[1] };
    root.draw(&Text::new(figure(best), (REACHED, y), words(24, colour, HPos::Right)))?;
    root.draw(&Text::new(figure(first.target), (TARGET, y), words(24, INK, HPos::Right)))?;
    Ok(())
}

/// A dot, or a cross.
fn mark(area: &Area<'_>, at: (i32, i32), colour: RGBColor, cross: bool) -> Result<(), Box<dyn Error>> {
    if cross {
        area.draw(&Cross::new(at, 8, colour.stroke_width(4)))?;
    } else {
        area.draw(&Circle::new(at, 10, colour.filled()))?;
        area.draw(&Circle::new(at, 10, WHITE.stroke_width(2)))?;
    }
    Ok(())
}
