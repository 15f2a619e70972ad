//! A small satellite that turns, its star tracker, and what it is disturbed by.

use std::f64::consts::{PI, TAU};

use gauss_charts::statistics::Random;
use gauss_runtime::prelude::*;

/// A rigid satellite about its centre of mass O: the torque of its wheels, known, and one that nobody knows, both in
/// body axes.
#[derive(GaussDynamics)]
#[gauss(linearize, motion = fixed_point, input(torque: Vector3 = "N m"), torque(wheels, value = torque))]
pub struct Spacecraft {
    /// kg; without effect, because O is held.
    #[gauss(mass)]
    pub mass: f64,
    /// About O, body axes, kg m².
    #[gauss(inertia)]
    pub inertia: Matrix3<f64>,
}

/// Attitude R, body to observer, and angular velocity ω, body axes, rad/s.
pub type State = (UnitQuaternion<f64>, Vector3<f64>);

/// Seconds of a step: torques are held for that long.
pub const STEP: f64 = 1.0;
/// Steps from one look at the stars to the next.
pub const STEPS: usize = 10;
/// How often the stars are looked at.
pub const LOOKS: usize = 60;

/// A second of arc, rad.
pub const ARCSECOND: f64 = PI / 648_000.0;

/// Standard deviations of the star tracker about the body axes, rad: e₃ is where it looks, and about that it sees
/// least.
pub const TRACKER: [f64; 3] = [10.0 * ARCSECOND, 10.0 * ARCSECOND, 60.0 * ARCSECOND];

/// The unknown torque is white noise: the square root of its spectral density, about each axis, N m √s.
pub const DISTURBANCE: f64 = 1e-5;

/// What is known at first: standard deviations of the attitude, rad, and of the angular velocity, rad/s. With three
/// times as much of the latter the body would turn 3° away from the prediction until the second look, and what is of
/// second order in that would show: no extended Kalman filter knows of it.
pub const FIRST: (f64, f64) = (2.0 * PI / 180.0, 0.1 * PI / 180.0);

/// The satellite, of 30 kg.
pub fn spacecraft() -> Spacecraft {
    Spacecraft { mass: 30.0, inertia: Matrix3::new(0.90, 0.02, -0.03, 0.02, 1.10, 0.04, -0.03, 0.04, 0.60) }
}

/// About where it starts: it turns by some three degrees a second.
pub fn nominal() -> State {
    (UnitQuaternion::from_euler_angles(0.3, -0.5, 1.0), Vector3::new(0.030, -0.025, 0.035))
}

/// The torque of the wheels in a step, body axes, N m.
pub fn wheels(step: usize) -> Vector3<f64> {
    let phase = TAU * step as f64 * STEP / 240.0;
    Vector3::new(phase.sin(), (2.0 * phase).cos(), -phase.cos()) * 2e-4
}

/// Independent random components of these standard deviations.
fn vector(random: &mut Random, deviations: [f64; 3]) -> Vector3<f64> {
    Vector3::from(deviations.map(|deviation| deviation * random.normal()))
}

/// What happened: the states at each step, the first one at 0, and what the tracker saw.
pub struct Truth {
    pub samples: Vec<Sample<SpacecraftKernel>>,
    /// An attitude after each [`STEPS`] steps.
    pub looks: Vec<UnitQuaternion<f64>>,
}

impl Truth {
    /// After so many steps.
    pub fn state(&self, step: usize) -> State {
        (self.samples[step].q, self.samples[step].z)
    }
}

/// A motion from an unknown start under an unknown torque, made with steps ten times finer than those of the filters.
///
/// # Errors
/// When the run does not reach the end.
pub fn happens(kernel: &SpacecraftKernel, random: &mut Random) -> Result<Truth, IntegrationError> {
    let (q, z) = nominal();
    let deviation = |i| if i < 3 { FIRST.0 } else { FIRST.1 };
    let off = Vector6::from_fn(|i, _| deviation(i) * random.normal());
    let start = kernel.retract(&q, &z, &off);
    let (mut looks, mut steps) = (vec![], 0);
    let end = (LOOKS * STEPS) as f64 * STEP;
    // The tracker looks at the end of a step, then the torque of the next one begins.
    let run = Simulation::new(kernel).sampled(STEP, |_t, q, _z| {
        if steps > 0 && steps % STEPS == 0 {
            looks.push(q.retract(&vector(random, TRACKER)));
        }
        steps += 1;
        wheels(steps - 1) + vector(random, [DISTURBANCE / STEP.sqrt(); 3])
    });
    let samples = run.fixed_step(STEP / 10.0).every(10).run(start.0, start.1, 0.0..end)?.into_samples();
    looks.push(samples[samples.len() - 1].q.retract(&vector(random, TRACKER)));
    Ok(Truth { samples, looks })
}
