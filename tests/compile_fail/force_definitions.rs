//! Definitions that name later ones, themselves, and what their uses forbid.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    define(a = b * k, b = 2 * k, c = c),
    define(u = body.relative_velocity, kink = signum(u.x)),
    drag(linear = [a, b, c, 0, 0, 0]),
    damping = k * kink * u.x,
    force(at = u, value = [rate(u.x), 0, 0]),
)]
struct Body {
    #[gauss(mass)]
    m: f64,
    #[gauss(inertia)]
    j: Vector3<f64>,
    k: f64,
}

fn main() {}
