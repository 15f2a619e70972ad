//! The picture for the README: six scenes, the best of Gauss against what a user would otherwise do.

use crate::measure::comparison::Verdict;
use crate::measure::entry::Side;
use crate::measure::study::{Point, Study};

use super::chart::{Axis, Chart, Series, picture, words};
use super::machine::Machine;
use super::plots::{OURS, baseline_style, methods, time_axis};

/// The scenes shown, where they were run.
const SHOWN: [&str; 6] =
    ["hlw_free_body", "hlw_heavy_top", "bruls_heavy_top", "trajectory_c", "rolling_disk_falling", "double_pendulum"];
const PANEL: (f64, f64) = (520.0, 470.0);
const LETTERS: f64 = 21.0;
const HEAD: f64 = 128.0;
/// Runs that are farther off, rad or parts of the size, answer no question.
const FARTHEST: f64 = 0.3;

/// The picture, 1600 px wide.
pub fn overview(studies: &[Study], machine: &Machine) -> String {
    let named = SHOWN.iter().filter_map(|name| studies.iter().find(|study| study.scene.about.name == *name));
    let mut shown: Vec<&Study> = named.collect();
    let others = studies.iter().filter(|study| !SHOWN.contains(&study.scene.about.name));
    shown.extend(others.take(6 - shown.len()));

    let mut svg =
        words("Time against error: Gauss and what one would otherwise do", (40.0, 46.0), 33.0, "start", "#2d2d2d");
    let mut x = 44.0;
    let legend = std::iter::once(("Gauss, best of its methods", OURS)).chain(
        [
            ("DOP853 of ode_solvers", "DOP853, ode_solvers"),
            ("DOP853 of differential-equations", "DOP853, differential-equations"),
            ("RK 4 on quaternions", "RK 4"),
            ("semi-implicit Euler", "game engine"),
        ]
        .map(|(method, name)| (name, baseline_style(method))),
    );
    for (name, style) in legend {
        svg += &style.sample((x, 88.0), 46.0);
        svg += &words(name, (x + 56.0, 95.0), LETTERS, "start", "#2d2d2d");
        x += 86.0 + 0.575 * LETTERS * name.chars().count() as f64;
    }
    for (n, study) in shown.iter().enumerate() {
        let corner = (12.0 + (n % 3) as f64 * (PANEL.0 + 8.0), HEAD + (n / 3) as f64 * PANEL.1);
        svg += &panel(study).body(corner);
    }
    let rows = shown.len().div_ceil(3) as f64;
    let height = HEAD + rows * PANEL.1 + 44.0;
    let Machine { processor, compiler, instructions, .. } = machine;
    let compiler = compiler.split(" (").next().unwrap_or_default();
    let foot = format!(
        "One thread of {processor}, {compiler}, compiled for {instructions}; the same for all. Errors below {FARTHEST}."
    );
    svg += &words(&foot, (40.0, height - 16.0), 18.0, "start", "#6a6a6a");
    picture((1600.0, height), &svg)
}

fn panel(study: &Study) -> Chart {
    let points = |points: Vec<Point>| {
        let shown = points.iter().filter(|point| point.error < FARTHEST);
        shown.map(|point| (point.error, point.median())).collect()
    };
    let mut series: Vec<Series> = methods(study, Side::Baseline)
        .into_iter()
        .map(|method| Series {
            name: method.into(),
            style: baseline_style(method),
            points: points(study.front(|entry| entry.method == method)),
        })
        .collect();
    let ours = points(study.front(|entry| entry.side == Side::Gauss));
    series.push(Series { name: String::new(), style: OURS, points: ours });
    let gains: Vec<String> = [(1e-4, "10⁻⁴"), (1e-8, "10⁻⁸"), (1e-11, "10⁻¹¹")]
        .into_iter()
        .filter_map(|(error, name)| match study.pair(error).verdict() {
            // Two digits: three such gains fit above a panel.
            Verdict::Gain(gain) if gain >= 9.95 => Some(format!("{gain:.0}× at {name}")),
            Verdict::Gain(gain) => Some(format!("{gain:.1}× at {name}")),
            _ => None,
        })
        .collect();
    let y = time_axis(&series);
    Chart {
        title: study.scene.about.title.split(" (").next().unwrap_or_default().into(),
        subtitle: gains.join(", "),
        x: Axis { label: "error at the end (smaller to the right)".into(), ends: 0.0..-16.0, decades: true },
        y: Axis { label: "µs per simulated second".into(), ..y },
        series,
        size: PANEL,
        letters: LETTERS,
    }
}
