//! Forces that balance, as far inside the bounds of their laws as they can be.
//!
//! Contacts that depend on one another, as four corners of a box, have many forces with the same motion. Whether they
//! hold is not a question of the ones of least norm: it is whether any of them are inside all cones. Those that are
//! deepest inside maximise the least of all margins, a convex problem with cones of second order; here by Newton's
//! method on a logarithmic barrier (Yu. Nesterov & A. Nemirovskii 1994), in a ball that keeps squeezed bodies finite.

use alloc::vec;
use alloc::vec::Vec;
use core::ops::Range;

use gauss_runtime::real::Real;

use crate::dense::{dot, norm};

/// The margin that a law leaves a force: `constant + part λ_n − |λ_T|`, in a unit.
#[derive(Clone, Debug)]
pub(crate) struct Margin {
    pub(crate) constant: f64,
    /// The unknown of the normal force, and the coefficient of friction; 1 for the normal force itself.
    pub(crate) presses: Option<(usize, f64)>,
    /// The unknowns of friction.
    pub(crate) tangents: Range<usize>,
    /// The factor that brings forces of different rows to one unit.
    pub(crate) scale: f64,
}

/// The forces that are deepest inside.
#[derive(Clone, Debug)]
pub(crate) struct Reserve {
    /// The least margin beside the forces; negative where no forces are inside.
    pub(crate) part: f64,
    pub(crate) forces: Vec<f64>,
    /// Forces on the way from the given ones to the deepest that are twice as far as the bounds: of what is squeezed
    /// the deepest are as large as the ball lets them be, and would leave the motion few digits.
    pub(crate) near: Vec<f64>,
    /// The weight of each margin in the least one; together 1.
    pub(crate) weights: Vec<f64>,
}

/// Bounds of forces, over the size of the ones that are given.
const LARGEST: f64 = 1e3;
/// Factor of the weight of the barrier from one time to the next, and its least.
const LESS: f64 = 0.2;
const LEAST: f64 = 1e-11;
/// Newton's steps for each weight.
const STEPS: usize = 12;

impl Margin {
    fn bound(&self, forces: &[f64]) -> f64 {
        self.scale * (self.constant + self.presses.map_or(0.0, |(row, part)| part * forces[row]))
    }

    fn value(&self, forces: &[f64]) -> f64 {
        self.bound(forces) - self.scale * norm(&forces[self.tangents.clone()])
    }
}

/// The barrier at a point: forces and a level below all margins.
struct Barrier<'a> {
    given: &'a [f64],
    free: &'a [Vec<f64>],
    margins: &'a [Margin],
    radius: f64,
}

impl Barrier<'_> {
    fn forces(&self, y: &[f64]) -> Vec<f64> {
        let mut forces = self.given.to_vec();
        for (direction, by) in self.free.iter().zip(y) {
            forces.iter_mut().zip(direction).for_each(|(force, part)| *force += by * part);
        }
        forces
    }

    fn least(&self, forces: &[f64]) -> f64 {
        self.margins.iter().map(|margin| margin.value(forces)).fold(f64::INFINITY, f64::min)
    }

    /// `−level κ − Σ log`; infinite outside.
    fn value(&self, point: &[f64], weight: f64) -> f64 {
        let (y, level) = (&point[..self.free.len()], point[self.free.len()]);
        let forces = self.forces(y);
        let ball = self.radius * self.radius - dot(y, y);
        if ball.is_nan() || ball <= 0.0 {
            return f64::INFINITY;
        }
        let mut sum = -weight * level - Real::ln(ball);
        for margin in self.margins {
            let bound = margin.bound(&forces) - level;
            let friction = margin.scale * norm(&forces[margin.tangents.clone()]);
            if bound.is_nan() || bound <= friction {
                return f64::INFINITY;
            }
            sum -= Real::ln(bound - friction) + Real::ln(bound + friction);
        }
        sum
    }

    /// The gradient and, row by row, the second derivatives.
    fn derivatives(&self, point: &[f64], weight: f64) -> (Vec<f64>, Vec<Vec<f64>>) {
        let n = self.free.len();
        let (y, level) = (&point[..n], point[n]);
        let forces = self.forces(y);
        let (mut first, mut second) = (vec![0.0; n + 1], vec![vec![0.0; n + 1]; n + 1]);
        first[n] = -weight;
        let ball = self.radius * self.radius - dot(y, y);
        for (i, (slope, row)) in first.iter_mut().zip(&mut second).enumerate().take(n) {
            *slope += 2.0 * y[i] / ball;
            row[i] += 2.0 / ball;
            row.iter_mut().zip(y).for_each(|(entry, yj)| *entry += 4.0 * y[i] * yj / (ball * ball));
        }
        for margin in self.margins {
            let of = |row: usize| self.free.iter().map(move |direction| margin.scale * direction[row]);
            let mut slope: Vec<f64> = match margin.presses {
                Some((row, part)) => of(row).map(|x| part * x).collect(),
                None => vec![0.0; n],
            };
            slope.push(-1.0);
            let bound = margin.bound(&forces) - level;
            let rows: Vec<(f64, Vec<f64>)> = margin
                .tangents
                .clone()
                .map(|row| (margin.scale * forces[row], of(row).chain(core::iter::once(0.0)).collect()))
                .collect();
            let friction = norm(&rows.iter().map(|(force, _)| *force).collect::<Vec<_>>());
            let left = (bound - friction) * (bound + friction);
            let change =
                |i: usize| 2.0 * bound * slope[i] - 2.0 * rows.iter().map(|(force, row)| force * row[i]).sum::<f64>();
            let changes: Vec<f64> = (0..=n).map(change).collect();
            first.iter_mut().zip(&changes).for_each(|(first, change)| *first -= change / left);
            for (i, second) in second.iter_mut().enumerate() {
                for (j, entry) in second.iter_mut().enumerate() {
                    let curved = slope[i] * slope[j] - rows.iter().map(|(_, row)| row[i] * row[j]).sum::<f64>();
                    *entry += changes[i] / left * (changes[j] / left) - 2.0 * curved / left;
                }
            }
        }
        (first, second)
    }
}

