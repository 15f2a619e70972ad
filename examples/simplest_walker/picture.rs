//! The picture: steps as sticks, angles over time, how deviations shrink, multipliers of both gaits over the slope.

use std::error::Error;

use gauss_charts::drawing::{COLOURS, INK, PALE};
use gauss_examples::plots::{Line, Plot, sheet};

use crate::model::{FOOT, Gait, LONG, SHORT, walk};

/// Draws all panels.
///
/// # Errors
/// When a gait is not found, or a panel cannot be laid out.
pub fn draw(long: &Gait) -> Result<String, Box<dyn Error>> {
    let title = "The simplest walker: a hip, two legs, a slope of 0.009";
    let steps = steps(long, 3)?;
    sheet(title, (1600, 1300), &[vec![sticks(&steps), angles(&steps)], vec![deviations(long)?, multipliers()?]])
}

/// Of a step: where its foot stands along the slope; times, places of the hip and angles of the legs.
struct Step {
    foot: f64,
    states: Vec<(f64, [f64; 4])>,
}

fn steps(gait: &Gait, count: usize) -> Result<Vec<Step>, Box<dyn Error>> {
    let (mut start, mut foot, mut time, mut made) = (gait.start, 0.0, 0.0, Vec::new());
    for _ in 0..count {
        let mut states = Vec::new();
        start = walk(FOOT, 0.009, start, |s| states.push((time + s.t, s.q.into())), 1)?;
        // The last sample is that behind the heel strike, of the next foot.
        states.pop();
        time = states.last().map_or(time, |(t, _)| *t);
        made.push(Step { foot, states });
        foot += 2.0 * start[0].sin();
    }
    Ok(made)
}

fn sticks(steps: &[Step]) -> Plot<'static> {
    let mut lines = vec![Line::new("", INK, [(-0.6, 0.0), (1.4, 0.0)]).wide(3)];
    for (n, step) in steps.iter().enumerate() {
        let (stance, swing) = [(COLOURS[0], COLOURS[1]), (COLOURS[1], COLOURS[0])][n % 2];
        let (first, last) = (step.states[0].0, step.states[step.states.len() - 1].0);
        let mut next = first;
        for (t, [x, y, _, angle]) in &step.states {
            if *t >= next || *t == last {
                let hip = (step.foot + x, *y);
                lines.push(Line::new("", swing, [hip, (hip.0 + angle.sin(), hip.1 - angle.cos())]).wide(2));
                lines.push(Line::new("", stance, [hip, (step.foot, 0.0)]).wide(3));
                next += (last - first) / 8.0;
            }
        }
    }
    let hips = steps.iter().flat_map(|step| step.states.iter().map(|(_, q)| (step.foot + q[0], q[1])));
    lines.push(Line::new("", INK, hips).wide(4));
    Plot::new("Three steps, the slope drawn level", ("along the slope, l", -0.6..1.4), ("l", -0.1..1.2), lines)
        .to_scale()
}

fn angles(steps: &[Step]) -> Plot<'static> {
    let end = steps.iter().flat_map(|step| &step.states).map(|(t, _)| *t).fold(0.0, f64::max);
    let mut lines = vec![Line::new("", PALE, [(0.0, 0.0), (end, 0.0)]).wide(3)];
    for (n, step) in steps.iter().enumerate() {
        let of = |k: usize| step.states.iter().map(move |(t, q)| (*t, q[k]));
        for (name, k) in [("left leg", 2 + n % 2), ("right leg", 3 - n % 2)] {
            lines.push(Line::new(if n == 0 { name } else { "" }, COLOURS[usize::from(name == "right leg")], of(k)));
        }
    }
    Plot::new("Legs change at each heel strike", ("t √(g/l)", 0.0..end), ("angle, rad", -0.4..0.4), lines)
}

/// A start that is off, step by step, and |m|ⁿ.
fn deviations(gait: &Gait) -> Result<Plot<'static>, Box<dyn Error>> {
    let off = |start: [f64; 2]| f64::hypot(start[0] - gait.start[0], start[1] - gait.start[1]);
    let mut start = [gait.start[0] + 1e-3, gait.start[1]];
    let mut points = vec![(0.0, off(start).log10())];
    for n in 1..=30 {
        start = walk(FOOT, 0.009, start, |_| {}, 1)?;
        points.push((f64::from(n), off(start).log10()));
    }
    let rate = gait.multipliers()[0].norm().log10();
    let lines = vec![
        Line::new("a start that is off", COLOURS[0], points),
        Line::new("|multiplier|ⁿ", INK, [(0.0, -2.3), (30.0, 30.0 * rate - 2.3)]).dashed().wide(3),
    ];
    Ok(Plot::new("The long gait is stable", ("step", 0.0..30.0), ("log₁₀ of the deviation", -10.0..-2.0), lines))
}

/// The larger multiplier of either gait over the slope, each gait from the one before.
fn multipliers() -> Result<Plot<'static>, Box<dyn Error>> {
    let branch = |guess: [f64; 2]| -> Result<Vec<(f64, f64)>, Box<dyn Error>> {
        let mut points = Vec::new();
        for (from, to) in [(18, 1), (18, 38)] {
            let mut start = guess;
            for n in if from > to { (to..=from).rev().collect::<Vec<_>>() } else { (from..=to).collect() } {
                let slope = 0.0005 * f64::from(n);
                let gait = Gait::find(FOOT, slope, start)?;
                // Gaits grow like the third root of the slope.
                let next = if from > to { slope - 0.0005 } else { slope + 0.0005 };
                start = gait.start.map(|x| x * (next / slope).cbrt());
                points.push((slope, gait.multipliers().map(|m| m.norm()).into_iter().fold(0.0, f64::max)));
            }
        }
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        Ok(points)
    };
    let lines = vec![
        Line::new("long gait", COLOURS[0], branch(LONG)?),
        Line::new("short gait", COLOURS[1], branch(SHORT)?),
        Line::new("walks on below", INK, [(0.0, 1.0), (0.019, 1.0)]).dashed().wide(3),
    ];
    Ok(Plot::new("Both gaits over the slope", ("slope, rad", 0.0..0.019), ("larger |multiplier|", 0.0..5.5), lines))
}
