//! The inertia tensor and the centre of mass of a body from its motion:
//! `cargo run --release --example identify_inertia` (`RUNS=10` before it: fewer runs).
//!
//! A satellite stands on an air bearing, a ball joint without friction, and is shaken by known torques. Its angular
//! velocity and its attitude are measured, with noise. Two ways to its parameters, one after the other:
//!
//! 1. `#[gauss(regressor)]`: the torques are linear in first moments and inertia, `Y(q, ω, ω̇) π = torque`, a
//!    least-squares problem with one solution and no need to guess. It asks for ω̇, here the slope of parabolas
//!    through seven measured values of ω, which flatten what oscillates: the estimate is a percent off.
//! 2. `gauss-sensitivity`: the whole motion is fitted, parameters and initial state at once (Gauss–Newton), with the
//!    derivatives of the run by all of them. This is the maximum-likelihood estimate; its covariance says how far it
//!    can be trusted, and many runs say whether that is true.

use std::error::Error;
use std::f64::consts::TAU;

use gauss_examples::plots::write_page;
use gauss_playback::{Playback, Shape};
use gauss_runtime::integrate::Fixed;
use gauss_runtime::prelude::*;
use gauss_sensitivity::{At, Derivatives, Fit, Residuals, Run, Start, constant};

/// A body on a ball joint at O.
#[derive(GaussDynamics)]
#[gauss(
    regressor,
    motion = fixed_point,
    input(torque: Vector3 = "N m"),
    torque(body = body, value = torque),
)]
struct Satellite<T> {
    #[gauss(mass, unit = "kg")]
    mass: T,
    #[gauss(center_of_mass, unit = "m")]
    center: Vector3<T>,
    #[gauss(inertia, unit = "kg m^2")]
    inertia: Matrix3<T>,
    #[gauss(gravity, unit = "m/s^2")]
    g: T,
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
type Kernel = SatelliteKernel<f64>;

/// c, then the inertia tensor below its diagonal, column by column.
const NAMES: [&str; UNKNOWN] =
    ["c[0]", "c[1]", "c[2]", "I[0][0]", "I[1][0]", "I[2][0]", "I[1][1]", "I[2][1]", "I[2][2]"];
const TRUTH: [f64; UNKNOWN] = [0.8e-3, -0.5e-3, -2.5e-3, 4.1, 0.12, -0.2, 5.3, 0.08, 6.2];

fn satellite<T: Real>(p: &[T; UNKNOWN]) -> Satellite<T> {
    Satellite {
        mass: T::from_f64(MASS),
        center: Vector3::new(p[0], p[1], p[2]),
        inertia: Matrix3::from([[p[3], p[4], p[5]], [p[4], p[6], p[7]], [p[5], p[7], p[8]]]),
        g: T::from_f64(GRAVITY),
    }
}

/// What the thrusters do, in N m, body axes.
fn torque<T: Real>(t: T) -> Vector3<T> {
    let wave = |[rate, phase]: [f64; 2]| T::from_f64(0.3) * (T::from_f64(TAU * rate) * t + T::from_f64(phase)).sin();
    SVector::from([[0.11, 0.0], [0.16, 1.0], [0.05, 2.0]].map(wave))
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
    kernel: &Kernel,
    (q, omega): (Attitude, Vector3<f64>),
    parts: u32,
) -> Result<Vec<Sample<Kernel>>, Box<dyn Error>> {
    let end = INTERVAL * (COUNT - 1) as f64;
    let simulation = Simulation::new(kernel).input(|t: f64, _: &Attitude, _: &Vector3<f64>| torque(t));
    Ok(simulation.fixed_step(INTERVAL / f64::from(parts)).run(q, omega, 0.0..end)?.iter().copied().collect())
}

/// The torques explained by the regressor: `Σ YᵀY π = Σ Yᵀ torque`.
fn first_estimate(measured: &[Measured]) -> Result<Unknown, Box<dyn Error>> {
    // Y does not depend on the parameters that are sought: those of any body will do.
    let kernel = satellite(&[0.0, 0.0, 0.0, 5.0, 0.0, 0.0, 5.0, 0.0, 5.0]).kernel()?;
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

// ANCHOR: run
/// The motion by an increment of the first attitude that was measured, the first angular velocity, c and the inertia.
struct Recorded<'m> {
    times: &'m [f64],
    measured: &'m [Measured],
}

impl Run<FITTED> for Recorded<'_> {
    type System<T: Real> = SatelliteKernel<T>;

