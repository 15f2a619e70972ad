//! A potential of velocities and of inputs, openly and by definition.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    motion = planar,
    input(thrust),
    define(speed = body.body_velocity.x, push = thrust * body.position.x),
    potential = k * body.velocity.x + speed * body.position.x + push,
)]
struct Body {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    j: Vector3<f64>,
    k: f64,
}

fn main() {}
