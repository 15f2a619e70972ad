//! What is plotted of a scene.

use crate::measure::entry::{Entry, Side};
use crate::measure::study::{Point, Study};

use super::chart::{Axis, Chart, Mark, Series, Style, decades};

const BLUE: &str = "#0072b2";
const SKY: &str = "#56b4e9";
const GREEN: &str = "#009e73";
const ORANGE: &str = "#e69f00";
const RED: &str = "#d55e00";
const BROWN: &str = "#8c564b";
const PINK: &str = "#cc79a7";
const BLACK: &str = "#333333";
const GREY: &str = "#8a8a8a";

const fn style(colour: &'static str, dash: &'static str, mark: Mark) -> Style {
    Style { colour, dash, mark, width: 2.2 }
}

/// The colour of a method says its family, the mark which one it is; baselines are grey and black.
fn style_of(method: &str) -> Style {
    match method {
        "exact free flow" => style(RED, "", Mark::Disc),
        "Moser–Veselov 2" => style(BROWN, "2 3", Mark::Triangle),
        "Moser–Veselov 4" => style(BROWN, "6 3", Mark::Square),
        "Moser–Veselov 6" => style(BROWN, "", Mark::Disc),
        "Moser–Veselov 8" => style(RED, "2 3", Mark::Triangle),
        "Moser–Veselov 10" => style(RED, "6 3", Mark::Square),
        "splitting 2, exact flow" => style(BROWN, "2 3", Mark::Triangle),
        "splitting 4, exact flow" => style(BROWN, "6 3", Mark::Square),
        "splitting 6, exact flow" => style(BROWN, "", Mark::Disc),
        "splitting 8, exact flow" => style(BROWN, "", Mark::Diamond),
        "splitting 2, Moser–Veselov" => style(RED, "2 3", Mark::Triangle),
        "splitting 4, Moser–Veselov" => style(RED, "6 3", Mark::Square),
        "splitting 6, Moser–Veselov" => style(RED, "", Mark::Disc),
        "splitting 8, Moser–Veselov" => style(RED, "", Mark::Diamond),
        "variational" => style(PINK, "2 3", Mark::Triangle),
        "Kahan–Li 6 of variational" => style(PINK, "6 3", Mark::Square),
        "RK 4" => style(ORANGE, "", Mark::Disc),
        "RKMK 4" => style(ORANGE, "2 3", Mark::Triangle),
        "RKMK 8" => style(BLUE, "2 3", Mark::Triangle),
        "CF 4" => style(ORANGE, "6 3", Mark::Square),
        "DP 5(4)" => style(SKY, "", Mark::Disc),
        "DP 5, fixed" => style(SKY, "6 3", Mark::Square),
        "DP 8" => style(BLUE, "", Mark::Disc),
        "DP 8, fixed" => style(BLUE, "6 3", Mark::Square),
        "Verner 9(8)" => style(PINK, "", Mark::Disc),
        "Taylor" => style(PINK, "", Mark::Diamond),
        "Gauss 2" => style(GREEN, "2 3", Mark::Triangle),
        "Gauss 4" => style(GREEN, "6 3", Mark::Square),
        "Gauss 6" => style(GREEN, "", Mark::Disc),
        "Kahan–Li 8 of Gauss 2" => style(PINK, "6 3", Mark::Diamond),
        "DOP853 of ode_solvers" => style(BLACK, "", Mark::Diamond),
        "DOP853 of differential-equations" => style(BLACK, "6 3", Mark::Triangle),
        "RK 4 on quaternions" => style(GREY, "", Mark::Square),
        "semi-implicit Euler" => style(GREY, "2 3", Mark::Triangle),
        _ => style(RED, "2 3", Mark::Diamond),
    }
}

/// Of all methods of Gauss together.
pub const OURS: Style = Style { colour: BLUE, dash: "", mark: Mark::Disc, width: 3.6 };

/// How a baseline looks.
pub fn baseline_style(method: &str) -> Style {
    let style = style_of(method);
    if method.starts_with("DOP853") { Style { colour: RED, ..style } } else { style }
}

/// Names of methods in the order of the entries, each once.
pub fn methods(study: &Study, side: Side) -> Vec<&'static str> {
    let mut names: Vec<&'static str> = Vec::new();
    for entry in study.entries.iter().filter(|entry| entry.side == side) {
        if !names.contains(&entry.method) {
            names.push(entry.method);
        }
    }
    names
}

/// The name of a baseline, where quaternions are none: variables differ from scene to scene.
fn name(method: &'static str, entry: Option<&Entry>) -> String {
    match entry {
        Some(entry) if method.starts_with("RK 4") && !entry.chart.contains("quaternion") => "RK 4 by hand".into(),
        _ => method.into(),
    }
}

