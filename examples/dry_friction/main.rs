//! Dry friction exactly, sticking and sliding by turns: a slider beside its exact solution, and an arm whose two joints
//! stick and give way, beside friction that is made smooth.
//!
//! `cargo run --release --example dry_friction [-- FOLDER]` writes the motion of the arm as a page into `FOLDER`, by
//! default `target/gauss`.

mod model;
#[cfg(test)]
mod tests;

use gauss_contact::{ContactError, ContactRun, ContactTrajectory, EventKind, Mode};
use gauss_examples::plots::write_page;
use gauss_playback::{Playback, Shape};
use gauss_runtime::prelude::*;
use model::{Arm, ArmFrame, ArmKernel, SWINGS, Slider, SmoothArm};

/// The arm is let go so, rad, and watched for so long, s.
const LET_GO: [f64; 2] = [1.4, 0.9];
const WATCHED: f64 = 12.0;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let slider = Slider::desk();
    let kernel = slider.kernel()?;
    let (released, end) = (slider.exact(0.0), SWINGS * slider.half_swing() + 1.0);
    println!(
        "A slider on a spring, ten half swings until it sticks, and a second more:\n  tolerance   largest error at its turns, mm"
    );
    for tolerance in [1e-6, 1e-9, 1e-12] {
        let run = ContactRun::new(&kernel).adaptive(tolerance, tolerance);
        let run = run.run([released].into(), [0.0].into(), 0.0..end)?;
        let turns = run.segments().iter().map(|part| part.trajectory().last());
        let error = turns.map(|s| (s.q[0] - slider.exact(s.t)).abs()).fold(0.0, f64::max);
        println!("  {tolerance:.0e}       {:.1e}", 1e3 * error);
    }

    let arm = Arm { g: 9.81, f_shoulder: 0.8, f_elbow: 0.3 };
    let kernel = arm.kernel()?;
    let run = ContactRun::new(&kernel).adaptive(1e-11, 1e-11).run(LET_GO.into(), SVector::zeros(), 0.0..WATCHED)?;
    println!("\nAn arm that is let go, friction of {} and {} N m:", arm.f_shoulder, arm.f_elbow);
    for event in run.events() {
        let kind = match event.kind {
            EventKind::Sticks => "sticks",
            EventKind::Slides(_) => "gives way",
            _ => "turns round",
        };
        let q = run.at(event.time)?.q;
        println!("  {:<9.6}  {:+.6}  {:+.6} rad  {} {kind}", event.time, q[0], q[1], event.name);
    }
    let (first, last) = (run.at(0.0)?, run.at(WATCHED)?);
    let lost = kernel.energy(first.t, &first.q, &first.z) - kernel.energy(last.t, &last.q, &last.z);
    // Between two events no joint turns round.
    let ways = run.segments().iter().map(|part| part.trajectory().last().q - part.trajectory().first().q);
    let worn: f64 = ways.map(|way| arm.f_shoulder * way[0].abs() + arm.f_elbow * way[1].abs()).sum();
    println!("  energy lost {lost:.9} J, friction times way {worn:.9} J");

    println!("\nThe same with f v/√(v² + ε²), at {WATCHED} s:\n  ε, rad/s   farthest angle from that, rad");
    for creep in [1e-1, 1e-2, 1e-3] {
        let Arm { g, f_shoulder, f_elbow } = arm;
        let smooth = SmoothArm { g, f_shoulder, f_elbow, creep }.kernel()?;
        let run = Simulation::new(&smooth).adaptive(1e-9, 1e-9);
        let end = run.run_to_end(LET_GO.into(), SVector::zeros(), 0.0..WATCHED)?.sample;
        println!("  {creep:.0e}      {:.1e}", (end.q - last.q).amax());
    }
    write_page("dry_friction", &page(&kernel, &run)?)
}

/// The arm, the friction of each joint, and which of them stick.
fn page(
    kernel: &ArmKernel,
    run: &ContactTrajectory<'_, ArmKernel>,
) -> Result<Playback<ArmKernel>, Box<dyn std::error::Error>> {
    let weight = |s: &Sample<ArmKernel>, frame: ArmFrame, depth: f64, mass: f64| {
        let pose = kernel.pose_of(frame, s.t, &s.q);
        (pose.translation.vector - pose.rotation * Vector3::z() * depth, Vector3::z() * (-mass * 9.81))
    };
    let rod = |length: f64| Shape::rod([0.0; 3], [0.0, 0.0, -length], 0.02);
    let samples: Result<Vec<_>, ContactError> = (0..=1200).map(|n| run.at(WATCHED * f64::from(n) / 1200.0)).collect();
    let mut page = Playback::of_samples("Dry friction, sticking and sliding by turns", samples?)
        .si()
        .frames(kernel)
        .from_the_side()
        .shape("upper", rod(0.4))
        .shape("lower", rod(0.3))
        .trace("lower", [0.0, 0.0, -0.3])
        .arrow("weight of the upper rod", 0.01, |s| weight(s, ArmFrame::upper, 0.2, 2.0))
        .arrow("weight of the lower rod", 0.01, |s| weight(s, ArmFrame::lower, 0.15, 1.0));
    for (k, joint) in ["shoulder", "elbow"].into_iter().enumerate() {
        let friction = |s: &Sample<ArmKernel>| run.forces(s.t).map_or(f64::NAN, |forces| forces[k]);
        let sticks = |s: &Sample<ArmKernel>| f64::from(run.modes(s.t).is_ok_and(|modes| modes[k] == Mode::Sticks));
        page = page.curve("friction / (N m)", joint, friction).curve("sticks: 1", joint, sticks);
    }
    Ok(page.energy(kernel))
}
