//! An arm of seven joints draws a circle with its tool, controlled in operational space: the error of the tool obeys
//! the linear equation that the controller wants, whatever the arm does besides.
//! `cargo run --release --example operational_space` writes the motion as a page into `target/gauss`.
//!
//! Joints are those of the public description of the Franka Emika Panda; links are like cylinders of its masses.

use gauss_examples::plots::write_page;
use gauss_examples::stage;
use gauss_playback::{Playback, Shape};
use gauss_runtime::frames::in_observers_axes;
use gauss_runtime::operational::{OperationalError, OperationalSpace};
use gauss_runtime::prelude::*;

/// What is asked for beside the equations: the motion of the tool, and inverse dynamics at rest; the other frames are
/// for the page.
#[derive(GaussDynamics)]
#[gauss(
    frames(b1, b2, b3, b4, b5, b6, b7, tool),
    methods(nonlinear_effects),
    coordinates(q1, q2, q3, q4, q5, q6, q7),
    body(b1, position = [0, 0, 0.333], rotation = rotation_z(q1),
         mass = 3, center_of_mass = [0, -0.03, -0.1], inertia_about_center_of_mass = [0.02, 0.02, 0.01]),
    body(b2, parent = b1, rotation = rotation_x(-pi / 2) * rotation_z(q2),
         mass = 3, center_of_mass = [0, -0.1, 0.03], inertia_about_center_of_mass = [0.02, 0.01, 0.02]),
    body(b3, parent = b2, position = [0, -0.316, 0], rotation = rotation_x(pi / 2) * rotation_z(q3),
         mass = 2.5, center_of_mass = [0.04, 0.02, -0.07], inertia_about_center_of_mass = [0.01, 0.01, 0.005]),
    body(b4, parent = b3, position = [0.0825, 0, 0], rotation = rotation_x(pi / 2) * rotation_z(q4),
         mass = 2.5, center_of_mass = [-0.04, 0.04, 0.02], inertia_about_center_of_mass = [0.01, 0.005, 0.01]),
    body(b5, parent = b4, position = [-0.0825, 0.384, 0], rotation = rotation_x(-pi / 2) * rotation_z(q5),
         mass = 2.5, center_of_mass = [0, 0.04, -0.1], inertia_about_center_of_mass = [0.02, 0.02, 0.005]),
    body(b6, parent = b5, rotation = rotation_x(pi / 2) * rotation_z(q6),
         mass = 1.5, center_of_mass = [0.05, 0, 0], inertia_about_center_of_mass = [0.002, 0.004, 0.004]),
    body(b7, parent = b6, position = [0.088, 0, 0], rotation = rotation_x(pi / 2) * rotation_z(q7),
         mass = 0.7, center_of_mass = [0.01, 0, 0.07], inertia_about_center_of_mass = [0.001, 0.001, 0.0005]),
    frame(tool, parent = b7, position = [0, 0, 0.21]),
    input(m1, m2, m3, m4, m5, m6, m7),
    drive(motors, q1 = m1, q2 = m2, q3 = m3, q4 = m4, q5 = m5, q6 = m6, q7 = m7),
)]
struct Arm {
    #[gauss(gravity)]
    g: f64,
}

type Joints = SVector<f64, 7>;

/// Poles of the error of the tool, 1/s: both at this place.
const POLE: f64 = 5.0;

/// Place, velocity and acceleration that are wanted of the tool: a circle in two seconds.
fn wanted(t: f64) -> [Vector3<f64>; 3] {
    let (radius, rate) = (0.1, std::f64::consts::PI);
    let (sine, cosine) = (rate * t).sin_cos();
    [
        Vector3::new(0.5, radius * cosine, 0.5 + radius * sine),
        Vector3::new(0.0, -sine, cosine) * radius * rate,
        Vector3::new(0.0, -cosine, -sine) * radius * rate * rate,
    ]
}

/// Where the tool is beside where it should be, and how fast that changes.
fn error(arm: &ArmKernel, t: f64, q: &Joints, z: &Joints) -> [Vector3<f64>; 2] {
    let [place, velocity, _] = wanted(t);
    let tool = arm.frames(t, q, z)[ArmFrame::tool].in_observers_axes();
    [tool.pose.translation.vector - place, tool.twist.fixed_rows::<3>(0) - velocity]
}

