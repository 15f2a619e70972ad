use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(
    coordinates(a, b),
    particle(mass = m, position = [l * sin(a + b), 0, -l * cos(a + b)]),
)]
struct Dependent {
    m: f64,
    l: f64,
}

fn main() {}
