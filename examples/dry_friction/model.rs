//! What is modelled: dry friction of joints by clauses.

use std::f64::consts::PI;

use gauss_runtime::prelude::*;

/// A mass on a spring on a floor.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x),
    particle(mass = m, position = [x, 0, 0]),
    spring(coil, along = x, stiffness = k),
    dry_friction(x, bound = f),
)]
pub struct Slider {
    #[gauss(unit = "kg")]
    pub m: f64,
    #[gauss(unit = "N/m")]
    pub k: f64,
    #[gauss(unit = "N")]
    pub f: f64,
}

/// Where the slider is let go, in units of f/k: it turns ten times, the last time at half a unit, where it stays.
const RELEASED: f64 = 19.5;
/// Half swings until then.
pub const SWINGS: f64 = 10.0;

impl Slider {
    /// ω = 10 /s.
    pub fn desk() -> Self {
        Self { m: 0.4, k: 40.0, f: 0.2 }
    }

    /// The time of a half swing, s.
    pub fn half_swing(&self) -> f64 {
        PI * (self.m / self.k).sqrt()
    }

    /// The exact position, m: each half swing is a half of a cosine about ±f/k, and so takes 2f/k
    /// from the amplitude (any textbook of vibrations).
    pub fn exact(&self, t: f64) -> f64 {
        let swing = (t / self.half_swing()).floor().min(SWINGS);
        let sign = if swing % 2.0 == 0.0 { 1.0 } else { -1.0 };
        let turned = sign * (RELEASED - 2.0 * swing);
        let phase = PI * (t / self.half_swing() - swing);
        let units = if swing == SWINGS { turned } else { sign + (turned - sign) * phase.cos() };
        units * self.f / self.k
    }
}

/// Two rods in the vertical plane, dry friction in shoulder and elbow.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(shoulder, elbow),
    frames(upper, lower),
    body(upper, rotation = rotation_y(shoulder), mass = 2, center_of_mass = [0, 0, -0.2],
         inertia_about_center_of_mass = 0.027),
    body(lower, parent = upper, position = [0, 0, -0.4], rotation = rotation_y(elbow), mass = 1,
         center_of_mass = [0, 0, -0.15], inertia_about_center_of_mass = 0.0075),
    dry_friction(shoulder, bound = f_shoulder),
    dry_friction(elbow, bound = f_elbow),
)]
pub struct Arm {
    #[gauss(gravity, unit = "m/s^2")]
    pub g: f64,
    #[gauss(unit = "N m")]
    pub f_shoulder: f64,
    #[gauss(unit = "N m")]
    pub f_elbow: f64,
}

/// The same with the friction made smooth over the rate `creep`.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(shoulder, elbow),
    body(upper, rotation = rotation_y(shoulder), mass = 2, center_of_mass = [0, 0, -0.2],
         inertia_about_center_of_mass = 0.027),
    body(lower, parent = upper, position = [0, 0, -0.4], rotation = rotation_y(elbow), mass = 1,
         center_of_mass = [0, 0, -0.15], inertia_about_center_of_mass = 0.0075),
    friction(in_shoulder, along = shoulder, dry = f_shoulder, width = creep),
    friction(in_elbow, along = elbow, dry = f_elbow, width = creep),
)]
pub struct SmoothArm {
    #[gauss(gravity, unit = "m/s^2")]
    pub g: f64,
    #[gauss(unit = "N m")]
    pub f_shoulder: f64,
    #[gauss(unit = "N m")]
    pub f_elbow: f64,
    #[gauss(unit = "rad/s")]
    pub creep: f64,
}
