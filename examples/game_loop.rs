//! Bodies in a game: steps of one length, however fast frames come, and poses between them:
//! `cargo run --release --example game_loop`.
//!
//! What happens must not depend on the machine that draws it: after the same number of steps the state is the same to
//! the last bit at 30, 60 or 144 frames a second. What is drawn is the state at the time of the frame, within the last
//! step and as exact as the steps are.

use std::error::Error;

use gauss_examples::plots::write_page;
use gauss_playback::{Playback, Shape};
use gauss_runtime::integrate::{Fixed, Stepper, SystemProblem};
use gauss_runtime::prelude::*;

/// A crate that was thrown, and tumbles.
#[derive(GaussDynamics)]
#[gauss(chart = hybrid)]
struct Crate {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
    #[gauss(gravity)]
    g: f64,
}

/// Seconds of a step.
const STEP: f64 = 1.0 / 120.0;

// ANCHOR: world
/// A run that is as far as the frames are, or a part of a step further.
struct World<'k> {
    run: Stepper<SystemProblem<'k, CrateKernel>, Fixed<f64>>,
    /// The time of the frame.
    shown: f64,
}

impl World<'_> {
    /// A frame took so long: what is drawn now. Steps are made as they are needed.
    fn pass(&mut self, seconds: f64) -> Result<Isometry3<f64>, IntegrationError> {
        self.shown += seconds;
        Ok(self.run.reach(self.shown)?.q)
    }
}
// ANCHOR_END: world

fn main() -> Result<(), Box<dyn Error>> {
    let g = 9.81;
    let kernel = Crate { mass: 2.0, inertia: Vector3::new(0.1, 0.2, 0.25), g }.kernel()?;
    let start = (Isometry3::translation(0.0, 0.0, 1.0), Vector6::new(3.0, 0.0, 6.0, 2.0, 0.1, 5.0));
    let exact = Simulation::new(&kernel).adaptive(1e-12, 1e-12).run(start.0, start.1, 0.0..3.0)?;

    let mut seen = Vec::new();
    for rate in [30.0, 60.0, 144.0] {
        let run = Simulation::new(&kernel).fixed_step(STEP).stepper(start.0, start.1, 0.0..3.0)?;
        let mut world = World { run, shown: 0.0 };
        let (mut frame, mut worst) = (0_u32, [0.0_f64; 2]);
        while world.run.summary().steps < 240 {
            // No frame is as long as the other.
            frame += 1;
            let drawn = world.pass((1.0 + 0.4 * f64::from(frame).sin()) / rate)?;
            let true_one = exact.at(world.shown)?.q;
            let away = (drawn.translation.vector - true_one.translation.vector).norm();
            worst = [worst[0].max(away), worst[1].max(drawn.rotation.angle_to(&true_one.rotation))];
        }
        println!("{rate:5} Hz: {frame} frames, drawn wrong by at most {:.1e} m, {:.1e} rad", worst[0], worst[1]);
        // Steps of order 8 turn the crate by 0.05 rad, with errors of that to the ninth; the rest is the tolerance of
        // the exact run over a dozen steps.
        if worst.into_iter().any(|wrong| wrong > 1e-9) {
            return Err("what is drawn is not the motion".into());
        }
        while world.run.summary().steps < 250 {
            world.run.step()?;
        }
        let Sample { q, z, .. } = world.run.state();
        let numbers = q.translation.vector.iter().chain(q.rotation.coords.iter()).chain(&z);
        seen.push(numbers.map(|number| number.to_bits()).collect::<Vec<_>>());
    }
    if seen.windows(2).any(|pair| pair[0] != pair[1]) {
        return Err("the motion depends on the frames".into());
    }
    println!("after 250 steps: the same bits at all rates");
    // The edges of a uniform box with these moments.
    let page = Playback::new("A crate that was thrown", &exact)?
        .si()
        .body("crate", |s| s.q, [Shape::cuboid([1.05_f64.sqrt(), 0.45_f64.sqrt(), 0.15_f64.sqrt()])])
        .follow("crate")
        .trace("crate", [0.0; 3])
        .trace("crate", [0.5, 0.0, 0.0])
        .arrow("velocity", 0.2, |s| (s.q.translation.vector, s.z.fixed_rows::<3>(0).into()))
        .arrow("angular velocity", 0.2, |s| {
            (s.q.translation.vector, s.q.rotation * Vector3::from(s.z.fixed_rows::<3>(3)))
        });
    write_page("game_loop", &page.energy(&kernel))
}
