//! The map of the sweep: how often it tips over at each speed and slope, from what there is of the results.

use std::error::Error;
use std::path::Path;

use gauss_charts::drawing::COLOURS;
use gauss_examples::plots::{Plot, sheet, write_into};
use gauss_study::Study;
use plotters::style::RGBColor;

/// The sweep: speeds along the ground up to 3 m/s, slopes up to 15°.
pub const SPEEDS: u32 = 25;
pub const SLOPES: u32 = 16;

/// Runs of a cell: all, those that tip over, those that slide.
type Cell = [u32; 3];

/// Draws `map.svg` and `map.png` into the folder; how many runs are in it.
///
/// # Errors
/// Where the folder holds no such study, or no file can be written.
pub fn draw(study: &Study<'_>, folder: &Path) -> Result<u64, Box<dyn Error>> {
    let results = study.results(folder)?;
    let (runs, outcomes) = (results.numbers("run")?, results.words("outcome")?);
    let mut cells = vec![Cell::default(); (SPEEDS * SLOPES) as usize];
    for (run, outcome) in runs.iter().flatten().zip(&outcomes) {
        let cells_there = cells.len() as u64;
        let cell = &mut cells[(*run as u64 % cells_there) as usize];
        // A run that failed counts as none.
        if let Some(outcome) = outcome {
            cell[0] += 1;
            cell[1] += u32::from(outcome == "tips over");
            cell[2] += u32::from(outcome == "slides");
        }
    }
    let plots =
        vec![plot("Share that tips over", &cells, 1, COLOURS[1]), plot("Share that slides", &cells, 2, COLOURS[2])];
    let title = format!("{} touchdowns: a cell for each speed and slope", outcomes.len());
    write_into(folder, "map", &sheet(&title, (1800, 760), &[plots])?)?;
    Ok(outcomes.len() as u64)
}

fn plot<'a>(title: &'a str, cells: &[Cell], which: usize, colour: RGBColor) -> Plot<'a> {
    let (width, height) = (3.0 / f64::from(SPEEDS - 1), 15.0 / f64::from(SLOPES - 1));
    let filled = cells.iter().enumerate().filter(|(_, cell)| cell[0] > 0).map(|(n, cell)| {
        let (x, y) = (width * (n as u32 % SPEEDS) as f64, height * (n as u32 / SPEEDS) as f64);
        let share = f64::from(cell[which]) / f64::from(cell[0]);
        let corners = [(x - 0.5 * width, y - 0.5 * height), (x + 0.5 * width, y + 0.5 * height)];
        (corners, mixed(colour, share))
    });
    let (x, y) = (-0.5 * width..3.0 + 0.5 * width, -0.5 * height..15.0 + 0.5 * height);
    Plot::new(title, ("speed along the ground / (m/s)", x), ("slope / °", y), Vec::new()).with_cells(filled.collect())
}

/// From a pale grey, which is no white of cells without runs, to a colour.
fn mixed(RGBColor(r, g, b): RGBColor, share: f64) -> RGBColor {
    let part = |colour: u8| (f64::from(colour) * share + 232.0 * (1.0 - share)).round() as u8;
    RGBColor(part(r), part(g), part(b))
}
