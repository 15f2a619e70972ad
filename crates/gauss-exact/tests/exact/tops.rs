//! The exact motion of a heavy body of revolution: against steps of order 8, spans that add up, what is kept. Derived
//! kernels and reference solutions: `tests/splitting`.

use nalgebra::{SVector, UnitQuaternion};

use crate::integrate::{Feedback, MomentumForm, RungeKutta, State, SystemProblem, Verner9};
use crate::testing::FreeTop;
use crate::testing::order::{Torque, march};
use crate::top_orbit::Top;
use crate::triple::unit_quaternion;

const EPSILON: f64 = f64::EPSILON;

/// Of the moments, across to along.
const RATIO: f64 = 1.7;

/// Generic ones, close to both verticals, and on them.
const ATTITUDES: [[f64; 4]; 10] = [
    [0.2, 0.4, 0.8, 0.4],
    [0.3, 0.2, 0.0, 0.9],
    [0.1, 0.0, 0.0, 1.0],
    [1.0, 0.3, 0.0, 0.2],
    [1e-3, 0.0, 0.0, 1.0],
    [1.0, 0.0, 0.0, 1e-3],
    [1e-6, 0.0, 0.0, 1.0],
    [1.0, 0.0, 1e-7, 1e-8],
    [0.0, 0.0, 0.3, 1.0],
    [1.0, 0.0, 0.0, 0.0],
];

/// Tops, pendulums, rest, a spin at which sleep becomes unstable, a fast one.
const MOMENTA: [[f64; 3]; 9] = [
    [0.3, -0.2, 1.0],
    [0.4, 0.7, 0.0],
    [1.0, 0.0, -0.5],
    [1e-3, 2e-3, 1.2],
    [0.0, 0.0, 0.0],
    [3.0, 1.0, 0.3],
    [0.3, -0.1, core::f64::consts::SQRT_2],
    [0.0, 0.0, 2.0],
    [0.1, 0.2, 9.0],
];

fn top(q: [f64; 4], [m1, m2, along]: [f64; 3]) -> Top {
    let [x, y, z, w] = q.map(|c| c / q.iter().map(|c| c * c).sum::<f64>().sqrt());
    Top { alpha: [w, z], beta: [y, -x], across: [m1, m2], along }
}

/// The largest difference of attitudes, whichever sign their quaternions have, and momenta.
fn distance(a: &Top, b: &Top) -> f64 {
    let attitude = |top: &Top| [top.alpha[0], top.alpha[1], top.beta[0], top.beta[1]];
    let (p, q) = (attitude(a), attitude(b));
    let side = if p.iter().zip(q).map(|(p, q)| p * q).sum::<f64>() < 0.0 { -1.0 } else { 1.0 };
    let turns = p.iter().zip(q).map(|(p, q)| p - side * q);
    // A NaN stays one.
    turns
        .chain([0, 1].map(|i| a.across[i] - b.across[i]))
        .fold(0.0, |most, d| if d.abs() <= most { most } else { d.abs() })
}

/// The equations by hand with steps of order 9.
fn by_steps(start: &Top, t: f64, steps: u32) -> Top {
    const WEIGHT: Feedback<Torque> = Feedback(|_, q, _| {
        let up = q.inverse() * SVector::from([0.0, 0.0, 1.0]);
        [0.5 * up[1], -0.5 * up[0], 0.0]
    });
    let system = FreeTop { inertia: [1.0, 1.0, 1.0 / RATIO] };
    let problem = SystemProblem { system: &system, form: MomentumForm, input: WEIGHT };
    let q: UnitQuaternion<f64> = unit_quaternion([-start.beta[1], start.beta[0], start.alpha[1], start.alpha[0]]);
    let state = State { t: 0.0, q, y: SVector::from([start.across[0], start.across[1], start.along]) };
    let State { q, y, .. } = march(&RungeKutta(Verner9), &problem, &state, t, steps);
    let q = q.coords;
    Top { alpha: [q.w, q.z], beta: [q.y, -q.x], across: [y.x, y.y], along: y.z }
}

