//! Constraints that no motion satisfies.

use gauss_runtime::prelude::*;

/// A distance cannot be two.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y),
    particle(mass = m, position = [x, y, 0]),
    constraint(position = x * x + y * y - 1),
    constraint(position = x * x + y * y - 4),
)]
struct TwoDistances {
    m: f64,
}

/// A body whose coordinates keep it in a plane does not leave it.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, theta),
    body(sleigh, position = [x, y, 0], rotation = rotation_z(theta)),
    constraint(velocity = sleigh.velocity.z - sleigh.angular_velocity.x - 1),
    constraint(velocity = dot(sleigh.velocity, sleigh.rotation * [0, 1, 0])),
)]
struct LeavesThePlane {
    #[gauss(body)]
    sleigh: RigidBody<f64>,
}

/// With two constraints nothing of these two speeds is left for a third.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y),
    particle(mass = m, position = [x, y, 0]),
    constraint(velocity = rate(x) - speed),
    constraint(velocity = rate(y)),
    constraint(position = x - y),
)]
struct TooMany {
    m: f64,
    speed: f64,
}

fn main() {}
