//! Outcomes over speed and slope, how likely it is to tip over, and a page on which one lander does.

use std::error::Error;

use gauss_charts::drawing::{COLOURS, INK};
use gauss_contact::Mode;
use gauss_examples::plots::{Line, Plot, sheet};
use gauss_playback::{Playback, Shape, Touch};
use gauss_runtime::prelude::*;

use crate::lander::{LONGEST, Lander, LanderKernel, OUTCOMES, Outcome, PADS, Run, STEP, touch_down, wilson};

/// m/s: the end of the axis of speeds, and how many parts of it are counted.
const FASTEST: f64 = 3.0;
const PARTS: usize = 10;

/// Each run as a dot, and shares by speed.
///
/// # Errors
/// When a panel cannot be laid out.
pub fn draw(runs: &[Run], bound: f64) -> Result<String, Box<dyn Error>> {
    let colour = |outcome: Outcome| match outcome {
        Outcome::Stands => COLOURS[0],
        Outcome::Slides => COLOURS[2],
        Outcome::Tips => COLOURS[1],
    };
    let dots = runs.iter().map(|(approach, landing)| {
        let (x, y) = (approach.lateral.min(FASTEST), approach.slope.to_degrees());
        ([(x - 0.009, y - 0.065), (x + 0.009, y + 0.065)], colour(landing.outcome))
    });
    let names = OUTCOMES.map(|(outcome, name)| Line::new(name, colour(outcome), [(-1.0, -1.0)]));
    let each = Plot::new(
        "Each run",
        ("speed along the ground / (m/s)", 0.0..FASTEST),
        ("slope / °", 0.0..15.0),
        names.to_vec(),
    );
    let width = FASTEST / PARTS as f64;
    let mut cells = Vec::new();
    let mut lines = Vec::new();
    for part in 0..PARTS {
        let from = part as f64 * width;
        let of: Vec<&Run> = runs.iter().filter(|run| (from..from + width).contains(&run.0.lateral)).collect();
        let over = of.iter().filter(|run| run.1.outcome == Outcome::Tips).count();
        if of.is_empty() {
            continue;
        }
        let (low, high) = wilson(over, of.len());
        cells.push(([(from, 0.0), (from + width, over as f64 / of.len() as f64)], COLOURS[1]));
        let middle = from + 0.5 * width;
        lines.push(Line::new("", INK, [(middle, low.max(0.0)), (middle, high)]).wide(3));
    }
    lines.push(Line::new("95 %", INK, []).wide(3));
    lines.push(Line::new("flat, level, sticking: by energy", COLOURS[0], [(bound, 0.0), (bound, 1.0)]).dashed());
    let shares = Plot::new(
        "Share that tips over",
        ("speed along the ground / (m/s)", 0.0..FASTEST),
        ("share of runs of that speed", 0.0..1.0),
        lines,
    );
    let title = format!("{} touchdowns on slopes up to 15°", runs.len());
    sheet(&title, (1800, 760), &[vec![each.with_cells(dots.collect()), shares.with_cells(cells)]])
}

/// The first run that tips over, or else the first.
///
/// # Errors
/// Where a step is one.
pub fn page(runs: &[Run]) -> Result<Playback<LanderKernel>, Box<dyn Error>> {
    let (approach, _) = runs.iter().find(|run| run.1.outcome == Outcome::Tips).or(runs.first()).ok_or("no run")?;
    let lander = Lander::small(approach.mu, approach.slope);
    let kernel = lander.kernel()?;
    let mut samples = Vec::new();
    let mut contacts = Vec::new();
    touch_down(&kernel, approach.start, (STEP, LONGEST), |stepper| {
        let (t, q, z) = (stepper.time(), *stepper.configuration(), *stepper.speeds());
        samples.push(Sample { t, q, z, p: kernel.momentum(t, &q, &z) });
        contacts.push((stepper.modes().to_vec(), *stepper.impulses()));
    })?;
    let times: Vec<f64> = samples.iter().map(|sample| sample.t).collect();
    let step = |s: &Sample<LanderKernel>| times.partition_point(|t| *t < s.t).min(times.len() - 1);
    let corner = |k: usize| [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]][k].map(|side: f64| side * lander.a);
    let hull = [Shape::cylinder(0.9, 0.9), Shape::ball(0.5).at(&Isometry3::translation(0.0, 0.0, 0.6))];
    let ground = Shape::cuboid([16.0, 16.0, 0.04]).at(&Isometry3::translation(0.0, 0.0, -0.02)).colour("#8d8a83");
    let mut page = Playback::of_samples("A lander that tips over", samples)
        .si()
        .body("hull", |s: &Sample<LanderKernel>| s.q.0, hull)
        .body("ground", |_| Isometry3::identity(), [ground])
        .trace("hull", [0.0; 3])
        .follow("hull");
    for k in 0..PADS {
        let [x, y] = corner(k);
        let foot = move |s: &Sample<LanderKernel>| s.q.0 * Isometry3::translation(x, y, s.q.1[k] - lander.h);
        let strut = [Shape::ball(0.12), Shape::rod([0.0; 3], [-0.55 * x, -0.55 * y, 0.9 * lander.h], 0.05)];
        page = page.body(&format!("foot {}", k + 1), foot, strut);
    }
    for (i, contact) in LanderKernel::CONTACTS.iter().enumerate().take(PADS) {
        page = page.contact(contact.name, 2e-4, |s| {
            let (modes, impulses) = &contacts[step(s)];
            let rows: Vec<f64> = contact.rows().map(|row| impulses[row] / STEP).collect();
            let frame = kernel.contact_frame(i, s.t, &s.q);
            let none = (Touch::Open, s.q.0.translation.vector, Vector3::zeros());
            // A strut at its stop strikes: of such a force the first 15 kN are drawn.
            frame.map_or(none, |frame| (touch(&modes[i]), frame.point, frame.force(&rows).cap_magnitude(1.5e4)))
        });
    }
    Ok(page.curve("struts crushed / m", "the most", |s| s.q.1.max()).energy(&kernel))
}

fn touch(mode: &Mode) -> Touch {
    match mode {
        Mode::Open => Touch::Open,
        Mode::Closed => Touch::Closed,
        Mode::Sticks => Touch::Sticks,
        Mode::Slides(_) => Touch::Slides,
    }
}