fn line(study: &Study, name: String, style: Style, points: &[Point], up: fn(&Point, f64) -> f64) -> Series {
    let duration = study.scene.duration;
    let points = points.iter().map(|point| (point.error, up(point, duration))).collect();
    Series { name, style, points }
}

/// From the least accurate on the left to the most accurate.
fn error_axis() -> Axis {
    Axis { label: "error at the end (more accurate to the right)".into(), ends: 0.0..-16.0, decades: true }
}

/// Time per simulated second.
pub fn time_axis(series: &[Series]) -> Axis {
    let ends = decades(series.iter().flat_map(|series| &series.points).map(|point| point.1));
    Axis { label: "µs per simulated second".into(), ends, decades: true }
}

/// The best of each method over all charts and forms: time against error.
pub fn work_precision(study: &Study) -> Chart {
    chart(study, "Time against error", "each method in its best chart and form", |point, _| point.median())
}

/// The same with evaluations per simulated second.
pub fn evaluations(study: &Study) -> Chart {
    let mut chart = chart(study, "Evaluations against error", "of the same runs", |point, duration| {
        point.evaluations as f64 / duration
    });
    chart.y.label = "evaluations per simulated second".into();
    chart
}

fn chart(study: &Study, title: &str, subtitle: &str, up: fn(&Point, f64) -> f64) -> Chart {
    let mut series = Vec::new();
    for side in [Side::Gauss, Side::Baseline] {
        for method in methods(study, side) {
            let points = study.front(|entry| entry.method == method);
            let entry = study.entries.iter().find(|entry| entry.method == method);
            series.push(line(study, name(method, entry), style_of(method), &points, up));
        }
    }
    let y = time_axis(&series);
    Chart {
        title: title.into(),
        subtitle: subtitle.into(),
        x: error_axis(),
        y,
        series,
        size: (700.0, 470.0),
        letters: 14.0,
    }
}

/// One method in every chart and both forms.
pub fn charts(study: &Study) -> Chart {
    let mut series: Vec<Series> = Vec::new();
    let colours = [BLUE, RED, GREEN, PINK];
    let mut seen: Vec<&'static str> = Vec::new();
    for entry in study.entries.iter().filter(|entry| entry.side == Side::Gauss && entry.method == "DP 8") {
        if !seen.contains(&entry.chart) {
            seen.push(entry.chart);
        }
        let place = seen.iter().position(|chart| *chart == entry.chart).unwrap_or(0);
        let velocity = entry.form == "velocity";
        let (dash, mark) = if velocity { ("", Mark::Disc) } else { ("6 3", Mark::Square) };
        let points = study.front(|e| e.method == entry.method && e.chart == entry.chart && e.form == entry.form);
        let name = format!("{}, {} form", entry.chart, entry.form);
        series.push(line(study, name, style(colours[place % 4], dash, mark), &points, |point, _| point.median()));
    }
    let y = time_axis(&series);
    Chart {
        title: "The same method in every chart".into(),
        subtitle: "Dormand–Prince 8, adaptive".into(),
        x: error_axis(),
        y,
        series,
        size: (700.0, 470.0),
        letters: 14.0,
    }
}

/// Without marks; the method of Runge and Kutta is broken up, because its group variant often lies on the same line.
fn drift_style(method: &str) -> Style {
    let style = Style { mark: Mark::None, ..style_of(method) };
    if method.starts_with("RK 4") { Style { dash: "8 6", ..style } } else { style }
}

/// Energy over a long run.
pub fn drift(study: &Study) -> Option<Chart> {
    let end = study.drifts.iter().flat_map(|drift| drift.line.last()).map(|point| point.0).reduce(f64::max)?;
    let series: Vec<Series> = study
        .drifts
        .iter()
        .map(|drift| Series {
            name: drift.name.clone(),
            style: drift_style(&drift.name),
            // What is exactly constant lies at the bottom.
            points: drift.line.iter().map(|&(t, value)| (t, value.max(1e-17))).collect(),
        })
        .collect();
    Some(Chart {
        title: "Deviation of the energy, relative".into(),
        subtitle: "equal steps of 0.15 rad of the fastest rate; DOP853: tolerance 1e-9".into(),
        x: Axis { label: "time, s".into(), ends: 0.0..end, decades: false },
        y: Axis { label: "|E − E₀| / |E₀|".into(), ends: -17.0..1.0, decades: true },
        series,
        size: (700.0, 470.0),
        letters: 14.0,
    })
}
