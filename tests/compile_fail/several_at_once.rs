//! Every mistake of a struct is reported in one compilation.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(chart = hybird, motion = planer, bogus)]
struct Body {
    #[gauss(mas)]
    mass: f64,
    #[gauss(center_of_mass)]
    center: f64,
    #[gauss(inertia)]
    inertia: Matrix6<f64>,
    #[gauss(displaced_mass)]
    displaced: f64,
    #[gauss(gravity, gravity)]
    g: f64,
}

fn main() {}
