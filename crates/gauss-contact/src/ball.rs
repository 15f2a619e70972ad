//! Friction of one contact among known forces: a quadratic form in a ball.

use alloc::vec;
use alloc::vec::Vec;

use crate::dense::{Decomposition, Matrix, dot, norm};

/// The f of `|f| ≤ largest` that makes `½ fᵀDf + wᵀf` least. Where that is on the sphere, `(D + m) f = −w` with an m >
/// 0, which Newton's method finds from below (J. J. Moré & D. C. Sorensen 1983).
pub(crate) fn least_in_ball(d: &Matrix, w: &[f64], largest: f64) -> Vec<f64> {
    let against: Vec<f64> = w.iter().map(|w| -w).collect();
    let (mut more, mut found) = (0.0, vec![0.0; w.len()]);
    // It needs no more than some ten steps.
    for _ in 0..if largest > 0.0 { 50 } else { 0 } {
        let matrix = Matrix::from_fn(w.len(), |a, b| d.at(a, b) + if a == b { more } else { 0.0 });
        let factors = Decomposition::new(&matrix, |a| matrix.at(a, a));
        found = factors.solve(&against);
        let length = norm(&found);
        let beyond = length / largest - 1.0;
        if (more == 0.0 && beyond <= 0.0) || beyond.abs() <= 8.0 * f64::EPSILON {
            break;
        }
        let next = more + beyond * length * length / dot(&found, &factors.solve(&found));
        if !(next > more && next.is_finite()) {
            break;
        }
        more = next;
    }
    let length = norm(&found);
    let part = if length > largest { largest / length } else { 1.0 };
    found.into_iter().map(|f| part * f).collect()
}

#[cfg(test)]
#[path = "ball_tests.rs"]
mod tests;
