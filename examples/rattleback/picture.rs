//! The picture: spins, how far the stone rattles, the friction that it needs, how well two derivations agree.

use std::error::Error;

use gauss_charts::drawing::COLOURS;
use gauss_contact::ContactError;
use gauss_examples::plots::{Line, Plot, sheet};
use gauss_runtime::prelude::*;

use crate::stone::RattlebackKernel;
use crate::table::{OnTableKernel, Run, obliquity, vertical};

type State = Sample<OnTableKernel>;

/// Names of the runs on the table.
const NAMES: [&str; 3] = ["μ = 1", "μ = 0.4", "μ = 0.1"];

/// Draws all panels.
///
/// # Errors
/// When a panel cannot be laid out, or a run does not cover its times.
pub fn draw(rolls: &Trajectory<'_, RattlebackKernel>, runs: [&Run<'_>; 3]) -> Result<String, Box<dyn Error>> {
    let panels = [vec![spins(runs)?, rattling(runs)?], vec![friction(runs)?, agreement(rolls, runs[0])?]];
    sheet("A rattleback spun against its way: rolling by constraints, and on a table", (1600, 1300), &panels)
}

fn curve(value: impl Fn(f64) -> Result<f64, ContactError>) -> Result<Vec<(f64, f64)>, ContactError> {
    (0..=2000).map(|n| f64::from(n) / 400.0).map(|t| Ok((t, value(t)?))).collect()
}

fn of_each(runs: [&Run<'_>; 3], value: impl Fn(&State) -> f64) -> Result<Vec<Line>, ContactError> {
    let named = runs.into_iter().zip(NAMES.into_iter().zip(COLOURS));
    named.map(|(run, (name, colour))| Ok(Line::new(name, colour, curve(|t| Ok(value(&run.at(t)?)))?).wide(3))).collect()
}

fn spins(runs: [&Run<'_>; 3]) -> Result<Plot<'static>, Box<dyn Error>> {
    let lines = of_each(runs, vertical)?;
    Ok(Plot::new("It turns back if friction suffices", ("t, s", 0.0..5.0), ("spin, rad/s", -5.0..6.0), lines))
}

fn rattling(runs: [&Run<'_>; 3]) -> Result<Plot<'static>, Box<dyn Error>> {
    let lines = of_each(runs, |s| (s.q.rotation * Vector3::x()).z.asin().to_degrees())?;
    Ok(Plot::new("How far the long axis is from level", ("t, s", 0.0..5.0), ("angle, °", -4.0..4.0), lines))
}

fn friction(runs: [&Run<'_>; 3]) -> Result<Plot<'static>, Box<dyn Error>> {
    let named = runs.into_iter().zip(NAMES.into_iter().zip(COLOURS));
    let lines = named
        .map(|(run, (name, colour))| Ok(Line::new(name, colour, curve(|t| obliquity(run, t))?).wide(3)))
        .collect::<Result<Vec<_>, ContactError>>()?;
    Ok(Plot::new("Friction over the normal force", ("t, s", 0.0..5.0), ("|λ_T| / λ_N", 0.0..0.9), lines))
}

/// How far the attitudes of two derivations are apart: a constraint of the velocity that touches, with speeds that are
/// solved for; and a closed gap with a slip that sticks.
fn agreement(rolls: &Trajectory<'_, RattlebackKernel>, held: &Run<'_>) -> Result<Plot<'static>, Box<dyn Error>> {
    let points = rolls.iter().skip(1).map(|s| Ok((s.t, held.at(s.t)?.q.rotation.angle_to(&s.q.0).max(1e-16).log10())));
    let points = points.collect::<Result<Vec<_>, ContactError>>()?;
    let lines = vec![Line::new("μ = 1 and constraints", COLOURS[0], points).wide(3)];
    Ok(Plot::new("Two derivations agree", ("t, s", 0.0..5.0), ("log₁₀ of the angle between them", -16.0..-6.0), lines))
}
