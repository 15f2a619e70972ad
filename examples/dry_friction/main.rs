//! Dry friction exactly, sticking and sliding by turns: a slider beside its exact solution, and an arm whose two joints
//! stick and give way, beside friction that is made smooth.
//!
//! `cargo run --release --example dry_friction`

mod friction;
mod model;

use friction::{Dry, Mode};
use gauss_runtime::prelude::*;
use model::{Arm, SWINGS, Slider, SmoothArm};

/// Friction of the slider, N; of shoulder and elbow, N m.
const ON_THE_FLOOR: f64 = 0.2;
const IN_JOINTS: [f64; 2] = [0.8, 0.3];
/// The arm is let go so, rad, and watched for so long, s.
const LET_GO: [f64; 2] = [1.4, 0.9];
const WATCHED: f64 = 12.0;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let slider = Slider::desk();
    let kernel = slider.kernel()?;
    let dry = Dry { kernel: &kernel, limits: [ON_THE_FLOOR] };
    let released = SVector::from([slider.exact(ON_THE_FLOOR, 0.0)]);
    println!(
        "A slider on a spring, ten half swings until it sticks, and a second more:\n  tolerance   largest error at its turns, mm"
    );
    for tolerance in [1e-6, 1e-9, 1e-12] {
        let moments = dry.run(released, SVector::zeros(), SWINGS * slider.half_swing() + 1.0, tolerance)?;
        let error = |m: &friction::Moment<1>| (m.q[0] - slider.exact(ON_THE_FLOOR, m.t)).abs();
        println!("  {tolerance:.0e}       {:.1e}", 1e3 * moments.iter().map(error).fold(0.0, f64::max));
    }

    let kernel = Arm { g: 9.81 }.kernel()?;
    let dry = Dry { kernel: &kernel, limits: IN_JOINTS };
    let moments = dry.run(SVector::from(LET_GO), SVector::zeros(), WATCHED, 1e-11)?;
    println!("\nAn arm that is let go, friction of {} and {} N m in shoulder and elbow:", IN_JOINTS[0], IN_JOINTS[1]);
    println!("  t, s       shoulder, rad  elbow, rad  shoulder  elbow");
    let word = |mode: Mode| match mode {
        Mode::Sticks => "sticks",
        Mode::Slides(sign) if sign > 0.0 => "slides +",
        Mode::Slides(_) => "slides −",
    };
    for m in &moments {
        let [a, b] = m.modes.map(word);
        println!("  {:<9.6}  {:+.6}      {:+.6}   {a:<8}  {b}", m.t, m.q[0], m.q[1]);
    }
    let energy = |m: &friction::Moment<2>| kernel.energy(m.t, &m.q, &m.z);
    let lost = energy(&moments[0]) - energy(&moments[moments.len() - 1]);
    let ways = moments.windows(2).map(|pair| pair[1].q - pair[0].q);
    let worn: f64 = ways.map(|way| IN_JOINTS[0] * way[0].abs() + IN_JOINTS[1] * way[1].abs()).sum();
    println!("  energy lost {lost:.9} J, friction times way {worn:.9} J");

    println!("\nThe same with f v/√(v² + ε²), at {WATCHED} s:\n  ε, rad/s   farthest angle from that, rad");
    let end = moments[moments.len() - 1].q;
    for creep in [1e-1, 1e-2, 1e-3] {
        let smooth = SmoothArm { g: 9.81, f_shoulder: IN_JOINTS[0], f_elbow: IN_JOINTS[1], creep }.kernel()?;
        let run = Simulation::new(&smooth).adaptive(1e-9, 1e-9);
        let last = run.run_to_end(SVector::from(LET_GO), SVector::zeros(), 0.0..WATCHED)?.sample;
        println!("  {creep:.0e}      {:.1e}", (last.q - end).amax());
    }
    Ok(())
}
