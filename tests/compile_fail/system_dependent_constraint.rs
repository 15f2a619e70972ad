//! One constraint too many: its multiplier would be undetermined.

use gauss_runtime::prelude::*;

/// The second constraint is the first, multiplied.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y),
    particle(mass = m, position = [x, y, 0]),
    constraint(position = x * x + y * y - l * l),
    constraint(position = 2 * l * l - 2 * x * x - 2 * y * y),
)]
struct Twice {
    m: f64,
    l: f64,
}

/// A rod on two particles that is held at its length, and the loop closed by its components once more.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, u, v),
    particle(mass = m, position = [x, y, 0]),
    particle(mass = m, position = [u, v, 0]),
    constraint(velocity = rate(x) - rate(u)),
    constraint(velocity = rate(y) - rate(v)),
    constraint(velocity = (x - u) * (rate(x) - rate(u)) + (y - v) * (rate(y) - rate(v))),
)]
struct Loop {
    m: f64,
}

/// The speeds do what the constraint asks.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, theta),
    speeds(v, omega),
    kinematics(x = v * cos(theta), y = v * sin(theta), theta = omega),
    body(sleigh, position = [x, y, 0], rotation = rotation_z(theta)),
    constraint(velocity = dot(sleigh.velocity, sleigh.rotation * [0, 1, 0])),
)]
struct Sleigh {
    #[gauss(body)]
    sleigh: RigidBody<f64>,
}

/// The centre is as high as the constraint has it.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, phi, theta, psi),
    body(
        disk,
        position = [x, y, r * sin(theta)],
        rotation = rotation_z(phi) * rotation_x(theta) * rotation_z(psi),
    ),
    constraint(velocity = disk.velocity.z - r * cos(theta) * rate(theta)),
)]
struct Disk {
    #[gauss(body)]
    disk: RigidBody<f64>,
    r: f64,
}

fn main() {}
