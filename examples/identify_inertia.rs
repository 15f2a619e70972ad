//! The inertia tensor and the centre of mass of a body from its motion:
//! `cargo run --release --example identify_inertia` (`RUNS=10` before it: fewer runs).
//!
//! A satellite stands on an air bearing, a ball joint without friction, and is shaken by known torques. Its angular
//! velocity and its attitude are measured, with noise. Two ways to its parameters, one after the other:
//!
//! 1. `#[gauss(regressor)]`: the torques are linear in first moments and inertia, `Y(q, ω, ω̇) π = torque`, a
//!    least-squares problem with one solution and no need to guess. It asks for ω̇, here the slope of parabolas through
//!    seven measured values of ω, which flatten what oscillates: the estimate is a percent off.
//! 2. `#[gauss(linearize(parameters))]`: the whole motion is fitted, parameters and initial state at once
//!    (Gauss–Newton). The derivatives of the motion by them come from `error_matrix` and `by_parameters` along it. This
//!    is the maximum-likelihood estimate; its covariance says how far it can be trusted, and many runs say whether that
//!    is true.

use std::error::Error;
use std::f64::consts::TAU;

use gauss_examples::plots::write_page;
use gauss_playback::{Playback, Shape};
use gauss_runtime::linearize::error_matrix;
use gauss_runtime::prelude::*;

/// A body on a ball joint at O.
#[derive(GaussDynamics)]
#[gauss(
    linearize(parameters),
    regressor,
    motion = fixed_point,
    input(torque: Vector3 = "N m"),
    torque(body = body, value = torque),
)]
struct Satellite {
    #[gauss(mass, unit = "kg")]
    mass: f64,
    #[gauss(center_of_mass, unit = "m")]
    center: Vector3<f64>,
    #[gauss(inertia, unit = "kg m^2")]
    inertia: Matrix3<f64>,
    #[gauss(gravity, unit = "m/s^2")]
    g: f64,
}

/// Unknown: three components of the centre of mass, six entries of the inertia tensor, beside the parameters that are
/// known, mass and gravity. In the same places the regressor has first moments and inertia.
const UNKNOWN: usize = 9;
const FIRST: usize = 1;
/// With the initial attitude (an increment) and angular velocity before them.
const FITTED: usize = 6 + UNKNOWN;

const MASS: f64 = 62.0;
const GRAVITY: f64 = 9.81;
/// Time between measurements in s, and how many there are.
const INTERVAL: f64 = 0.1;
const COUNT: usize = 600;
/// Standard deviations in each direction: of ω in rad/s, of the attitude in rad.
const NOISE: [f64; 2] = [2e-4, 1e-3];

type Attitude = UnitQuaternion<f64>;
type Unknown = SVector<f64, UNKNOWN>;
type Fitted = SVector<f64, FITTED>;

/// c, then the inertia tensor below its diagonal, column by column: the order of `PARAMETERS`.
const TRUTH: [f64; UNKNOWN] = [0.8e-3, -0.5e-3, -2.5e-3, 4.1, 0.12, -0.2, 5.3, 0.08, 6.2];

fn satellite(p: &Unknown) -> Satellite {
    Satellite {
        mass: MASS,
        center: Vector3::new(p[0], p[1], p[2]),
        inertia: Matrix3::from([[p[3], p[4], p[5]], [p[4], p[6], p[7]], [p[5], p[7], p[8]]]),
        g: GRAVITY,
    }
}

/// What the thrusters do, in N m, body axes.
fn torque(t: f64) -> Vector3<f64> {
    Vector3::new((TAU * 0.11 * t).sin(), (TAU * 0.16 * t + 1.0).sin(), (TAU * 0.05 * t + 2.0).sin()) * 0.3
}

/// What is measured at one time.
#[derive(Clone, Copy)]
struct Measured {
    attitude: Attitude,
    omega: Vector3<f64>,
}

/// A reproducible stream of normally distributed numbers (Box & Muller).
struct Normal(u64);

impl Normal {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 11) as f64 + 0.5) / (1_u64 << 53) as f64
    }

    fn vector(&mut self, deviation: f64) -> Vector3<f64> {
        Vector3::from_fn(|_, _| deviation * (-2.0 * self.uniform().ln()).sqrt() * (TAU * self.uniform()).cos())
    }
}

/// The motion at all multiples of the interval over `parts`.
fn motion(
    kernel: &SatelliteKernel,
    (q, omega): (Attitude, Vector3<f64>),
    parts: u32,
) -> Result<Vec<Sample<SatelliteKernel>>, Box<dyn Error>> {
    let end = INTERVAL * (COUNT - 1) as f64;
    let simulation = Simulation::new(kernel).input(|t: f64, _: &Attitude, _: &Vector3<f64>| torque(t));
    Ok(simulation.fixed_step(INTERVAL / f64::from(parts)).run(q, omega, 0.0..end)?.iter().copied().collect())
}