/// The forces `given + Σ y free` that are deepest inside; directions are orthonormal in the units of margins.
pub(crate) fn deepest(given: &[f64], free: &[Vec<f64>], margins: &[Margin], size: f64) -> Reserve {
    let n = free.len();
    let barrier = Barrier { given, free, margins, radius: LARGEST * size };
    let mut point = vec![0.0; n + 1];
    point[n] = barrier.least(given) - size;
    // Each margin has two logarithms.
    let count = 2.0 * margins.len() as f64 + 1.0;
    let mut weight = count / size;
    while size * weight * LEAST < count {
        for _ in 0..STEPS {
            let (first, second) = barrier.derivatives(&point, weight);
            let Some(step) = solved(second, &first) else { break };
            let decrease = dot(&step, &first);
            let here = barrier.value(&point, weight);
            let at = |part: f64| point.iter().zip(&step).map(|(x, by)| x - part * by).collect::<Vec<f64>>();
            let parts = core::iter::successors(Some(1.0), |part| Some(0.5 * part)).take(40);
            let better = |part: &f64| barrier.value(&at(*part), weight) < here - 0.1 * part * decrease;
            let Some(part) = parts.into_iter().find(better) else { break };
            point = at(part);
            if decrease < 1e-6 {
                break;
            }
        }
        weight /= LESS;
    }
    let forces = barrier.forces(&point[..n]);
    let least = barrier.least(&forces);
    let way = |part: f64| barrier.forces(&point[..n].iter().map(|y| part * y).collect::<Vec<f64>>());
    // Margins are concave: inside between the bounds and the deepest.
    let (mut outside, mut within) = if barrier.least(given) < 0.0 { (0.0, 1.0) } else { (0.0, 0.0) };
    for _ in 0..f64::MANTISSA_DIGITS {
        let middle = 0.5 * (outside + within);
        if barrier.least(&way(middle)) < 0.0 { outside = middle } else { within = middle }
    }
    let near = way(Real::min(2.0 * within, 1.0));
    let of = |margin: &Margin| {
        let (bound, friction) =
            (margin.bound(&forces) - point[n], margin.scale * norm(&forces[margin.tangents.clone()]));
        2.0 * bound / ((bound - friction) * (bound + friction))
    };
    let mut weights: Vec<f64> = margins.iter().map(of).collect();
    let sum: f64 = weights.iter().sum();
    weights.iter_mut().for_each(|weight| *weight /= sum);
    Reserve { part: least / size, forces, near, weights }
}

/// The solution of equations that are symmetric and positive definite; none where they are not.
fn solved(mut matrix: Vec<Vec<f64>>, right: &[f64]) -> Option<Vec<f64>> {
    let n = right.len();
    let scale: Vec<f64> = (0..n).map(|i| 1.0 / Real::sqrt(matrix[i][i])).collect();
    let mut x: Vec<f64> = right.iter().zip(&scale).map(|(b, scale)| b * scale).collect();
    for i in 0..n {
        for j in 0..=i {
            let known: f64 = (0..j).map(|k| matrix[i][k] * matrix[j][k]).sum();
            let left = matrix[i][j] * scale[i] * scale[j] - known;
            if i != j {
                matrix[i][j] = left / matrix[j][j];
            } else if left > 0.0 {
                matrix[i][i] = Real::sqrt(left);
            } else {
                return None;
            }
        }
    }
    for i in 0..n {
        let known: f64 = (0..i).map(|k| matrix[i][k] * x[k]).sum();
        x[i] = (x[i] - known) / matrix[i][i];
    }
    for i in (0..n).rev() {
        let known: f64 = (i + 1..n).map(|k| matrix[k][i] * x[k]).sum();
        x[i] = (x[i] - known) / matrix[i][i];
    }
    Some(x.iter().zip(&scale).map(|(x, scale)| x * scale).collect())
}