/// How far a state can be off that was computed in some calls, each of which commits some 16 roundings to it and to the
/// angle through which the body turns; the motion magnifies them as it magnifies a small change of the start.
fn allowed(start: &Top, t: f64, calls: f64) -> f64 {
    let small = 2.0_f64.powi(-44);
    let reached = start.after(t, RATIO);
    let sensitivity = (0..8).fold(1.0_f64, |most, k| {
        let (mut changed, by) = (*start, if k < 4 { small } else { -small });
        match k % 4 {
            0 => changed.across[0] += by,
            1 => changed.across[1] += by,
            2 => changed.along += by,
            _ => changed.beta[0] += by,
        }
        most.max(distance(&changed.after(t, RATIO), &reached) / small)
    });
    let size = 1.0 + start.along.abs() + start.across[0].hypot(start.across[1]);
    16.0 * EPSILON * calls * size * (sensitivity + size * t.abs())
}

#[test]
fn the_closed_form_is_the_motion() {
    for q in ATTITUDES {
        for m in MOMENTA {
            for t in [0.7, -2.0, 7.0] {
                let start = top(q, m);
                // Errors of so short steps are below rounding, which each commits as a call does, of either sign.
                let steps = 240;
                let (found, expected) = (start.after(t, RATIO), by_steps(&start, t, steps));
                let (error, bound) = (distance(&found, &expected), allowed(&start, t, 1.0 + f64::from(steps).sqrt()));
                assert!(error <= bound, "{q:?} {m:?} {t}: {error:e}, allowed {bound:e}");
            }
        }
    }
}

#[test]
fn spans_add_up() {
    for q in ATTITUDES {
        for m in MOMENTA {
            for (s, t) in [(0.3, 0.4), (2.0, -0.7), (25.0, 40.0), (-3.0, 1e-6)] {
                let start = top(q, m);
                let midway = start.after(s, RATIO);
                let (twice, once) = (midway.after(t, RATIO), start.after(s + t, RATIO));
                let bound = allowed(&start, s + t, 1.0) + allowed(&midway, t, 2.0);
                let error = distance(&twice, &once);
                assert!(error <= bound, "{q:?} {m:?} {s} + {t}: {error:e}, allowed {bound:e}");
            }
        }
    }
}

#[test]
fn energy_and_momentum_are_kept() {
    let kept = |top: &Top| {
        let square = |a: [f64; 2]| a[0] * a[0] + a[1] * a[1];
        let (aa, bb) = (square(top.alpha), square(top.beta));
        let lean = -2.0 * (top.alpha[0] * top.beta[0] + top.alpha[1] * top.beta[1]);
        let other = -2.0 * (top.alpha[0] * top.beta[1] - top.alpha[1] * top.beta[0]);
        let vertical = lean * top.across[0] + other * top.across[1] + top.along * (aa - bb);
        [aa + bb, square(top.across) + (aa - bb), vertical]
    };
    for q in ATTITUDES {
        for m in MOMENTA {
            for t in [1e-3, 1.0, 37.0, 1e4] {
                let start = top(q, m);
                let (before, after) = (kept(&start), kept(&start.after(t, RATIO)));
                let size = 1.0 + m.iter().map(|c| c * c).sum::<f64>();
                for (before, after) in before.iter().zip(after) {
                    let error = (before - after).abs();
                    assert!(error <= 32.0 * EPSILON * size, "{q:?} {m:?} {t}: {error:e}");
                }
            }
        }
    }
}

/// Tops beside whose spin their weight is nothing, and the other way round; what is no number, or too large for its
/// powers, ends as none.
#[test]
fn sizes_do_not_matter_and_undefined_states_stay_undefined() {
    for size in [1e-60, 1e-20, 1e20, 1e30] {
        let start = top([0.2, 0.4, 0.8, 0.4], [0.3 * size, -0.2 * size, size]);
        // Fast ones turn about their momentum, slow ones begin to fall.
        let t = if size > 1.0 { 0.7 / size } else { 0.7 };
        let (twice, once) = (start.after(0.4 * t, RATIO).after(0.6 * t, RATIO), start.after(t, RATIO));
        let relative = |top: &Top| Top { across: top.across.map(|c| c / size.max(1.0)), ..*top };
        let error = distance(&relative(&twice), &relative(&once));
        assert!(error <= 64.0 * EPSILON, "{size:e}: {error:e}");
    }
    for bad in [f64::NAN, f64::INFINITY, 1e200] {
        let reached = top([0.2, 0.4, 0.8, 0.4], [bad, 0.0, 1.0]).after(1.0, RATIO);
        assert!(!reached.alpha[0].is_finite() || !reached.across[0].is_finite(), "{bad}: {reached:?}");
    }
}