/// The torques explained by the regressor: `Σ YᵀY π = Σ Yᵀ torque`.
fn first_estimate(measured: &[Measured]) -> Result<Unknown, Box<dyn Error>> {
    // Y does not depend on the parameters that are sought: those of any body will do.
    let kernel = satellite(&Unknown::from([0.0, 0.0, 0.0, 5.0, 0.0, 0.0, 5.0, 0.0, 5.0])).kernel()?;
    let (mut normal, mut right) = (SMatrix::<f64, UNKNOWN, UNKNOWN>::zeros(), Unknown::zeros());
    for (k, window) in measured.windows(7).enumerate() {
        let t = INTERVAL * (k + 3) as f64;
        // Σ j² = 28 for j = −3 … 3.
        let slope = (-3..=3).zip(window).map(|(j, m)| m.omega * (f64::from(j) / (28.0 * INTERVAL))).sum();
        // ANCHOR: regressor
        let y = kernel.regressor(t, &window[3].attitude, &window[3].omega, &slope);
        let y = y.fixed_columns::<UNKNOWN>(FIRST);
        normal += y.transpose() * y;
        right += y.transpose() * torque(t);
        // ANCHOR_END: regressor
    }
    let mut estimate = normal.try_inverse().ok_or("the motion does not tell the parameters")? * right;
    (0..3).for_each(|i| estimate[i] /= MASS);
    Ok(estimate)
}

/// An estimate from the whole motion.
struct Fit {
    parameters: Unknown,
    covariance: SMatrix<f64, UNKNOWN, UNKNOWN>,
    /// Σ (residual/deviation)² of all measurements.
    misfit: f64,
    iterations: usize,
}

/// One step of Gauss and Newton: the increment, its covariance, and the misfit before it.
fn step(
    kernel: &SatelliteKernel,
    start: (Attitude, Vector3<f64>),
    measured: &[Measured],
) -> Result<(Fitted, SMatrix<f64, FITTED, FITTED>, f64), Box<dyn Error>> {
    const PARTS: usize = 4;
    let path = motion(kernel, start, PARTS as u32)?;
    // How an increment of attitude and ω grows, and what parameters add to it: d/dt S = F S + G.
    let growth: Vec<_> = path
        .iter()
        .map(|s| {
            let input = torque(s.t);
            let linear = kernel.linearize(s.t, &s.q, &s.z, &input);
            let mut forcing = SMatrix::<f64, 6, FITTED>::zeros();
            let by_parameters = kernel.by_parameters(s.t, &s.q, &s.z, &input);
            forcing.fixed_columns_mut::<UNKNOWN>(6).copy_from(&by_parameters.fixed_columns::<UNKNOWN>(FIRST));
            (error_matrix::<SatelliteKernel>(&linear), forcing)
        })
        .collect();
    let mut sensitivity = SMatrix::<f64, 6, FITTED>::zeros();
    sensitivity.fixed_columns_mut::<6>(0).fill_with_identity();
    let weights = NOISE.map(|deviation| deviation.powi(-2));
    let (mut normal, mut right, mut misfit) = (SMatrix::<f64, FITTED, FITTED>::zeros(), Fitted::zeros(), 0.0);
    for (k, seen) in measured.iter().enumerate() {
        let sample = &path[PARTS * k];
        let of_attitude = sample.q.difference(&seen.attitude);
        let of_omega = seen.omega - sample.z;
        for (residual, first, weight) in [(of_omega, 3, weights[0]), (of_attitude, 0, weights[1])] {
            let rows = sensitivity.fixed_rows::<3>(first);
            normal += rows.transpose() * rows * weight;
            right += rows.transpose() * residual * weight;
            misfit += residual.norm_squared() * weight;
        }
        if k + 1 < measured.len() {
            // Classical Runge–Kutta, two parts of the path a step.
            for first in (0..PARTS).step_by(2) {
                let [a, b, c] = [0, 1, 2].map(|j| &growth[PARTS * k + first + j]);
                let h = 2.0 * INTERVAL / PARTS as f64;
                let rate = |(f, g): &(SMatrix<f64, 6, 6>, SMatrix<f64, 6, FITTED>), s| f * s + g;
                let k1 = rate(a, sensitivity);
                let k2 = rate(b, sensitivity + k1 * (h / 2.0));
                let k3 = rate(b, sensitivity + k2 * (h / 2.0));
                let k4 = rate(c, sensitivity + k3 * h);
                sensitivity += (k1 + k2 * 2.0 + k3 * 2.0 + k4) * (h / 6.0);
            }
        }
    }
    let covariance = normal.try_inverse().ok_or("the motion does not tell the parameters")?;
    Ok((covariance * right, covariance, misfit))
}

fn refine(first: Unknown, measured: &[Measured]) -> Result<Fit, Box<dyn Error>> {
    let (mut parameters, mut start) = (first, (measured[0].attitude, measured[0].omega));
    for iterations in 1..=20 {
        let kernel = satellite(&parameters).kernel()?;
        let (change, covariance, misfit) = step(&kernel, start, measured)?;
        // A hundredth of a standard deviation more or less tells nothing.
        let done = (0..FITTED).all(|i| change[i].abs() < 1e-2 * covariance[(i, i)].sqrt());
        if done {
            let covariance = covariance.fixed_view::<UNKNOWN, UNKNOWN>(6, 6).into();
            return Ok(Fit { parameters, covariance, misfit, iterations });
        }
        parameters += change.fixed_rows::<UNKNOWN>(6);
        start = (start.0.retract(&change.fixed_rows::<3>(0).into()), start.1 + change.fixed_rows::<3>(3));
    }
    Err("the fit does not converge".into())
}