/// Torques with which the tool accelerates so that its error dies away, and the rest of the arm is braked where the
/// tool does not feel it.
fn torques(arm: &ArmKernel, t: f64, q: &Joints, z: &Joints) -> Result<Joints, OperationalError> {
    let [place, velocity] = error(arm, t, q, z);
    let tool = arm.frames(t, q, z)[ArmFrame::tool];
    let jacobian = in_observers_axes(&tool.pose, &tool.jacobian).fixed_rows::<3>(0).into_owned();
    let bias = in_observers_axes(&tool.pose, &tool.bias).fixed_rows::<3>(0).into_owned();
    let task = OperationalSpace::new(&arm.mass_matrix(t, q), &jacobian)?;
    let acceleration = wanted(t)[2] - 2.0 * POLE * velocity - POLE * POLE * place;
    let held = arm.nonlinear_effects(t, q, z, &Joints::zeros());
    Ok(task.forces(&jacobian, &acceleration, &bias) + held + task.null_space(&jacobian, &(-4.0 * z)))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arm = Arm { g: 9.81 }.kernel()?;
    println!("{}\n", ArmKernel::OPERATIONS);
    let start = Joints::from([0.2, 0.3, -0.2, -2.0, 0.1, 2.2, 0.4]);
    let [first, _] = error(&arm, 0.0, &start, &Joints::zeros());
    let law = |t: f64, q: &Joints, z: &Joints| torques(&arm, t, q, z).unwrap_or_else(|_| Joints::zeros());
    let path = Simulation::new(&arm).input(law).adaptive(1e-10, 1e-10).run(start, Joints::zeros(), 0.0..4.0)?;

    // ë + 2p ė + p² e = 0 from e(0) and ė(0).
    let rate = error(&arm, 0.0, &start, &Joints::zeros())[1];
    let predicted = |t: f64| (first + (rate + POLE * first) * t) * (-POLE * t).exp();
    println!("  t/s      y/mm      z/mm  error/mm  off its equation/mm");
    let mut worst = 0.0_f64;
    for n in 0..=16 {
        let sample = path.at(0.25 * f64::from(n))?;
        let [off, _] = error(&arm, sample.t, &sample.q, &sample.z);
        let place = arm.pose_of(ArmFrame::tool, sample.t, &sample.q).translation.vector;
        let missed = (off - predicted(sample.t)).norm();
        worst = worst.max(missed);
        println!(
            "{:5.2} {:9.3} {:9.3} {:9.4} {:12.1e}",
            sample.t,
            1e3 * place.y,
            1e3 * place.z,
            1e3 * off.norm(),
            1e3 * missed
        );
    }
    // Some hundred steps with a tolerance of 1e-10 each, on angles that move the tool by up to a metre.
    assert!(worst < 1e-7, "the tool is {worst:e} m off the equation of its error");
    write_page("operational_space", &page(&arm, &path)?)
}

/// The arm as its skeleton, and where its tool should be.
fn page<'k>(arm: &'k ArmKernel, path: &Trajectory<'k, ArmKernel>) -> Result<Playback<ArmKernel>, IntegrationError> {
    let goal = |s: &Sample<ArmKernel>| Isometry3::from(Translation3::from(wanted(s.t)[0]));
    let off = |s: &Sample<ArmKernel>| 1e3 * error(arm, s.t, &s.q, &s.z)[0].norm();
    let page = Playback::new("An arm draws a circle with its tool", path)?
        .si()
        .frames(arm)
        .body("base", |_| Isometry3::identity(), [Shape::cylinder(0.09, 0.06)])
        .body("where the tool should be", goal, [Shape::ball(0.015)])
        .shape("tool", Shape::cylinder(0.03, 0.04));
    let mut page = stage::chain(page, &["base", "b1", "b2", "b3", "b4", "b5", "b6", "b7", "tool"], 0.035)
        .trace("tool", [0.0; 3])
        .arrow("velocity of the tool", 0.5, |s| {
            let tool = arm.frames(s.t, &s.q, &s.z)[ArmFrame::tool].in_observers_axes();
            (tool.pose.translation.vector, tool.twist.fixed_rows::<3>(0).into())
        })
        .curve("tool from where it should be / mm", "distance", off);
    for k in [0, 1, 3] {
        let torque = move |s: &Sample<ArmKernel>| torques(arm, s.t, &s.q, &s.z).map_or(f64::NAN, |torques| torques[k]);
        page = page.curve("torque / (N m)", &format!("joint {}", k + 1), torque);
    }
    Ok(page.energy(arm))
}
