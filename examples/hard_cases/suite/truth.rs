//! The motion of one rigid body to 30 digits, by equations typed here: Kirchhoff's, with weight, solved by Taylor
//! series.
//!
//! All that the derive does is absent: the state is momentum (Q, Γ) about O in body axes, the rows γᵢ of R and the
//! place b;
//!
//! ```text
//! Q′ = Q×ω + F,  Γ′ = Γ×ω + Q×u + c×F,  F = −m g γ₃,  γᵢ′ = γᵢ×ω,  bᵢ′ = γᵢ·u,  (u, ω) = M⁻¹(Q, Γ)
//! ```
//!
//! Right-hand sides are products of two factors, so each coefficient of the series follows from those before it.

use gauss_runtime::prelude::*;
use gauss_tests::double_double::DoubleDouble;

use super::scenes::{Scene, State};

type Triple = [DoubleDouble; 3];
type Six = [DoubleDouble; 6];

/// Terms of a series. Steps are as long as the last ones allow for 1e-33.
const ORDER: usize = 36;

/// A body, with what the fluid adds, and its weight.
pub struct Body {
    kinetic: [Six; 6],
    inverse: [Six; 6],
    center: Triple,
    weight: DoubleDouble,
    /// O rests at Ω.
    held: bool,
}

/// What mass data a body has: those of its kernel, digit by digit.
#[derive(Clone, Copy)]
pub struct MassData {
    pub mass: f64,
    /// G − O, body axes.
    pub center: Vector3<f64>,
    /// About O.
    pub inertia: Matrix3<f64>,
    /// About O, order (u, ω).
    pub added: Matrix6<f64>,
    /// Along −k₃.
    pub gravity: f64,
}

impl From<&Scene> for MassData {
    fn from(scene: &Scene) -> Self {
        let Scene { mass, center, inertia, added_mass, gravity, .. } = *scene;
        Self { mass, center, inertia, added: added_mass, gravity }
    }
}

fn triple(v: &Vector3<f64>) -> Triple {
    [v.x, v.y, v.z].map(DoubleDouble::from)
}

fn plus<const N: usize>(a: [DoubleDouble; N], b: [DoubleDouble; N]) -> [DoubleDouble; N] {
    std::array::from_fn(|i| a[i] + b[i])
}

fn scaled<const N: usize>(factor: DoubleDouble, a: [DoubleDouble; N]) -> [DoubleDouble; N] {
    a.map(|x| factor * x)
}