    fn instants(&self) -> &[f64] {
        self.times
    }

    fn system<T: Real>(&self, numbers: &[T; FITTED]) -> Result<SatelliteKernel<T>, ParameterError> {
        satellite(&std::array::from_fn(|i| numbers[6 + i])).kernel()
    }

    fn start<T: Real>(&self, numbers: &[T; FITTED], _: &SatelliteKernel<T>) -> Start<SatelliteKernel<T>> {
        let attitude: UnitQuaternion<T> = constant(&self.measured[0].attitude);
        let three = |first: usize| SVector::from(std::array::from_fn(|i| numbers[first + i]));
        (attitude.retract(&three(0)), three(3))
    }

    fn input<T: Real>(&self, _: &[T; FITTED], at: &At<'_, SatelliteKernel<T>>) -> Vector3<T> {
        torque(at.t)
    }
}

impl Residuals<FITTED, 6> for Recorded<'_> {
    fn residuals<T: Real>(&self, _: &[T; FITTED], at: &At<'_, SatelliteKernel<T>>) -> [T; 6] {
        let seen = &self.measured[at.number];
        let of_attitude = constant::<_, UnitQuaternion<T>>(&seen.attitude).difference(at.q);
        std::array::from_fn(|i| match i {
            0..3 => (at.z[i] - T::from_f64(seen.omega[i])) / T::from_f64(NOISE[0]),
            _ => of_attitude[i - 3] / T::from_f64(NOISE[1]),
        })
    }
}

fn refine(first: &Unknown, times: &[f64], measured: &[Measured]) -> Result<Fit<FITTED>, Box<dyn Error>> {
    let omega = measured[0].omega;
    let guess = std::array::from_fn(|i| match i {
        0..3 => 0.0,
        3..6 => omega[i - 3],
        _ => first[i - 6],
    });
    let derivatives = Derivatives::by(Fixed::by(RungeKutta(Classical4), INTERVAL / 2.0));
    Ok(derivatives.fit(&[Recorded { times, measured }], &guess)?)
}
// ANCHOR_END: run

/// One fit, parameter by parameter.
fn report(truth: &Unknown, first: &Unknown, fit: &Fit<FITTED>) {
    println!("parameter                true  by torques  by motion  deviation  error/deviation");
    for i in 0..UNKNOWN {
        let (unit, scale) = if i < 3 { ("mm", 1e3) } else { ("kg m²", 1.0) };
        let (deviation, found) = (fit.deviations()[6 + i], fit.numbers[6 + i]);
        println!(
            "{:13} {unit:6}{:9.5}  {:10.5}  {:9.5}  {:9.5}  {:15.2}",
            NAMES[i],
            scale * truth[i],
            scale * first[i],
            scale * found,
            scale * deviation,
            (found - truth[i]) / deviation
        );
    }
    println!("(Gauss–Newton: {} iterations)\n", fit.iterations);
}

/// The motion as a page that plays.
fn write(body: &Kernel, path: Vec<Sample<Kernel>>) -> Result<(), Box<dyn Error>> {
    let page = Playback::of_samples("A satellite on an air bearing, shaken to tell its inertia", path)
        .si()
        .body(
            "satellite",
            |s| Isometry3::from_parts(Translation3::identity(), s.q),
            [Shape::of_inertia(MASS, [TRUTH[0], TRUTH[1], TRUTH[2]], &satellite(&TRUTH).inertia)],
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
    let body = satellite(&TRUTH).kernel()?;
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

    write(&body, motion(&body, start, 4)?)?;

    let times: Vec<f64> = (0..COUNT).map(|k| INTERVAL * k as f64).collect();
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
        let fit = refine(&first, &times, &measured)?;
        let error = SVector::from(fit.numbers).fixed_rows::<UNKNOWN>(6) - truth;
        let covariance: SMatrix<f64, UNKNOWN, UNKNOWN> = fit.covariance.fixed_view::<UNKNOWN, UNKNOWN>(6, 6).into();
        let information = covariance.try_inverse().ok_or("a covariance is singular")?;
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
