//! The picture: where the trunk goes after a push, which feet are on the ground, where it ends after others.

use std::error::Error;

use gauss_charts::drawing::{COLOURS, INK, PALE};
use gauss_contact::Mode;
use gauss_examples::plots::{Cell, Line, Plot, sheet};

use crate::gait::{Gait, PUSHED, Pushed};
use crate::robot::{Place, STEP};

const WAYS: [&str; 3] = ["torques alone", "springs", "gains"];

/// Draws all panels: the gait, runs with the push that is shown, and distances at the end by push.
///
/// # Errors
/// When a panel cannot be laid out.
pub fn draw(gait: &Gait, push: f64, runs: &[Pushed; 3], rows: &[(f64, [f64; 3])]) -> Result<String, Box<dyn Error>> {
    let title = format!("ANYmal trots and is pushed sideways by {push} m/s");
    let sideways =
        over_time(gait, runs, ("Sideways", "place of the trunk, cm", -6.0..16.0), |q| 100.0 * q.0.translation.y);
    let height = over_time(gait, runs, ("Height", "of the trunk, cm", 44.0..56.0), |q| 100.0 * q.0.translation.z);
    sheet(&title, (1600, 1200), &[vec![sideways, height], vec![feet(gait, &runs[2]), ends(rows)]])
}

fn over_time(
    gait: &Gait,
    runs: &[Pushed; 3],
    (title, name, range): (&'static str, &'static str, std::ops::Range<f64>),
    of: impl Fn(&Place) -> f64,
) -> Plot<'static> {
    let mut lines = vec![Line::new("", PALE, [(PUSHED, range.start), (PUSHED, range.end)]).wide(3)];
    for (k, run) in runs.iter().enumerate() {
        let points = run.states.iter().enumerate().map(|(n, (q, _))| (n as f64 * STEP, of(q)));
        let shown = points.take_while(|(_, value)| range.contains(value)).collect::<Vec<_>>();
        lines.push(Line::new(WAYS[k], COLOURS[[1, 3, 0][k]], shown));
    }
    let nominal = gait.states.iter().enumerate().map(|(n, (q, _))| (n as f64 * STEP, of(q)));
    lines.push(Line::new("the gait", INK, nominal).dashed().wide(2));
    Plot::new(title, ("time, s", 0.0..gait.end()), (name, range), lines)
}

/// Feet on the ground: of the gait below, with gains above.
fn feet(gait: &Gait, run: &Pushed) -> Plot<'static> {
    let mut cells: Vec<Cell> = Vec::new();
    for foot in 0..4 {
        let base = 4.0 - foot as f64;
        for (modes, low, high, colour) in
            [(&gait.feet, base - 0.4, base, PALE), (&run.feet, base, base + 0.3, COLOURS[0])]
        {
            let closed: Vec<bool> = modes.iter().map(|(modes, _)| modes[foot] != Mode::Open).collect();
            let mut from = None;
            for n in 0..=closed.len() {
                let stands = closed.get(n).is_some_and(|closed| *closed);
                match (from, stands) {
                    (None, true) => from = Some(n),
                    (Some(first), false) => {
                        let time = |n: usize| n as f64 * STEP;
                        cells.push(([(time(first), low), (time(n), high)], colour));
                        from = None;
                    }
                    _ => {}
                }
            }
        }
    }
    let push = Line::new("", PALE, [(PUSHED, 0.4), (PUSHED, 4.6)]).wide(3);
    let lines = vec![push, Line::new("with gains", COLOURS[0], []).wide(8), Line::new("the gait", PALE, []).wide(8)];
    let name = "4 LF, 3 LH, 2 RF, 1 RH";
    Plot::new("Feet on the ground", ("time, s", 0.0..gait.end()), (name, 0.4..4.6), lines).with_cells(cells)
}

/// How far from the gait the trunk is at the end, by push; falls stand above all.
fn ends(rows: &[(f64, [f64; 3])]) -> Plot<'static> {
    let line = |k: usize| {
        let points = rows.iter().filter(|(push, _)| *push > 0.0);
        // Falls are infinitely far away.
        let points = points.map(|(push, off)| (push.log10(), off[k].log10().clamp(-6.0, 0.5)));
        Line::new(WAYS[k], COLOURS[[1, 3, 0][k]], points)
    };
    let falls = Line::new("", PALE, [(-3.0, 0.5), (0.0, 0.5)]).wide(3);
    Plot::new(
        "Off at the end, by push; falls at the top",
        ("log₁₀ of the push, m/s", -3.0..0.0),
        ("log₁₀ of the distance, m", -6.0..1.0),
        vec![falls, line(0), line(1), line(2)],
    )
}