/// One fit, parameter by parameter.
fn report(truth: &Unknown, first: &Unknown, fit: &Fit) {
    println!("parameter                true  by torques  by motion  deviation  error/deviation");
    for i in 0..UNKNOWN {
        let name = SatelliteKernel::PARAMETERS[FIRST + i];
        let (unit, scale) = if i < 3 { ("mm", 1e3) } else { ("kg m²", 1.0) };
        let deviation = fit.covariance[(i, i)].sqrt();
        println!(
            "{name:13} {unit:6}{:9.5}  {:10.5}  {:9.5}  {:9.5}  {:15.2}",
            scale * truth[i],
            scale * first[i],
            scale * fit.parameters[i],
            scale * deviation,
            (fit.parameters[i] - truth[i]) / deviation
        );
    }
    println!("(Gauss–Newton: {} iterations)\n", fit.iterations);
}

/// The motion as a page that plays.
fn write(truth: &Unknown, body: &SatelliteKernel, path: Vec<Sample<SatelliteKernel>>) -> Result<(), Box<dyn Error>> {
    let page = Playback::of_samples("A satellite on an air bearing, shaken to tell its inertia", path)
        .si()
        .body(
            "satellite",
            |s| Isometry3::from_parts(Translation3::identity(), s.q),
            [Shape::of_inertia(MASS, [truth[0], truth[1], truth[2]], &satellite(truth).inertia)],
        )
        .trace("satellite", [0.0, 0.0, 0.5])
        .arrow("torque", 2.0, |s| (Vector3::zeros(), s.q * torque(s.t)))
        .arrow("angular velocity", 0.8, |s| (Vector3::zeros(), s.q * s.z))
        .curve("angular velocity / (rad/s)", "ω₁", |s| s.z[0])
        .curve("angular velocity / (rad/s)", "ω₂", |s| s.z[1])
        .curve("angular velocity / (rad/s)", "ω₃", |s| s.z[2]);
    write_page("identify_inertia", &page.energy(body))
}

fn main() -> Result<(), Box<dyn Error>> {
    let truth = Unknown::from(TRUTH);
    let body = satellite(&truth).kernel()?;
    let start = (Attitude::from_euler_angles(0.05, -0.1, 0.3), Vector3::new(0.02, 0.05, -0.1));
    // Finer than what the fits use.
    let exact: Vec<Measured> =
        motion(&body, start, 16)?.iter().step_by(16).map(|s| Measured { attitude: s.q, omega: s.z }).collect();
    let fastest = exact.iter().map(|m| m.omega.norm()).fold(0.0, f64::max);
    println!(
        "A body of {MASS} kg on a ball joint, shaken for {:.0} s; at most {fastest:.2} rad/s.\n\
         {COUNT} measurements: ω to {:.0e} rad/s, attitude to {:.0e} rad (standard deviations in each direction).\n",
        INTERVAL * (COUNT - 1) as f64,
        NOISE[0],
        NOISE[1]
    );

    write(&truth, &body, motion(&body, start, 4)?)?;

    let runs = gauss_examples::runs(50);
    let (mut distance, mut misfit) = (0.0, 0.0);
    for run in 0..runs {
        let mut normal = Normal(run as u64 + 1);
        let with_noise = |m: &Measured| Measured {
            attitude: m.attitude.retract(&normal.vector(NOISE[1])),
            omega: m.omega + normal.vector(NOISE[0]),
        };
        let measured: Vec<Measured> = exact.iter().map(with_noise).collect();
        let first = first_estimate(&measured)?;
        let fit = refine(first, &measured)?;
        let error = fit.parameters - truth;
        let information = fit.covariance.try_inverse().ok_or("a covariance is singular")?;
        distance += error.dot(&(information * error));
        misfit += fit.misfit;
        if run == 0 {
            report(&truth, &first, &fit);
        }
    }

    // χ² of k degrees of freedom has the mean k and the deviation √(2k); sums over runs have those of all together.
    let consistent = |what: &str, sum: f64, freedom: usize| {
        let (mean, deviation) = ((runs * freedom) as f64, (2.0 * (runs * freedom) as f64).sqrt());
        let away = (sum - mean) / deviation;
        println!(
            "{what}: χ² is {:.2} a run, expected {freedom} ± {:.2} ({away:+.1} deviations)",
            sum / runs as f64,
            deviation / runs as f64
        );
        away.abs() < 3.0
    };
    println!("{runs} runs with noise of their own:");
    let estimates = consistent("errors of the nine parameters, by their covariance", distance, UNKNOWN);
    let residuals = consistent("what is left of the measurements, by their noise", misfit, 6 * COUNT - FITTED);
    if estimates && residuals { Ok(()) } else { Err("the errors are not what the covariance says".into()) }
}
