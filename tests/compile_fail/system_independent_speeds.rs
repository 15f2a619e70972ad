//! Independent speeds that are too many or too few, that do not determine the others, or that cannot.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, theta),
    speeds(v, w, omega),
    kinematics(x = v * cos(theta) - w * sin(theta), y = v * sin(theta) + w * cos(theta), theta = omega),
    body(sleigh, position = [x, y, 0], rotation = rotation_z(theta)),
    constraint(velocity = dot(sleigh.velocity, sleigh.rotation * [0, 1, 0])),
    independent(v),
)]
struct TooFew {
    #[gauss(body)]
    sleigh: RigidBody<f64>,
}

/// The edge says nothing of v.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, theta),
    speeds(v, w, omega),
    kinematics(x = v * cos(theta) - w * sin(theta), y = v * sin(theta) + w * cos(theta), theta = omega),
    body(sleigh, position = [x, y, 0], rotation = rotation_z(theta)),
    constraint(velocity = dot(sleigh.velocity, sleigh.rotation * [0, 1, 0])),
    independent(w, omega),
)]
struct Singular {
    #[gauss(body)]
    sleigh: RigidBody<f64>,
}

/// A quadratic equation has no one solution.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, z),
    speeds(vx, vy, vz),
    kinematics(x = vx, y = vy, z = vz),
    particle(mass = m, position = [x, y, z]),
    constraint(velocity = vx * vx + vy * vy + vz * vz - speed * speed),
    independent(vx, vy),
)]
struct NotAffine {
    m: f64,
    speed: f64,
}

/// The second constraint repeats the first.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, z),
    speeds(vx, vy, vz),
    kinematics(x = vx, y = vy, z = vz),
    particle(mass = m, position = [x, y, z]),
    constraint(velocity = vx - vy),
    constraint(velocity = 2 * vy - 2 * vx),
    independent(vz),
)]
struct Repeated {
    m: f64,
}

fn main() {}
