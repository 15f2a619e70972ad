//! Units in a system: constants of springs and stops, masses, positions, drives of anything.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, theta),
    input(push = "N"),
    body(arm, position = [x, k, 0], rotation = rotation_z(theta)),
    particle(mass = l, position = [l * sin(theta), 0, x / 2]),
    point(tip, body = arm, at = [l, 0, 0]),
    spring(from = [0, 0, 0], to = tip, stiffness = c, length = l, damping = c),
    spring(along = atan2(tip.y, tip.x), stiffness = k),
    force(at = tip, value = [push, min(push, l), rate(tip.z)]),
    drive(theta = push * l, x = push + l),
    damping = k * dot(arm.velocity, arm.velocity),
)]
struct Scene {
    #[gauss(body)]
    arm: RigidBody<f64>,
    #[gauss(unit = "m")]
    l: f64,
    #[gauss(unit = "N/m")]
    k: f64,
    #[gauss(unit = "N s/m")]
    c: f64,
}

fn main() {}
