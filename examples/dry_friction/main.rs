//! Dry friction exactly, sticking and sliding by turns: a slider beside its exact solution, and an arm whose two joints
//! stick and give way, beside friction that is made smooth.
//!
//! `cargo run --release --example dry_friction [-- FOLDER]` writes the motion of the arm as a page into `FOLDER`, by
//! default `target/gauss`.

mod friction;
mod model;

use friction::{Dry, Mode};
use gauss_examples::plots::write_page;
use gauss_playback::{Playback, Shape};
use gauss_runtime::prelude::*;
use model::{Arm, ArmFrame, ArmKernel, SWINGS, Slider, SmoothArm};

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
    write_page("dry_friction", &page(&dry, &moments)?)
}

/// The arm, the friction of each joint, and which of them stick.
fn page(dry: &Dry<'_, ArmKernel, 2>, moments: &[friction::Moment<2>]) -> Result<Playback<ArmKernel>, IntegrationError> {
    let kernel = dry.kernel;
    let modes = |t: f64| moments.iter().rev().find(|m| m.t <= t).unwrap_or(&moments[0]).modes;
    let friction =
        |s: &Sample<ArmKernel>, k: usize| dry.forces(&modes(s.t), s.t, &s.q, &s.z).map_or(f64::NAN, |forces| forces[k]);
    let weight = |s: &Sample<ArmKernel>, frame: ArmFrame, depth: f64, mass: f64| {
        let pose = kernel.pose_of(frame, s.t, &s.q);
        (pose.translation.vector - pose.rotation * Vector3::z() * depth, Vector3::z() * (-mass * 9.81))
    };
    let rod = |length: f64| Shape::rod([0.0; 3], [0.0, 0.0, -length], 0.02);
    let mut page = Playback::of_samples("Dry friction, sticking and sliding by turns", dry.path(moments, 0.01)?)
        .frames(kernel)
        .from_the_side()
        .shape("upper", rod(0.4))
        .shape("lower", rod(0.3))
        .trace("lower", [0.0, 0.0, -0.3])
        .arrow("weight of the upper rod", 0.01, |s| weight(s, ArmFrame::upper, 0.2, 2.0))
        .arrow("weight of the lower rod", 0.01, |s| weight(s, ArmFrame::lower, 0.15, 1.0));
    for (k, joint) in ["shoulder", "elbow"].into_iter().enumerate() {
        let sticks = |s: &Sample<ArmKernel>| f64::from(u8::from(modes(s.t)[k] == Mode::Sticks));
        page = page.curve("friction / (N m)", joint, |s| friction(s, k)).curve("sticks: 1", joint, sticks);
    }
    Ok(page.energy(kernel))
}
