//! Robots from their files: a quadruped that is thrown, whose momenta and energy are accounted for, and an arm under computed torque.
//!
//! `cargo run --release --example thrown_robot [-- FOLDER]` draws into `FOLDER`, by default `target/gauss`.

use std::error::Error;

use gauss_examples::figure::{COLOURS, INK};
use gauss_examples::plots::{Line, Plot, sheet, write};
use gauss_runtime::prelude::*;

mod model;

use model::{Arm, ArmKernel, G, Joints, Quadruped, QuadrupedKernel, Whole, efforts, thrown, wanted};

const FLIGHT: f64 = 0.8;

fn main() -> Result<(), Box<dyn Error>> {
    let [flight, spins] = throw()?;
    let errors = guide()?;
    write("thrown_robot", &sheet("Robots from their files", (1800, 700), &[vec![flight, spins, errors]])?)
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
    Ok(plots_of_flight(&wholes))
}

fn plots_of_flight(wholes: &[(f64, Whole, f64)]) -> [Plot<'static>; 2] {
    let [blue, orange, green] = [COLOURS[0], COLOURS[1], COLOURS[2]];
    let flight = Plot {
        title: "heights",
        x: ("s", 0.0..FLIGHT),
        y: ("m", 0.9..2.1),
        equal: false,
        lines: vec![
            Line::new("base", orange, wholes.iter().map(|(t, _, z)| (*t, *z))),
            Line::new("centre of mass", blue, wholes.iter().map(|(t, whole, _)| (*t, whole.center.z))),
        ],
        marks: vec![],
    };
    let most = wholes[0].1.spin.amax() * 1.3;
    let spin = |name: &str, colour, k: usize| Line::new(name, colour, wholes.iter().map(|(t, w, _)| (*t, w.spin[k])));
    let spins = Plot {
        title: "spin about the centre of mass",
        x: ("s", 0.0..FLIGHT),
        y: ("kg m²/s", -most..most),
        equal: false,
        lines: vec![spin("k₁", blue, 0), spin("k₂", orange, 1), spin("k₃", green, 2)],
        marks: vec![],
    };
    [flight, spins]
}

/// The arm: how its errors die.
fn guide() -> Result<Plot<'static>, Box<dyn Error>> {
    println!("\nAN ARM FROM ITS FILE, COMPUTED TORQUE\n");
    println!("inverse dynamics: {}.", ArmKernel::OPERATIONS.gauss_residual);
    let arm = Arm.kernel()?;
    let [place, rate, _] = wanted(0.0);
    let started = place + Joints::from_element(0.1);
    let control = |t: f64, q: &Joints, z: &Joints| efforts(&arm, t, q, z);
    let way = Simulation::new(&arm).input(control).adaptive(1e-10, 1e-12).run(started, rate, 0.0..3.0)?;
    let error = |t: f64, q: &Joints| (q - wanted(t)[0]).amax();
    for t in [0.0, 0.2, 0.5, 1.0, 2.0, 3.0] {
        let sample = way.at(t)?;
        println!("{t:4.1} s   off by {:.1e}", error(sample.t, &sample.q));
    }
    let shown = way.iter().filter(|s| s.t <= 1.0);
    Ok(Plot {
        title: "largest error of the arm",
        x: ("s", 0.0..1.0),
        y: ("rad or m, power of ten", -9.0..0.0),
        equal: false,
        lines: vec![Line::new("", INK, shown.map(|s| (s.t, error(s.t, &s.q).max(1e-9).log10())))],
        marks: vec![],
    })
}
