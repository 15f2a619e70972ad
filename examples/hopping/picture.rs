//! The picture: the hip's path with the leg, heights of apices from several starts, a ball's height and energy.

use std::error::Error;

use gauss_charts::drawing::{COLOURS, INK};
use gauss_contact::ContactTrajectory;
use gauss_examples::plots::{Line, Plot, sheet};
use gauss_playback::{Playback, Shape, Touch};
use gauss_runtime::prelude::*;
use gauss_tables::Table;

use crate::model::{BallKernel, Flight, FlightKernel, Moment, Run, Runner, StanceKernel};

/// Steps that the path shows.
const SHOWN: usize = 5;

/// Draws all panels.
///
/// # Errors
/// When a panel cannot be laid out, or a run does not reach its end.
pub fn draw(
    runner: &Runner,
    run: &Run,
    ball: &BallKernel,
    bounces: &ContactTrajectory<'_, BallKernel>,
) -> Result<String, Box<dyn Error>> {
    let title = "A runner whose flights and stances are two kernels, and a ball that bounces";
    sheet(title, (1600, 1300), &[vec![path(run)], vec![apices(runner)?, heights(ball, bounces)?]])
}

fn path(run: &Run) -> Plot<'static> {
    let steps = &run.steps[..SHOWN.min(run.steps.len())];
    let hip = steps.iter().flat_map(|step| &step.path).map(|(_, [x, y], _)| (*x, *y));
    let end = steps.last().and_then(|step| step.path.last()).map_or(1.0, |(_, [x, _], _)| *x);
    let mut lines = vec![Line::new("", INK, [(0.0, 0.0), (end, 0.0)]).wide(2)];
    for step in steps {
        // The leg at touchdown, when it is shortest, and at lift-off.
        let on_ground = step.path.iter().filter(|(t, ..)| (step.touchdown.0..step.liftoff.0).contains(t));
        let length = |(_, [x, y], _): &(f64, [f64; 2], [f64; 2])| f64::hypot(x - step.foot, *y);
        let shortest = on_ground.min_by(|a, b| length(a).total_cmp(&length(b))).unwrap_or(&step.touchdown);
        for (name, colour, (_, [x, y], _)) in
            [("", COLOURS[2], step.touchdown), ("", COLOURS[1], *shortest), ("", COLOURS[2], step.liftoff)]
        {
            lines.push(Line::new(name, colour, [(step.foot, 0.0), (x, y)]).wide(3));
        }
    }
    lines.push(Line::new("hip", COLOURS[0], hip).wide(5));
    lines.push(Line::new("leg at touchdown and lift-off", COLOURS[2], []));
    lines.push(Line::new("leg when it is shortest", COLOURS[1], []));
    Plot::new("Five steps at 5 m/s", ("way, m", 0.0..end), ("height, m", 0.0..1.3), lines).to_scale()
}

fn apices(runner: &Runner) -> Result<Plot<'static>, Box<dyn Error>> {
    // Starts of one energy: what is higher is slower.
    let energy = 0.5 * 25.0 + runner.g;
    let mut lines = Vec::new();
    for (colour, height) in [(COLOURS[1], 0.96_f64), (COLOURS[0], 1.0), (COLOURS[2], 1.06), (INK, 1.12)] {
        let run = runner.run(height, (2.0 * (energy - runner.g * height)).sqrt(), 9)?;
        let points = run.steps.iter().enumerate().map(|(n, step)| (n as f64, step.apex.1[1]));
        lines.push(Line::new(format!("{height} m"), colour, points));
    }
    Ok(Plot::new("Heights of apices from several starts", ("step", 0.0..8.0), ("m", 0.9..1.2), lines))
}

