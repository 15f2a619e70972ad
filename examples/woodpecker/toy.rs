//! The scene.

use gauss_runtime::prelude::*;

/// A sleeve with play on a pole and a bird on a spring. Angles are small: heights and gaps are linear in them, as in
/// the paper.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(y, sleeve, bird),
    body(ring, position = [0, 0, y], rotation = rotation_y(-sleeve), mass = 0.0003, inertia = 5e-9),
    body(pecker, position = [0, 0, y + lm * sleeve + lg * bird], rotation = rotation_y(-bird),
         mass = 0.0045, inertia = 7e-7),
    potential = c * (sleeve - bird) * (sleeve - bird) / 2,
    contact(beak, gap = lm + lg - ls - r - hs * bird, slip = rate(y + lm * sleeve + (lg - ls) * bird),
        friction = mu, restitution = 0.5),
    contact(lower, gap = rm - r + hm * sleeve, slip = rate(y + rm * sleeve), friction = mu),
    contact(upper, gap = rm - r - hm * sleeve, slip = rate(y + rm * sleeve), friction = mu),
)]
pub struct Woodpecker {
    /// Stiffness of the spring, N m.
    pub c: f64,
    /// Radius of the pole, m.
    pub r: f64,
    /// Inner radius of the sleeve, half its height.
    pub rm: f64,
    pub hm: f64,
    /// From the pole to the spring, from the spring to the bird.
    pub lm: f64,
    pub lg: f64,
    /// Height and length of the beak from the bird's centre.
    pub hs: f64,
    pub ls: f64,
    pub mu: f64,
    #[gauss(gravity)]
    pub g: f64,
}

/// The published toy.
pub const TOY: Woodpecker = Woodpecker {
    c: 0.0056,
    r: 0.0025,
    rm: 0.0031,
    hm: 0.0058,
    lm: 0.010,
    lg: 0.015,
    hs: 0.020,
    ls: 0.0201,
    mu: 0.3,
    g: 9.81,
};
