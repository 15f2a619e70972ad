//! More code than the limit allows.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(a, b),
    particle(mass = m, position = [l * sin(a), 0, -l * cos(a)]),
    particle(mass = m, position = [l * (sin(a) + sin(b)), 0, -l * (cos(a) + cos(b))]),
    limit = 10,
)]
struct DoublePendulum {
    m: f64,
    l: f64,
    #[gauss(gravity)]
    g: f64,
}

fn main() {}
