//! The picture: angle, energy and powers of the pendulum; the slider against its exact solution.

use std::error::Error;

use gauss_charts::drawing::{COLOURS, INK};
use gauss_examples::plots::{Line, Plot, sheet};
use gauss_playback::{Playback, Shape};
use gauss_runtime::monitor::power_balance;
use gauss_runtime::prelude::*;

use crate::scene::{LENGTH, Pendulum, PendulumFrame, PendulumKernel, Slider};
use crate::slide::{Sliding, slide};

/// Lower end of the axis of powers, W: what the buffer takes is far below it.
const LEAST_POWER: f64 = -0.2;

/// Draws all four panels.
///
/// # Errors
/// When a panel cannot be laid out, or a slider does not reach its end.
pub fn draw(
    pendulum: &Pendulum,
    kernel: &PendulumKernel,
    path: &Trajectory<PendulumKernel>,
    slider: &Slider,
) -> Result<String, Box<dyn Error>> {
    let end = path.last().t;
    let of_path = |value: &dyn Fn(&Sample<PendulumKernel>) -> f64| -> Vec<(f64, f64)> {
        path.iter().step_by(2).map(|s| (s.t, value(s))).collect()
    };
    let plot = |title, y, ends, lines| Plot::new(title, ("time, s", 0.0..end), (y, ends), lines);

    let buffer = Line::new("buffer", COLOURS[1], [(0.0, pendulum.limit), (end, pendulum.limit)]).dashed();
    let rod = Line::new("rod", COLOURS[0], of_path(&|s| s.q[0]));
    let angle = plot("Angle", "rad", -1.0..2.0, vec![buffer, rod]);

    let start = kernel.energy(path.first().t, &path.first().q, &path.first().z);
    let balance = power_balance(kernel, path, |_, _, _| ());
    let work = balance.points().iter().step_by(2).map(|p| (p.t, start + p.work));
    let energies = vec![
        Line::new("kinetic", COLOURS[2], of_path(&|s| kernel.kinetic_energy(s.t, &s.q, &s.z))),
        Line::new("with potential", COLOURS[0], of_path(&|s| kernel.energy(s.t, &s.q, &s.z))).wide(6),
        Line::new("start + work", INK, work).dashed().wide(2),
    ];
    let energy = plot("Energy, and what dissipation leaves of it", "J", -0.6..0.8, energies);

    let power = |name: &str| {
        of_path(&|s| kernel.power(name, s.t, &s.q, &s.z, &()).map_or(f64::NAN, |power| power.max(LEAST_POWER)))
    };
    // What friction does not take, the damper of the buffer does.
    let damping = of_path(&|s| {
        let friction = kernel.power("friction", s.t, &s.q, &s.z, &()).unwrap_or(f64::NAN);
        (kernel.supplied_power(s.t, &s.q, &s.z, &()) - friction).max(LEAST_POWER)
    });
    let losses = vec![
        Line::new("damping of the buffer", COLOURS[1], damping).wide(3),
        Line::new("friction", COLOURS[0], power("friction")).wide(3),
    ];
    let powers = plot("Power (peaks of the buffer are cut off)", "W", LEAST_POWER..0.05, losses);

    let smooth = |creep: f64| distances(&slider.smooth(creep).kernel()?, slider);
    let errors = Plot::new(
        "A sliding mass: distance from the exact solution",
        ("time, s", 0.0..slider.rests()),
        ("log₁₀ of metres", -13.0..-2.0),
        vec![
            Line::new("signum", INK, distances(&slider.kernel()?, slider)?).wide(3),
            Line::new("ε = 10⁻² m/s", COLOURS[1], smooth(1e-2)?).wide(3),
            Line::new("10⁻³", COLOURS[2], smooth(1e-3)?).wide(3),
            Line::new("10⁻⁴", COLOURS[0], smooth(1e-4)?).wide(3),
        ],
    );
    let title = "A pendulum with dry friction, a spiral spring and a buffer";
    sheet(title, (1600, 1300), &[vec![angle, energy], vec![powers, errors]])
}

/// Decimal logarithms of the slider's distances from the exact solution.
fn distances<K: Sliding>(kernel: &K, slider: &Slider) -> Result<Vec<(f64, f64)>, Box<dyn Error>> {
    let path = slide(kernel, slider, 1e-10)?;
    let samples = path.at_times((1..=400).map(|n| slider.rests() * f64::from(n) / 400.0))?;
    Ok(samples.iter().map(|s| (s.t, (s.q[0] - slider.exact(s.t)).abs().max(1e-13).log10())).collect())
}

/// The rod, every torque as a force at its end, and what each element delivers.
///
/// # Errors
/// When the path has no state at a time.
pub fn page(
    kernel: &PendulumKernel,
    path: &Trajectory<PendulumKernel>,
    limit: f64,
) -> Result<Playback<PendulumKernel>, IntegrationError> {
    let end = Vector3::new(0.0, 0.0, -LENGTH);
    // Beside the rod where it meets the buffer.
    let buffer = Isometry3::rotation(Vector3::y() * limit) * Isometry3::translation(0.035, 0.0, -0.8 * LENGTH);
    let mut page = Playback::new("A pendulum with dry friction, a spiral spring and a buffer", path)?
        .frames(kernel)
        .from_the_side()
        .shape("rod", Shape::rod([0.0; 3], end.into(), 0.012))
        .body("buffer", |_| buffer, [Shape::cuboid([0.04, 0.06, 0.06]).colour("#444444")])
        .trace("rod", end.into());
    for (k, element) in PendulumKernel::ELEMENTS.iter().enumerate() {
        let torque = |s: &Sample<PendulumKernel>| kernel.element_forces(s.t, &s.q, &s.z, &())[(0, k)];
        // A torque about the pivot as the force at the end of the rod that has it.
        page = page
            .arrow(element.name, 0.08, |s| {
                let rotation = kernel.pose_of(PendulumFrame::rod, s.t, &s.q).rotation;
                (rotation * end, rotation * Vector3::x() * (-torque(s) / LENGTH))
            })
            .curve("power / W", element.name, |s| kernel.powers(s.t, &s.q, &s.z, &())[k]);
    }
    Ok(page.energy(kernel))
}
