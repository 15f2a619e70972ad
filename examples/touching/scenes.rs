//! The scenes.

use gauss_runtime::prelude::*;

/// A ball over a floor.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(height),
    particle(mass = 1, position = [0, 0, height]),
    contact(floor, point = [0, 0, height], restitution = e),
)]
pub struct Ball {
    pub e: f64,
    #[gauss(gravity)]
    pub g: f64,
}

/// A block on a belt that runs along k₁, held by a spring. Friction is weaker the faster it slips (Stribeck).
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, height),
    particle(mass = m, position = [x, 0, height]),
    potential = k * x * x / 2,
    contact(belt, gap = height, slip = rate(x) - speed,
        friction = sliding + (held - sliding) * exp(-abs(rate(x) - speed) / within)),
)]
pub struct Belt {
    pub m: f64,
    pub k: f64,
    pub speed: f64,
    pub held: f64,
    pub sliding: f64,
    pub within: f64,
    #[gauss(gravity)]
    pub g: f64,
}

/// A billiard ball on its table.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(ball, position = pose.position, rotation = pose.rotation, mass = m, inertia = 0.4 * m * r * r),
    contact(table, point = ball.position, radius = r, friction = mu),
)]
pub struct Billiard {
    pub m: f64,
    pub r: f64,
    pub mu: f64,
    #[gauss(gravity)]
    pub g: f64,
}
