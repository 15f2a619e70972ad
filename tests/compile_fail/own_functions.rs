//! Functions of the user's own and tables: what is not said of them, and where they cannot stand.

use gauss_runtime::prelude::*;

const POINTS: [[f64; 2]; 2] = [[0.0, 1.0], [1.0, 0.0]];

fn lift(x: f64) -> f64 {
    x * x
}

/// A force is the derivative of its potential.
#[derive(GaussDynamics)]
#[gauss(coordinates(x), particle(mass = 1, position = [x, 0, 0]), function(lift), potential = lift(x))]
struct WithoutDerivative {
    k: f64,
}

#[derive(GaussDynamics)]
#[gauss(coordinates(x), particle(mass = 1, position = [x, 0, 0]), table(line, points = POINTS), potential = line(x))]
struct Kinked {
    k: f64,
}

#[derive(GaussDynamics)]
#[gauss(coordinates(x), particle(mass = 1, position = [x, 0, 0]), drive(x = asin(2) + powf(-1, 0.3)))]
struct OutsideDomains {
    k: f64,
}

#[derive(GaussDynamics)]
#[gauss(coordinates(x), particle(mass = 1, position = [x, 0, 0]), drive(x = lift(x)))]
struct Undeclared {
    k: f64,
}

fn main() {}
