//! The picture: heights of the ball, speed and friction of the block, the path of the billiard ball.

use std::error::Error;

use gauss_charts::drawing::{COLOURS, INK};
use gauss_contact::{ContactError, ContactTrajectory};
use gauss_examples::plots::{Line, Plot, sheet};

use crate::scenes::{BallKernel, BeltKernel, BilliardKernel};

/// Draws all panels.
///
/// # Errors
/// When a panel cannot be laid out, or a run does not cover its times.
pub fn draw(
    ball: &ContactTrajectory<'_, BallKernel>,
    block: &ContactTrajectory<'_, BeltKernel>,
    shot: &ContactTrajectory<'_, BilliardKernel>,
) -> Result<String, Box<dyn Error>> {
    let title = "Contact, friction and impacts from event to event";
    let panels = [vec![heights(ball)?, path(shot)?], vec![speeds(block)?, frictions(block)?]];
    sheet(title, (1600, 1300), &panels)
}

/// A curve over the times of a run.
fn curve(
    times: (f64, usize),
    value: impl Fn(f64) -> Result<f64, ContactError>,
) -> Result<Vec<(f64, f64)>, ContactError> {
    let (end, count) = times;
    (0..=count).map(|n| end * n as f64 / count as f64).map(|t| Ok((t, value(t)?))).collect()
}

fn heights(run: &ContactTrajectory<'_, BallKernel>) -> Result<Plot<'static>, Box<dyn Error>> {
    let points = curve((10.0, 4000), |t| Ok(run.at(t)?.q[0]))?;
    let end = 8.578_949_178_728_9;
    let lines = vec![
        Line::new("height", COLOURS[0], points).wide(3),
        Line::new("where impacts pile up", COLOURS[1], [(end, 0.0), (end, 1.0)]).dashed().wide(3),
    ];
    Ok(Plot::new("A ball that keeps 0.9 of its speed", ("t, s", 0.0..10.0), ("height, m", 0.0..1.05), lines))
}

fn path(run: &ContactTrajectory<'_, BilliardKernel>) -> Result<Plot<'static>, Box<dyn Error>> {
    let rolls = run.events().iter().map(|event| event.time).fold(0.0, f64::max);
    let at = |t: f64| run.at(t).map(|s| (s.q.translation.x, s.q.translation.y));
    let part = |from: f64, to: f64| -> Result<Vec<(f64, f64)>, ContactError> {
        (0..=200).map(|n| at((from + (to - from) * f64::from(n) / 200.0).min(to))).collect()
    };
    let lines =
        vec![Line::new("sliding", COLOURS[1], part(0.0, rolls)?), Line::new("rolling", COLOURS[0], part(rolls, 1.5)?)];
    let (x, y) = at(1.5)?;
    let (low, high) = (y.min(0.0) - 0.1, y.max(0.0) + 0.1);
    Ok(Plot::new("A billiard ball with side spin", ("x, m", 0.0..x + 0.1), ("y, m", low..high), lines).to_scale())
}

fn speeds(run: &ContactTrajectory<'_, BeltKernel>) -> Result<Plot<'static>, Box<dyn Error>> {
    let lines = vec![
        Line::new("belt", INK, [(0.0, 0.3), (12.0, 0.3)]).dashed().wide(3),
        Line::new("block", COLOURS[0], curve((12.0, 4000), |t| Ok(run.at(t)?.z[0]))?),
    ];
    Ok(Plot::new("A block on a belt sticks and slips", ("t, s", 0.0..12.0), ("speed, m/s", -0.8..0.6), lines))
}

fn frictions(run: &ContactTrajectory<'_, BeltKernel>) -> Result<Plot<'static>, Box<dyn Error>> {
    let lines = vec![
        Line::new("bound, held", INK, [(0.0, 0.5 * 9.81), (12.0, 0.5 * 9.81)]).dashed().wide(3),
        Line::new("friction", COLOURS[1], curve((12.0, 4000), |t| Ok(run.forces(t)?[1]))?),
    ];
    Ok(Plot::new("Its friction", ("t, s", 0.0..12.0), ("force, N", 0.0..5.5), lines))
}
