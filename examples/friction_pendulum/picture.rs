//! The picture: angle, energy and powers of the pendulum, and the torque of its friction.

use std::error::Error;

use gauss_charts::drawing::{COLOURS, INK};
use gauss_contact::{ContactError, ContactTrajectory};
use gauss_examples::plots::{Line, Plot, sheet};
use gauss_playback::{Playback, Shape};
use gauss_runtime::prelude::*;

use crate::scene::{LENGTH, Pendulum, PendulumFrame, PendulumKernel};

/// Lower end of the axis of powers, W: what the buffer takes is far below it.
const LEAST_POWER: f64 = -0.2;

type Run<'k> = ContactTrajectory<'k, PendulumKernel>;

/// Draws all four panels.
///
/// # Errors
/// When a panel cannot be laid out, or the run does not cover its times.
pub fn draw(pendulum: &Pendulum, kernel: &PendulumKernel, run: &Run<'_>) -> Result<String, Box<dyn Error>> {
    let path: Vec<Sample<PendulumKernel>> = run.iter().collect();
    let end = path[path.len() - 1].t;
    let of_path = |value: &dyn Fn(&Sample<PendulumKernel>) -> f64| -> Vec<(f64, f64)> {
        path.iter().map(|s| (s.t, value(s))).collect()
    };
    let plot = |title, y, ends, lines| Plot::new(title, ("time, s", 0.0..end), (y, ends), lines);

    let buffer = Line::new("buffer", COLOURS[1], [(0.0, pendulum.limit), (end, pendulum.limit)]).dashed();
    let rod = Line::new("rod", COLOURS[0], of_path(&|s| s.q[0]));
    let angle = plot("Angle", "rad", -1.0..2.0, vec![buffer, rod]);

    let energy = |s: &Sample<PendulumKernel>| kernel.energy(s.t, &s.q, &s.z);
    // What friction has taken: friction times way.
    let mut way = 0.0;
    let taken = path.windows(2).map(|pair| {
        way += (pair[1].q[0] - pair[0].q[0]).abs();
        (pair[1].t, energy(&path[0]) - pendulum.dry * way)
    });
    let energies = vec![
        Line::new("kinetic", COLOURS[2], of_path(&|s| kernel.kinetic_energy(s.t, &s.q, &s.z))),
        Line::new("with potential", COLOURS[0], of_path(&energy)).wide(6),
        Line::new("less friction", INK, taken.collect::<Vec<_>>()).dashed().wide(2),
    ];
    let energy = plot("Energy; what friction leaves, the buffer damps", "J", -0.6..0.8, energies);

    let torque: Result<Vec<_>, ContactError> = path.iter().map(|s| Ok((s.t, run.forces(s.t)?[0]))).collect();
    let torque = torque?;
    let rubs = path.iter().zip(&torque).map(|(s, (t, f))| (*t, (s.z[0] * f).max(LEAST_POWER)));
    let damping = of_path(&|s| kernel.supplied_power(s.t, &s.q, &s.z, &()).max(LEAST_POWER));
    let losses = vec![
        Line::new("damping of the buffer", COLOURS[1], damping).wide(3),
        Line::new("friction", COLOURS[0], rubs.collect::<Vec<_>>()).wide(3),
    ];
    let powers = plot("Power (peaks of the buffer are cut off)", "W", LEAST_POWER..0.05, losses);

    let (least, most) = (-pendulum.dry, pendulum.dry);
    let bounds = Line::new("bounds", INK, [(0.0, most), (end, most), (end, least), (0.0, least)]).dashed();
    let lines = vec![bounds, Line::new("friction", COLOURS[0], torque).wide(3)];
    let friction = plot("Torque of friction", "N m", -0.02..0.02, lines);
    let title = "A pendulum with dry friction, a spiral spring and a buffer";
    sheet(title, (1600, 1300), &[vec![angle, energy], vec![powers, friction]])
}

/// The rod, every torque as a force at its end, and what each element delivers.
///
/// # Errors
/// When the run has no state at a time.
pub fn page(kernel: &PendulumKernel, run: &Run<'_>, limit: f64) -> Result<Playback<PendulumKernel>, ContactError> {
    let end = Vector3::new(0.0, 0.0, -LENGTH);
    // Beside the rod where it meets the buffer.
    let buffer = Isometry3::rotation(Vector3::y() * limit) * Isometry3::translation(0.035, 0.0, -0.8 * LENGTH);
    let last = run.last().map_or(0.0, |s| s.t);
    let samples: Result<Vec<_>, ContactError> = (0..=600).map(|n| run.at(last * f64::from(n) / 600.0)).collect();
    // A torque about the pivot as the force at the end of the rod that has it.
    let arrow = |s: &Sample<PendulumKernel>, torque: f64| {
        let rotation = kernel.pose_of(PendulumFrame::rod, s.t, &s.q).rotation;
        (rotation * end, rotation * Vector3::x() * (-torque / LENGTH))
    };
    let friction = |s: &Sample<PendulumKernel>| run.forces(s.t).map_or(f64::NAN, |forces| forces[0]);
    let mut page = Playback::of_samples("A pendulum with dry friction, a spiral spring and a buffer", samples?)
        .si()
        .frames(kernel)
        .from_the_side()
        .shape("rod", Shape::rod([0.0; 3], end.into(), 0.012))
        .body("buffer", |_| buffer, [Shape::cuboid([0.04, 0.06, 0.06]).colour("#444444")])
        .trace("rod", end.into())
        .arrow("friction", 0.08, |s| arrow(s, friction(s)))
        .curve("power / W", "friction", |s| friction(s) * s.z[0]);
    for (k, element) in PendulumKernel::ELEMENTS.iter().enumerate() {
        let torque = |s: &Sample<PendulumKernel>| kernel.element_forces(s.t, &s.q, &s.z, &())[(0, k)];
        page = page
            .arrow(element.name, 0.08, |s| arrow(s, torque(s)))
            .curve("power / W", element.name, |s| kernel.powers(s.t, &s.q, &s.z, &())[k]);
    }
    Ok(page.energy(kernel))
}
