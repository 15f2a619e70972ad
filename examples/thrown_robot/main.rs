//! A robot from its file: a quadruped that is thrown, whose momenta and energy are accounted for.
//!
//! `cargo run --release --example thrown_robot [-- FOLDER]` draws into `FOLDER`, by default `target/gauss`.

use std::error::Error;

use gauss_charts::drawing::COLOURS;
use gauss_examples::plots::{Line, Plot, sheet, write, write_page};
use gauss_playback::{Playback, Shape};
use gauss_runtime::monitor::power_balance;
use gauss_runtime::prelude::*;

mod model;
#[cfg(test)]
mod tests;

use model::{G, Quadruped, QuadrupedKernel, Whole, thrown};

const FLIGHT: f64 = 0.8;

fn main() -> Result<(), Box<dyn Error>> {
    let kernel = Quadruped { k: 60.0, c: 1.0 }.kernel()?;
    let start = thrown();
    let path = Simulation::new(&kernel).adaptive(1e-11, 1e-12).run(start.q(), start.z(), 0.0..FLIGHT)?;
    let [flight, spins] = accounted(&kernel, &path)?;
    write("thrown_robot", &sheet("A quadruped, thrown", (1300, 700), &[vec![flight, spins]])?)?;
    write_page("thrown_robot", &page(&kernel, &path)?)
}

/// The skeleton of its frames, and what is kept.
fn page(
    kernel: &QuadrupedKernel,
    path: &Trajectory<QuadrupedKernel>,
) -> Result<Playback<QuadrupedKernel>, IntegrationError> {
    let mut page = Playback::new("A quadruped from its file, thrown", path)?
        .si()
        .frames(kernel)
        .shape("base_link", Shape::cuboid([0.55, 0.25, 0.18]));
    for leg in ["LF", "LH", "RF", "RH"] {
        let [hip, thigh, shin] = ["HAA", "HFE", "KFE"].map(|joint| format!("{leg}_{joint}_link"));
        // The foot has no frame of its own in the file.
        let foot = [if leg.ends_with('F') { 0.1 } else { -0.1 }, 0.0, -0.32];
        page = page.rod("base_link", &hip, 0.02).rod(&hip, &thigh, 0.025).rod(&thigh, &shin, 0.025);
        page = page.shape(&shin, Shape::rod([0.0; 3], foot, 0.018));
    }
    let whole = |s: &Sample<QuadrupedKernel>| Whole::of(kernel, s);
    Ok(page
        .body("centre of mass", move |s| Translation3::from(whole(s).center).into(), [Shape::ball(0.03)])
        .trace("centre of mass", [0.0; 3])
        .trace("base_link", [0.0; 3])
        .arrow("spin about the centre of mass", 0.1, move |s| (whole(s).center, whole(s).spin))
        .arrow("momentum", 0.003, move |s| (whole(s).center, whole(s).momentum))
        .energy(kernel))
}

/// What is kept of the quadruped, and its plots.
fn accounted(
    kernel: &QuadrupedKernel,
    path: &Trajectory<QuadrupedKernel>,
) -> Result<[Plot<'static>; 2], Box<dyn Error>> {
    println!("A QUADRUPED FROM ITS FILE, THROWN\n");
    println!("18 degrees of freedom; one evaluation: {}.\n", QuadrupedKernel::OPERATIONS.acceleration);
    let wholes: Vec<(f64, Whole, f64)> =
        path.iter().map(|s| (s.t, Whole::of(kernel, s), s.q.0.translation.vector.z)).collect();
    let first = &wholes[0].1;
    let (mut linear, mut angular) = (0.0_f64, 0.0_f64);
    for (t, now, _) in &wholes {
        let fallen = first.momentum - Vector3::z() * (G * now.mass * t);
        linear = linear.max((now.momentum - fallen).norm() / first.momentum.norm());
        angular = angular.max((now.spin - first.spin).norm() / first.spin.norm());
    }
    let balance = power_balance(kernel, path, |_, _, _| ());
    let taken = -balance.last().work;
    println!("momentum                that of a falling body to {linear:.1e}");
    println!("spin about the centre   kept to {angular:.1e}");
    println!("dampers took            {taken:.3} J; the energy lacks as much to {:.1e}", balance.largest_residual());
    if linear > 1e-8 || angular > 1e-8 || balance.largest_residual() > 1e-3 {
        return Err("something is not accounted for".into());
    }
    Ok(plots_of_flight(&wholes))
}

fn plots_of_flight(wholes: &[(f64, Whole, f64)]) -> [Plot<'static>; 2] {
    let [blue, orange, green] = [COLOURS[0], COLOURS[1], COLOURS[2]];
    let flight = Plot::new(
        "Heights",
        ("time, s", 0.0..FLIGHT),
        ("m", 0.9..2.1),
        vec![
            Line::new("base", orange, wholes.iter().map(|(t, _, z)| (*t, *z))),
            Line::new("centre of mass", blue, wholes.iter().map(|(t, whole, _)| (*t, whole.center.z))),
        ],
    );
    let most = wholes[0].1.spin.amax() * 1.3;
    let spin = |name: &str, colour, k: usize| Line::new(name, colour, wholes.iter().map(|(t, w, _)| (*t, w.spin[k])));
    let spins = Plot::new(
        "Spin about the centre of mass",
        ("time, s", 0.0..FLIGHT),
        ("kg m²/s", -most..most),
        vec![spin("k₁", blue, 0), spin("k₂", orange, 1), spin("k₃", green, 2)],
    );
    [flight, spins]
}
