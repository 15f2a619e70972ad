//! Constraints that say nothing about motion, or not what they are meant to say.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y),
    speeds(v, w),
    kinematics(x = v, y = w),
    particle(mass = m, position = [x, y, 0]),
    constraint(position = v - w),
    constraint(velocity = x - y),
    constraint(position = l),
    constraint(velocity = rate(v)),
    constraint(position = rate(x)),
    constraint(velocity = v - [w, 0, 0]),
    constraint(velocty = v),
    constraint(x - y),
)]
struct Scene {
    m: f64,
    l: f64,
}

fn main() {}
