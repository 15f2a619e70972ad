//! The table of a run.

use std::fmt::Write as _;

use crate::cases::Case;
use crate::measure::{Spread, Times};

/// A scene that was timed.
pub struct Row {
    /// The scene.
    pub case: Case,
    /// Generated, by hand, with matrices.
    pub times: Times,
}

fn absolute(spread: &Spread) -> String {
    format!("{:.1} ({:.1}–{:.1})", spread.median, spread.lower, spread.upper)
}

fn ratio(spread: &Spread) -> String {
    format!("{:.3} ({:.3}–{:.3})", spread.median, spread.lower, spread.upper)
}

/// The geometric mean of the ratios to hand-written code; S5′ is S5 once more, and not in it.
pub fn mean(rows: &[Row]) -> Option<f64> {
    let ratios: Vec<f64> = rows
        .iter()
        .filter(|r| !r.case.differences.is_empty() && !r.case.name.ends_with('′'))
        .map(|r| r.times.ratios[1].median)
        .collect();
    let logarithms: f64 = ratios.iter().map(|r| r.ln()).sum();
    (!ratios.is_empty()).then(|| (logarithms / ratios.len() as f64).exp())
}

/// In Markdown: medians, in parentheses the middle half.
pub fn table(rows: &[Row]) -> String {
    let mut text = String::from(
        "| scene | operations | generated, ns | by hand, ns | with matrices, ns | generated / by hand | \
         generated / with matrices |\n|---|---|---|---|---|---|---|\n",
    );
    for Row { case, times } in rows {
        let compared = !case.differences.is_empty();
        let cell = |k: usize| if compared { absolute(&times.absolute[k]) } else { "–".into() };
        let quotient = |k: usize| if compared { ratio(&times.ratios[k]) } else { "–".into() };
        let _ = writeln!(
            text,
            "| {} {} | {} | {} | {} | {} | {} | {} |",
            case.name,
            case.what,
            case.operations,
            absolute(&times.absolute[0]),
            cell(1),
            cell(2),
            quotient(1),
            quotient(2),
        );
    }
    if let Some(mean) = mean(rows) {
        let _ = writeln!(text, "\nGeometric mean of generated / by hand over S1–S6: {mean:.3}.");
    }
    text
}
