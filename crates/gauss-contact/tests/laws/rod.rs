//! A rod on its ends: of two programs of tests.

use gauss_runtime::prelude::*;

/// A rod on its ends.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, a),
    body(bar, position = [x, 0, y], rotation = rotation_y(a), mass = m, inertia = j),
    contact(foot, gap = y - l * sin(a), slip = rate(x + l * cos(a)), friction = mu, restitution = e),
    contact(head, gap = y + l * sin(a), slip = rate(x - l * cos(a)), friction = mu, restitution = e),
)]
pub struct Rod {
    pub m: f64,
    pub j: f64,
    pub l: f64,
    pub mu: f64,
    pub e: f64,
    #[gauss(gravity)]
    pub g: f64,
}
