//! The picture: angles, height, forces of the lower edge, the cycle of the bird.

use std::error::Error;
use std::ops::Range;

use gauss_charts::drawing::{COLOURS, INK};
use gauss_contact::{ContactError, ContactTrajectory};
use gauss_examples::plots::{Line, Plot, sheet};

use crate::toy::{TOY, WoodpeckerKernel};

type Run<'a> = ContactTrajectory<'a, WoodpeckerKernel>;

/// The times that are shown: two periods.
const SHOWN: Range<f64> = 0.0..0.3;

/// Draws all panels.
///
/// # Errors
/// When a panel cannot be laid out, or a run does not cover its times.
pub fn draw(run: &Run<'_>) -> Result<String, Box<dyn Error>> {
    let panels = [vec![angles(run)?, cycle(run)?], vec![height(run)?, forces(run)?]];
    sheet("A woodpecker toy pecks its way down a pole", (1600, 1300), &panels)
}

fn curve(value: impl Fn(f64) -> Result<f64, ContactError>) -> Result<Vec<(f64, f64)>, ContactError> {
    (0..=4000).map(|n| SHOWN.end * f64::from(n) / 4000.0).map(|t| Ok((t, value(t)?))).collect()
}

fn angles(run: &Run<'_>) -> Result<Plot<'static>, Box<dyn Error>> {
    let pecks = (TOY.lm + TOY.lg - TOY.ls - TOY.r) / TOY.hs;
    let lines = vec![
        Line::new("beak touches", INK, [(SHOWN.start, pecks), (SHOWN.end, pecks)]).dashed().wide(3),
        Line::new("bird", COLOURS[0], curve(|t| Ok(run.at(t)?.q[2]))?),
        Line::new("sleeve", COLOURS[1], curve(|t| Ok(run.at(t)?.q[1]))?),
    ];
    Ok(Plot::new("Sleeve and bird", ("t, s", SHOWN), ("angle, rad", -0.65..0.25), lines))
}

fn height(run: &Run<'_>) -> Result<Plot<'static>, Box<dyn Error>> {
    let lines = vec![Line::new("sleeve", COLOURS[1], curve(|t| Ok(1e3 * run.at(t)?.q[0]))?)];
    Ok(Plot::new("It comes down in jerks", ("t, s", SHOWN), ("height, mm", -40.0..2.0), lines))
}

fn forces(run: &Run<'_>) -> Result<Plot<'static>, Box<dyn Error>> {
    let lines = vec![
        Line::new("μ times the normal force", INK, curve(|t| Ok(TOY.mu * run.forces(t)?[2]))?).dashed().wide(3),
        Line::new("friction", COLOURS[0], curve(|t| Ok(run.forces(t)?[3]))?),
    ];
    Ok(Plot::new("The lower edge slides and sticks", ("t, s", SHOWN), ("force, N", -0.05..0.2), lines))
}

fn cycle(run: &Run<'_>) -> Result<Plot<'static>, Box<dyn Error>> {
    let states = curve(|t| Ok(run.at(t)?.q[2]))?.into_iter().zip(curve(|t| Ok(run.at(t)?.z[2]))?);
    let points = states.map(|((_, angle), (_, rate))| (angle, rate));
    let lines = vec![Line::new("bird", COLOURS[0], points).wide(3)];
    Ok(Plot::new("Its cycle", ("angle, rad", -0.65..0.25), ("rate, rad/s", -20.0..25.0), lines))
}
