//! An arm from its file follows a way: under the efforts that the way asks for, with computed torque, and with the
//! regulator that exact derivatives along the way give. The regulator costs what its Riccati equation says, and less
//! than computed torque.
//!
//! `cargo run --release --example guided_arm [-- FOLDER]` draws into `FOLDER`, by default `target/gauss`.

use std::error::Error;

use gauss_charts::drawing::COLOURS;
use gauss_examples::plots::{Line, Plot, sheet, write, write_page};
use gauss_examples::stage;
use gauss_playback::{Playback, Shape};
use gauss_runtime::prelude::*;

mod model;

use model::{Arm, ArmKernel, Cost, GAIN, Joints, Regulator, State, computed_torque, error, nominal, wanted};

/// s.
const END: f64 = 2.0;
/// Of the regulator's equation, and of its gains: a tenth of the time in which errors die.
const STEPS: usize = 400;

fn main() -> Result<(), Box<dyn Error>> {
    println!("inverse dynamics: {}", ArmKernel::OPERATIONS.gauss_residual);
    println!("accelerations:    {}\n", ArmKernel::OPERATIONS.acceleration);
    let arm = Arm.kernel()?;
    let cost = Cost::new();
    let regulator = Regulator::new(&arm, &cost, END, STEPS);
    let follows = |law: &dyn Fn(f64, &Joints, &Joints) -> Joints, beside: f64| run(&arm, &cost, law, beside);
    let alone = |t: f64, _: &Joints, _: &Joints| nominal(&arm, t);
    let computed = |t: f64, q: &Joints, z: &Joints| computed_torque(&arm, t, q, z);
    let regulated = |t: f64, q: &Joints, z: &Joints| regulator.efforts(&arm, t, q, z);

    let small = beside(1e-5);
    let predicted = small.dot(&(regulator.at_start * small));
    println!("COSTS, started 1e-5 rad and 1e-7 m beside the way\n");
    let (of_computed, of_regulated) = (follows(&computed, 1e-5)?.cost, follows(&regulated, 1e-5)?.cost);
    println!("computed torque  {of_computed:.6e}");
    println!("regulator        {of_regulated:.6e}, by its Riccati equation {predicted:.6e}\n");

    println!("ERRORS, rad, started 0.1 rad and 1 mm beside\n");
    println!("  t/s   efforts alone  computed torque  regulator");
    let runs = [follows(&alone, 0.1)?, follows(&computed, 0.1)?, follows(&regulated, 0.1)?];
    for t in [0.0, 0.1, 0.2, 0.4, 0.8, 1.6] {
        let [a, b, c] = [0, 1, 2].map(|k| runs[k].errors[(t / H).round() as usize]);
        println!("{t:5.1} {a:15.1e} {b:16.1e} {c:10.1e}");
    }
    // Of the linear equation that computed torque leaves.
    let expected = |t: f64| 0.1 * (1.0 + GAIN * t) * (-GAIN * t).exp();
    let missed = (runs[1].errors[(0.4 / H).round() as usize] - expected(0.4)).abs();
    println!("\ncomputed torque is {missed:.1e} off its linear equation after 0.4 s");
    write("guided_arm", &sheet("An arm from its file follows a way", (1100, 700), &[vec![picture(&runs)]])?)?;
    write_page("guided_arm", &page(&arm, &regulated)?)?;
    let right = (of_regulated / predicted - 1.0).abs() < 1e-4 && of_regulated < of_computed && missed < 1e-8;
    if right { Ok(()) } else { Err("a law does not do what it was designed for".into()) }
}

/// Of the run, s.
const H: f64 = 1e-3;

/// Angles beside the way, fingers a hundredth of that in metres, at the rates that are wanted.
fn beside(angle: f64) -> State {
    State::from_fn(|k, _| match k {
        0..7 => angle,
        7 | 8 => 0.01 * angle,
        _ => 0.0,
    })
}

/// What a run cost, and the largest error of an angle after each step.
struct Followed {
    cost: f64,
    errors: Vec<f64>,
}

fn run(
    arm: &ArmKernel,
    cost: &Cost,
    law: &dyn Fn(f64, &Joints, &Joints) -> Joints,
    angle: f64,
) -> Result<Followed, Box<dyn Error>> {
    let [place, rate, _] = wanted(0.0);
    let start = place + beside(angle).fixed_rows::<9>(0);
    let input = |t: f64, q: &Joints, z: &Joints| law(t, q, z);
    let path = Simulation::new(arm).input(input).fixed_step(H).run(start, rate, 0.0..END)?;
    let rates = path.iter().map(|s| {
        let off = error(s.t, &s.q, &s.z);
        cost.rate(arm, s.t, &off, &law(s.t, &s.q, &s.z))
    });
    let rates: Vec<f64> = rates.collect();
    // By Simpson's rule: errors of trapezoids would be as large as what is looked for.
    let inside: f64 = rates.windows(3).step_by(2).map(|w| (w[0] + 4.0 * w[1] + w[2]) * (H / 3.0)).sum();
    let last = path.last();
    let off = error(last.t, &last.q, &last.z);
    let errors = path.iter().map(|s| error(s.t, &s.q, &s.z).rows(0, 7).amax()).collect();
    Ok(Followed { cost: inside + off.component_mul(&cost.at_the_end).dot(&off), errors })
}

/// The skeleton of its frames under a law, started beside the way.
fn page(arm: &ArmKernel, law: &dyn Fn(f64, &Joints, &Joints) -> Joints) -> Result<Playback<ArmKernel>, Box<dyn Error>> {
    let [place, rate, _] = wanted(0.0);
    let input = |t: f64, q: &Joints, z: &Joints| law(t, q, z);
    let path =
        Simulation::new(arm).input(input).fixed_step(H).run(place + beside(0.1).fixed_rows::<9>(0), rate, 0.0..END)?;
    let mut page = Playback::new("An arm from its file follows a way", &path)?.si().frames(arm);
    let link = |k: usize| if k == 0 { "base_link".to_owned() } else { format!("panda_joint{k}_link") };
    let links: Vec<String> = (0..=7).map(link).collect();
    page = stage::chain(page, &links.iter().map(String::as_str).collect::<Vec<_>>(), 0.04);
    for finger in ["panda_finger_joint1_link", "panda_finger_joint2_link"] {
        let shape = Shape::cuboid([0.02, 0.015, 0.06]).at(&Isometry3::translation(0.0, 0.0, 0.03));
        page = page.shape(finger, shape).rod("panda_joint7_link", finger, 0.015);
    }
    for k in [0, 1, 3] {
        page =
            page.curve("angle beside the way / rad", &format!("joint {}", k + 1), move |s| error(s.t, &s.q, &s.z)[k]);
    }
    Ok(page.trace("panda_finger_joint1_link", [0.0, 0.0, 0.06]).energy(arm))
}

fn picture(runs: &[Followed; 3]) -> Plot<'static> {
    let names = ["efforts of the way alone", "computed torque", "regulator"];
    let curve = |k: usize| {
        let points = runs[k].errors.iter().enumerate().map(|(n, e)| (n as f64 * H, e.max(1e-9).log10()));
        Line::new(names[k], COLOURS[k], points.filter(|(t, _)| *t <= 1.0))
    };
    Plot::new(
        "largest error of an angle",
        ("time, s", 0.0..1.0),
        ("log₁₀ of the error in rad", -9.0..1.0),
        vec![curve(0), curve(1), curve(2)],
    )
}
