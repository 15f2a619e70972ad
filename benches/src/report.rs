//! The tables of a run.

use std::fmt::Write as _;

use crate::cases::Case;
use crate::measure::{Spread, Times};
use crate::peers::peer;

/// Peers that interpret a model while they run; all others generate code for one scene: from accelerations that a
/// person derived if their names say so, otherwise from what the person describes.
const SIMULATORS: [&str; 3] = ["pinocchio", "mujoco", "mujoco minimal"];

/// A scene that was timed.
pub struct Row {
    /// The scene.
    pub case: Case,
    /// In the order of its ways.
    pub times: Times,
}

impl Row {
    /// Index of the way of this name, without the compiler.
    fn way(&self, name: &str) -> Option<usize> {
        self.case.ways.iter().position(|way| peer(&way.name) == name)
    }

    fn ratio(&self, name: &str) -> Option<f64> {
        Some(self.times.ratios[self.way(name)?].median)
    }

    /// S5′ is S5 once more, arms and robots are of another size: they are not in means.
    fn counts(&self) -> bool {
        ["S1", "S2", "S3", "S4", "S5", "S6"].contains(&self.case.name)
    }
}

fn absolute(spread: &Spread) -> String {
    format!("{:.1} ({:.1}–{:.1})", spread.median, spread.lower, spread.upper)
}

fn ratio(spread: &Spread) -> String {
    format!("{:.3} ({:.3}–{:.3})", spread.median, spread.lower, spread.upper)
}

fn geometric_mean(ratios: impl Iterator<Item = f64>) -> Option<f64> {
    let logarithms: Vec<f64> = ratios.map(f64::ln).collect();
    (!logarithms.is_empty()).then(|| (logarithms.iter().sum::<f64>() / logarithms.len() as f64).exp())
}

/// The geometric mean of generated / `name` over the scenes of S1–S6 that have both.
pub fn mean(rows: &[Row], name: &str) -> Option<f64> {
    geometric_mean(rows.iter().filter(|row| row.counts()).filter_map(|row| row.ratio(name)))
}

/// In Markdown: medians, in parentheses the middle half.
pub fn table(rows: &[Row]) -> String {
    let mut text = String::from(
        "| scene | operations | generated, ns | by hand, ns | with matrices, ns | generated / by hand | \
         generated / with matrices |\n|---|---|---|---|---|---|---|\n",
    );
    for row in rows {
        let Row { case, times } = row;
        let cell = |name: &str| row.way(name).map_or("–".into(), |k| absolute(&times.absolute[k]));
        let quotient = |name: &str| row.way(name).map_or("–".into(), |k| ratio(&times.ratios[k]));
        let _ = writeln!(
            text,
            "| {} {} | {} | {} | {} | {} | {} | {} |",
            case.name,
            case.what,
            case.operations,
            absolute(&times.absolute[0]),
            cell("by hand"),
            cell("with matrices"),
            quotient("by hand"),
            quotient("with matrices"),
        );
    }
    if let Some(mean) = mean(rows, "by hand") {
        let _ = writeln!(text, "\nGeometric mean of generated / by hand over S1–S6: {mean:.3}.");
    }
    text + &peers(rows)
}

/// Who else was timed, in the order of the first scene that has them.
fn names(rows: &[Row]) -> Vec<String> {
    let mut names = Vec::new();
    for way in rows.iter().flat_map(|row| &row.case.ways) {
        let name = peer(&way.name);
        if !["generated", "by hand", "with matrices"].contains(&name) && !names.iter().any(|n| n == name) {
            names.push(name.to_owned());
        }
    }
    names
}

/// One line a peer: ns, generated / peer, and the compiler that was faster; nothing if there are no peers.
fn peers(rows: &[Row]) -> String {
    let names = names(rows);
    if names.is_empty() {
        return String::new();
    }
    let line = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
    let scenes = rows.iter().map(|row| row.case.name.to_owned());
    let head: Vec<String> = ["ns (generated / peer), compiler".into()].into_iter().chain(scenes).collect();
    let mut text = String::from("\n") + &line([head, vec!["mean over S1–S6".into()]].concat());
    text += &format!("|{}\n", "---|".repeat(rows.len() + 2));
    let ours = rows.iter().map(|row| format!("{:.1}", row.times.absolute[0].median));
    text += &line(["generated".into()].into_iter().chain(ours).chain(["1".into()]).collect());
    let of_mean = |mean: Option<f64>| mean.map_or("–".into(), |mean| format!("{mean:.3}"));
    for name in &names {
        let cell = |row: &Row| {
            row.way(name).map_or("–".into(), |k| {
                let compiler = row.case.ways[k].name[name.len()..].trim_matches([' ', '(', ')']);
                format!("{:.1} ({:.3}) {compiler}", row.times.absolute[k].median, row.times.ratios[k].median)
            })
        };
        let cells = [name.clone()].into_iter().chain(rows.iter().map(cell)).chain([of_mean(mean(rows, name))]);
        text += &line(cells.collect());
    }
    for (name, given) in [("best that derives", false), ("best with accelerations derived by hand", true)] {
        let generators: Vec<&String> =
            names.iter().filter(|n| n.ends_with("by hand") == given && !SIMULATORS.contains(&n.as_str())).collect();
        let best = |row: &Row| generators.iter().filter_map(|name| row.ratio(name)).max_by(f64::total_cmp);
        let cells = rows.iter().map(|row| best(row).map_or("–".into(), |ratio| format!("({ratio:.3})")));
        let mean = geometric_mean(rows.iter().filter(|row| row.counts()).filter_map(best));
        text += &line([name.into()].into_iter().chain(cells).chain([of_mean(mean)]).collect());
    }
    text
}
