//! Bodies in a game: steps of one length, however fast frames come, and poses between them:
//! `cargo run --release --example game_loop`.
//!
//! What happens must not depend on the machine that draws it: after the same number of steps the state is the same to
//! the last bit at 30, 60 or 144 frames a second. What is drawn is between the last two states; how wrong that is is
//! known: ⅛ h² times the acceleration.

use std::error::Error;

use gauss_examples::plots::write_page;
use gauss_playback::{Playback, Shape};
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

/// The state before and after the step that is going on.
// ANCHOR: world
struct World {
    kernel: CrateKernel,
    before: (Isometry3<f64>, Vector6<f64>),
    now: (Isometry3<f64>, Vector6<f64>),
    steps: u32,
    /// Time that has passed and is not simulated yet.
    left: f64,
}

impl World {
    /// A frame took so long: steps until less than one is left.
    fn pass(&mut self, seconds: f64) -> Result<(), IntegrationError> {
        self.left += seconds;
        while self.left >= STEP {
            let (q, z) = self.now;
            let next = Simulation::new(&self.kernel).fixed_step(STEP).run_to_end(q, z, 0.0..STEP)?;
            (self.before, self.now) = (self.now, (next.q, next.z));
            self.steps += 1;
            self.left -= STEP;
        }
        Ok(())
    }

    /// What is drawn, one step late: the place on the line between both, the attitude on the great circle.
    fn drawn(&self) -> Isometry3<f64> {
        self.before.0.lerp_slerp(&self.now.0, self.left / STEP)
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
        let mut world = World { kernel, before: start, now: start, steps: 0, left: 0.0 };
        let (mut frame, mut worst) = (0_u32, [0.0_f64; 2]);
        while world.steps < 240 {
            // No frame is as long as the other.
            frame += 1;
            world.pass((1.0 + 0.4 * f64::from(frame).sin()) / rate)?;
            let shown = (f64::from(world.steps) - 1.0) * STEP + world.left;
            if world.steps > 0 {
                let (drawn, true_one) = (world.drawn(), exact.at(shown)?.q);
                let away = (drawn.translation.vector - true_one.translation.vector).norm();
                worst = [worst[0].max(away), worst[1].max(drawn.rotation.angle_to(&true_one.rotation))];
            }
        }
        println!("{rate:5} Hz: {frame} frames, drawn wrong by at most {:.1e} m, {:.1e} rad", worst[0], worst[1]);
        // A parabola is above its chord by g h²/8 in the middle, and nowhere by more.
        let sag = 0.125 * g * STEP * STEP;
        // ω̇ is at most (I₃ − I₁)/I₁ · ½ω², and ω² at most 2T/I₁ = 66 s⁻².
        if worst[0] > sag * (1.0 + 1e-6) || worst[1] > 0.125 * 50.0 * STEP * STEP {
            return Err("what is drawn is not between the states".into());
        }
        while world.steps < 250 {
            world.pass(STEP)?;
        }
        let (q, z) = world.now;
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