fn heights(ball: &BallKernel, bounces: &ContactTrajectory<'_, BallKernel>) -> Result<Plot<'static>, Box<dyn Error>> {
    let end = 3.0;
    let table = Table::new(bounces.at_times((0..=600).map(|n| end * (f64::from(n) / 600.0)))?);
    let table = table.column("height", |s| s.q[0]).energies(ball);
    let column = |name: &str| -> Vec<(f64, f64)> {
        let (times, values) = (table.get("t").unwrap_or_default(), table.get(name).unwrap_or_default());
        times.iter().copied().zip(values.iter().copied()).collect()
    };
    Ok(Plot::new(
        "A ball that keeps 0.7 of its speed",
        ("time, s", 0.0..end),
        ("m, and J", 0.0..1.1),
        vec![
            Line::new("height", COLOURS[0], column("height")),
            Line::new("energy", COLOURS[1], column("energy")).wide(3),
        ],
    ))
}

/// The runner as a page: the hip, the leg, and its force where it stands.
///
/// # Errors
/// When the numbers make no runner.
pub fn page(runner: &Runner, run: &Run) -> Result<Playback<FlightKernel>, ParameterError> {
    let flight = Flight { m: runner.m, g: runner.g }.kernel()?;
    let steps = &run.steps[..SHOWN.min(run.steps.len())];
    let stances: Vec<StanceKernel> =
        steps.iter().map(|step| runner.stance(step.foot).kernel()).collect::<Result<_, _>>()?;
    let sample = |&(t, q, z): &Moment| {
        let (q, z) = (q.into(), z.into());
        Sample { t, q, z, p: flight.momentum(t, &q, &z) }
    };
    // Flights and stances share their ends.
    let mut path: Vec<Sample<FlightKernel>> = steps.iter().flat_map(|step| &step.path).map(sample).collect();
    path.dedup_by(|later, before| later.t <= before.t);

    let hip = |s: &Sample<FlightKernel>| Vector3::new(s.q[0], 0.0, s.q[1]);
    let stance = |s: &Sample<FlightKernel>| {
        steps.iter().position(|step| (step.touchdown.0..step.liftoff.0).contains(&s.t)).map(|n| (n, &stances[n]))
    };
    // In the air the leg is held as it will be put down.
    let ahead = Vector3::new(runner.attack.cos(), 0.0, -runner.attack.sin()) * runner.l;
    let foot = |s: &Sample<FlightKernel>| match stance(s) {
        Some((n, _)) => Vector3::new(steps[n].foot, 0.0, 0.0),
        None => hip(s) + ahead,
    };
    // The coordinates are x and height: what acts on them is a force.
    let push = |s: &Sample<FlightKernel>| match stance(s) {
        Some((_, kernel)) => {
            let leg = StanceKernel::ELEMENTS.iter().position(|element| element.name == "leg").unwrap_or(0);
            let force = kernel.element_forces(s.t, &s.q, &s.z, &()).column(leg).into_owned();
            Vector3::new(force[0], 0.0, force[1])
        }
        None => Vector3::zeros(),
    };
    let at = |place: Vector3<f64>| Isometry3::from(Translation3::from(place));
    let spring = |s: &Sample<FlightKernel>| {
        stance(s).map_or(0.0, |(_, kernel)| kernel.potential_energy(s.t, &s.q) - flight.potential_energy(s.t, &s.q))
    };
    let end = path.last().map_or(0.0, |s| s.q[0]);
    let ground = Shape::cuboid([end + 2.0, 0.6, 0.02]).at(&Isometry3::translation(0.5 * end, 0.0, -0.03));
    Ok(Playback::of_samples("A runner on a springy leg", path)
        .si()
        .body("hip", |s| at(hip(s)), [Shape::ball(0.12)])
        .body("foot", |s| at(foot(s)), [Shape::ball(0.04).colour("#444444")])
        .body("ground", |_| Isometry3::identity(), [ground.colour("#bbbbbb")])
        .from_the_side()
        .rod("hip", "foot", 0.012)
        .trace("hip", [0.0; 3])
        .contact("foot", 5e-4, |s| (if stance(s).is_some() { Touch::Sticks } else { Touch::Open }, foot(s), push(s)))
        .arrow("weight", 5e-4, |s| (hip(s), Vector3::new(0.0, 0.0, -runner.m * runner.g)))
        .curve("force of the leg / N", "leg", |s| push(s).norm())
        .curve("energy / J", "kinetic", |s| flight.kinetic_energy(s.t, &s.q, &s.z))
        .curve("energy / J", "of the height", |s| flight.potential_energy(s.t, &s.q))
        .curve("energy / J", "of the leg", spring)
        .curve("energy / J", "sum", |s| flight.energy(s.t, &s.q, &s.z) + spring(s)))
}