fn cross(a: Triple, b: Triple) -> Triple {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot<const N: usize>(a: [DoubleDouble; N], b: [DoubleDouble; N]) -> DoubleDouble {
    (0..N).fold(DoubleDouble::ZERO, |sum, i| sum + a[i] * b[i])
}

fn halves(v: Six) -> (Triple, Triple) {
    ([v[0], v[1], v[2]], [v[3], v[4], v[5]])
}

/// Gauss–Jordan elimination with the largest pivot.
fn inverse(matrix: &[Six; 6]) -> [Six; 6] {
    let mut left = *matrix;
    let mut right: [Six; 6] =
        std::array::from_fn(|i| std::array::from_fn(|j| if i == j { DoubleDouble::ONE } else { DoubleDouble::ZERO }));
    for column in 0..6 {
        let size = |row: usize| left[row][column].high.abs();
        let pivot = (column..6).fold(column, |best, row| if size(row) > size(best) { row } else { best });
        left.swap(column, pivot);
        right.swap(column, pivot);
        let reciprocal = DoubleDouble::ONE / left[column][column];
        left[column] = scaled(reciprocal, left[column]);
        right[column] = scaled(reciprocal, right[column]);
        for row in (0..6).filter(|&row| row != column) {
            let factor = -left[row][column];
            left[row] = plus(left[row], scaled(factor, left[column]));
            right[row] = plus(right[row], scaled(factor, right[column]));
        }
    }
    right
}

/// One coefficient of every series.
#[derive(Clone, Copy)]
struct Coefficient {
    momentum: Six,
    twist: Six,
    rows: [Triple; 3],
    place: Triple,
}

impl Body {
    /// A free body.
    pub fn free(data: &MassData) -> Self {
        let (mass, center) = (DoubleDouble::from(data.mass), triple(&data.center));
        let first = scaled(mass, center);
        let lever = [
            [DoubleDouble::ZERO, -first[2], first[1]],
            [first[2], DoubleDouble::ZERO, -first[0]],
            [-first[1], first[0], DoubleDouble::ZERO],
        ];
        let kinetic: [Six; 6] = std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let rigid = match (i < 3, j < 3) {
                    (true, true) if i == j => mass,
                    (true, true) => DoubleDouble::ZERO,
                    (true, false) => -lever[i][j - 3],
                    (false, true) => lever[i - 3][j],
                    (false, false) => data.inertia[(i - 3, j - 3)].into(),
                };
                rigid + data.added[(i, j)].into()
            })
        });
        let weight = mass * data.gravity.into();
        Self { inverse: inverse(&kinetic), kinetic, center, weight, held: false }
    }

    /// A body that turns about O: the momentum is Γ alone, and u vanishes.
    pub fn held(data: &MassData) -> Self {
        let mut body = Self { held: true, ..Self::free(data) };
        let unit = |i: usize, j: usize| if i == j { DoubleDouble::ONE } else { DoubleDouble::ZERO };
        body.kinetic = std::array::from_fn(|i| {
            std::array::from_fn(|j| if i < 3 || j < 3 { unit(i, j) } else { body.kinetic[i][j] })
        });
        body.inverse = inverse(&body.kinetic);
        body
    }

    /// The state after the time `duration`, rounded. The quaternion given need not have norm 1 to the last digit.
    pub fn after(&self, duration: f64, pose: &Isometry3<f64>, twist: &Vector6<f64>) -> State {
        self.path(duration, 1, pose, twist)[1]
    }

    /// The states at 0, `interval`, 2 `interval`, …, `count` + 1 of them, rounded.
    pub fn path(&self, interval: f64, count: usize, pose: &Isometry3<f64>, twist: &Vector6<f64>) -> Vec<State> {
        let mut now = self.start(pose, twist);
        let mut states = vec![self.state(&now)];
        for _ in 0..count {
            now = self.advance(now, interval);
            states.push(self.state(&now));
        }
        states
    }

    fn advance(&self, mut now: Coefficient, duration: f64) -> Coefficient {
        let mut left = DoubleDouble::from(duration);
        while left.high > 0.0 {
            let series = self.series(&now);
            let h = radius(&series) * 1e-33_f64.powf(1.0 / ORDER as f64);
            let h = if h < left.high { DoubleDouble::from(h) } else { left };
            now = series.iter().rev().skip(1).fold(series[ORDER], |sum, c| Coefficient {
                momentum: plus(c.momentum, scaled(h, sum.momentum)),
                twist: c.twist,
                rows: std::array::from_fn(|i| plus(c.rows[i], scaled(h, sum.rows[i]))),
                place: plus(c.place, scaled(h, sum.place)),
            });
            left -= h;
        }
        now
    }

    fn state(&self, now: &Coefficient) -> State {
        let (u, omega) = halves(self.twist(&now.momentum));
        let value = |v: Triple| Vector3::from(v.map(|x| x.high));
        let rotation = Matrix3::from_fn(|i, j| now.rows[i][j].high);
        State { rotation, b: value(now.place), u: value(u), omega: value(omega) }
    }

    fn twist(&self, momentum: &Six) -> Six {
        self.inverse.map(|row| dot(row, *momentum))
    }

    fn start(&self, pose: &Isometry3<f64>, twist: &Vector6<f64>) -> Coefficient {
        let [x, y, z, w] = [0, 1, 2, 3].map(|i| DoubleDouble::from(pose.rotation.coords[i]));
        let norm = dot([x, y, z, w], [x, y, z, w]);
        let two = DoubleDouble::from(2.0);
        let [xx, yy, zz, ww] = [x * x, y * y, z * z, w * w];
        let rows = [
            [ww + xx - yy - zz, two * (x * y - w * z), two * (x * z + w * y)],
            [two * (x * y + w * z), ww - xx + yy - zz, two * (y * z - w * x)],
            [two * (x * z - w * y), two * (y * z + w * x), ww - xx - yy + zz],
        ];
        let twist: Six = std::array::from_fn(|i| if self.held && i < 3 { DoubleDouble::ZERO } else { twist[i].into() });
        Coefficient {
            momentum: self.kinetic.map(|row| dot(row, twist)),
            twist,
            rows: rows.map(|row| scaled(DoubleDouble::ONE / norm, row)),
            place: triple(&pose.translation.vector),
        }
    }

    fn series(&self, start: &Coefficient) -> [Coefficient; ORDER + 1] {
        let mut series = [*start; ORDER + 1];
        for k in 0..ORDER {
            series[k].twist = self.twist(&series[k].momentum);
            let force = scaled(-self.weight, series[k].rows[2]);
            let mut linear = if self.held { [DoubleDouble::ZERO; 3] } else { force };
            let mut angular = cross(self.center, force);
            let (mut rows, mut place) = ([[DoubleDouble::ZERO; 3]; 3], [DoubleDouble::ZERO; 3]);
            for i in 0..=k {
                let ((q, gamma), (u, omega)) = (halves(series[i].momentum), halves(series[k - i].twist));
                angular = plus(angular, cross(gamma, omega));
                if !self.held {
                    linear = plus(linear, cross(q, omega));
                    angular = plus(angular, cross(q, u));
                }
                for (n, row) in series[i].rows.into_iter().enumerate() {
                    rows[n] = plus(rows[n], cross(row, omega));
                    place[n] += dot(row, u);
                }
            }
            let share = DoubleDouble::ONE / DoubleDouble::from((k + 1) as f64);
            let both: Six = std::array::from_fn(|i| if i < 3 { linear[i] } else { angular[i - 3] });
            series[k + 1].momentum = scaled(share, both);
            series[k + 1].rows = rows.map(|row| scaled(share, row));
            series[k + 1].place = scaled(share, place);
        }
        series
    }
}

/// How far the series converge, from their last two terms: the shortest of linear momentum, angular momentum and
/// rotation.
fn radius(series: &[Coefficient; ORDER + 1]) -> f64 {
    let largest = |values: &[DoubleDouble]| values.iter().fold(0.0_f64, |m, v| m.max(v.high.abs()));
    let parts: [fn(&Coefficient) -> Vec<DoubleDouble>; 3] =
        [|c| c.momentum[..3].to_vec(), |c| c.momentum[3..].to_vec(), |c| c.rows.as_flattened().to_vec()];
    let mut least = f64::INFINITY;
    for part in parts {
        let first = largest(&part(&series[0]));
        for k in [ORDER - 1, ORDER] {
            let term = largest(&part(&series[k]));
            if term > 0.0 && first > 0.0 {
                least = least.min((first / term).powf(1.0 / k as f64));
            }
        }
    }
    least
}
