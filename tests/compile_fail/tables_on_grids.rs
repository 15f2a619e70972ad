//! Tables on grids: axes that do not increase, values of another shape or none, numbers of arguments, derivatives.

use gauss_runtime::prelude::*;

const ALPHA: [f64; 3] = [-0.1, 0.0, 0.2];
const MACH: [f64; 2] = [0.9, 0.5];
const SPEED: [f64; 2] = [0.5, 0.9];
const LIFT: [[f64; 2]; 3] = [[-0.5, -0.6], [0.0, 0.0], [1.0, 1.2]];
const TURNED: [[f64; 3]; 2] = [[0.0; 3]; 2];
const HOLLOW: [[f64; 2]; 3] = [[-0.5, -0.6], [0.0, f64::NAN], [1.0, 1.2]];

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y), particle(mass = 1, position = [x, y, 0]),
    table(lift, axes = [ALPHA, MACH], values = LIFT), drive(x = lift(x, y)),
)]
struct Unordered {
    k: f64,
}

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y), particle(mass = 1, position = [x, y, 0]),
    table(lift, axes = [ALPHA, SPEED], values = TURNED), drive(x = lift(x, y)),
)]
struct Turned {
    k: f64,
}

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y), particle(mass = 1, position = [x, y, 0]),
    table(lift, axes = [ALPHA, SPEED], values = HOLLOW, kind = hermite), drive(x = lift(x, y)),
)]
struct Hollow {
    k: f64,
}

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y), particle(mass = 1, position = [x, y, 0]),
    table(lift, axes = [ALPHA, SPEED], values = LIFT, kind = spline), table(drag, axes = [ALPHA, SPEED]),
    table(side, axes = [ALPHA, SPEED], values = LIFT), drive(x = side(x)), potential = side(x, y),
)]
struct Several {
    k: f64,
}

fn main() {}
