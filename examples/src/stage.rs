//! What several pages that play show: a cart with its pole, links as rods.

use gauss_playback::{Playback, Shape};
use gauss_runtime::prelude::*;

/// A cart at q₁ along k₁, a pole of a length on it at the angle q₂ from upright, and the push on the cart, N, drawn so
/// many metres long for each newton.
#[must_use]
pub fn cart_and_pole<S>(
    page: Playback<S>,
    length: f64,
    metres_per_newton: f64,
    push: impl Fn(&Sample<S>) -> f64,
) -> Playback<S>
where
    S: GaussSystem<Scalar = f64, Configuration = SVector<f64, 2>>,
{
    let cart = |s: &Sample<S>| Isometry3::translation(s.q[0], 0.0, 0.0);
    let pole = |s: &Sample<S>| cart(s) * Isometry3::rotation(Vector3::y() * s.q[1]);
    // Before the cart, so that both are seen.
    let bob = [0.0, -0.12, length];
    page.from_the_side()
        .body("cart", cart, [Shape::cuboid([0.4, 0.2, 0.12])])
        .body(
            "pole",
            pole,
            [Shape::rod([0.0, -0.12, 0.0], bob, 0.012), Shape::ball(0.06).at(&Translation3::from(bob).into())],
        )
        .trace("pole", bob)
        .arrow("push", metres_per_newton, |s| (cart(s).translation.vector, Vector3::x() * push(s)))
        .curve("push / N", "u", &push)
        .curve("angle from upright / °", "θ", |s| s.q[1].to_degrees())
}

/// Rods from each of these bodies to the next one.
#[must_use]
pub fn chain<S: GaussSystem<Scalar = f64>>(page: Playback<S>, bodies: &[&str], radius: f64) -> Playback<S> {
    bodies.windows(2).fold(page, |page, pair| page.rod(pair[0], pair[1], radius))
}
