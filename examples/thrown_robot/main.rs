//! A robot from its file: a quadruped that is thrown, whose momenta and energy are accounted for.
//!
//! `cargo run --release --example thrown_robot [-- FOLDER]` draws into `FOLDER`, by default `target/gauss`.

use std::error::Error;

use gauss_examples::figure::COLOURS;
use gauss_examples::plots::{Line, Plot, sheet, write};
use gauss_runtime::prelude::*;

mod model;

use model::{G, Quadruped, QuadrupedKernel, Whole, thrown};

const FLIGHT: f64 = 0.8;

fn main() -> Result<(), Box<dyn Error>> {
    let [flight, spins] = throw()?;
    write("thrown_robot", &sheet("A quadruped, thrown", (1300, 700), &[vec![flight, spins]])?)
}

/// The quadruped: what is kept, and its plots.
fn throw() -> Result<[Plot<'static>; 2], Box<dyn Error>> {
    println!("A QUADRUPED FROM ITS FILE, THROWN\n");
    println!("18 degrees of freedom; one evaluation: {}.\n", QuadrupedKernel::OPERATIONS.acceleration);
    let kernel = Quadruped { k: 60.0, c: 1.0 }.kernel()?;
    let start = thrown();
    let path = Simulation::new(&kernel).adaptive(1e-11, 1e-12).run(start.q(), start.z(), 0.0..FLIGHT)?;
    let wholes: Vec<(f64, Whole, f64)> =
        path.iter().map(|s| (s.t, Whole::of(&kernel, s), s.q.0.translation.vector.z)).collect();
    let first = &wholes[0].1;
    let (mut linear, mut angular) = (0.0_f64, 0.0_f64);
    for (t, now, _) in &wholes {
        let fallen = first.momentum - Vector3::z() * (G * now.mass * t);
        linear = linear.max((now.momentum - fallen).norm() / first.momentum.norm());
        angular = angular.max((now.spin - first.spin).norm() / first.spin.norm());
    }
    let balance = power_balance(&kernel, &path, |_, _, _| ());
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
        "heights",
        ("s", 0.0..FLIGHT),
        ("m", 0.9..2.1),
        vec![
            Line::new("base", orange, wholes.iter().map(|(t, _, z)| (*t, *z))),
            Line::new("centre of mass", blue, wholes.iter().map(|(t, whole, _)| (*t, whole.center.z))),
        ],
    );
    let most = wholes[0].1.spin.amax() * 1.3;
    let spin = |name: &str, colour, k: usize| Line::new(name, colour, wholes.iter().map(|(t, w, _)| (*t, w.spin[k])));
    let spins = Plot::new(
        "spin about the centre of mass",
        ("s", 0.0..FLIGHT),
        ("kg m²/s", -most..most),
        vec![spin("k₁", blue, 0), spin("k₂", orange, 1), spin("k₃", green, 2)],
    );
    [flight, spins]
}
