//! Orders of methods: errors at several steps, and the line through them on log–log axes.

use nalgebra::{Quaternion, SVector, UnitQuaternion};
use std::vec::Vec;

use crate::configuration::{Configuration, VectorSpace};
use crate::integrate::{Feedback, OneStep, Problem, Rkmk, State, Tableau};
use crate::system::GaussSystem;
use crate::testing::FreeTop;

/// The least-squares slope of log error against log step through the points (step, error) that are above the plateau of
/// rounding: ten times `rounding`, so that it changes an error by a tenth at most.
///
/// # Panics
/// When fewer than three points are left.
pub(crate) fn fitted_order(points: &[(f64, f64)], rounding: f64) -> f64 {
    let logs: Vec<_> = points.iter().filter(|(_, e)| *e > 10.0 * rounding).map(|(h, e)| (h.ln(), e.ln())).collect();
    assert!(logs.len() >= 3, "too few errors above rounding: {points:?}");
    let n = logs.len() as f64;
    let (mx, my) = (logs.iter().map(|p| p.0).sum::<f64>() / n, logs.iter().map(|p| p.1).sum::<f64>() / n);
    logs.iter().map(|(x, y)| (x - mx) * (y - my)).sum::<f64>() / logs.iter().map(|(x, _)| (x - mx).powi(2)).sum::<f64>()
}

/// So many steps of one length by a method, up to `span` later.
pub(crate) fn march<S: GaussSystem<Scalar = f64>>(
    method: &impl OneStep<S>,
    problem: &impl Problem<System = S>,
    start: &State<S>,
    span: f64,
    steps: u32,
) -> State<S> {
    let mut state = *start;
    let h = span / f64::from(steps);
    for n in 0..steps {
        state.t = start.t + f64::from(n) * h;
        let rates = problem.rates(&state);
        state = method.step(problem, &state, &rates, h).expect("steps").state;
    }
    state
}

/// Distance between two states: the largest component of the increment, and of the difference of y.
pub(crate) fn distance<S: GaussSystem<Scalar = f64>>(a: &State<S>, b: &State<S>) -> f64 {
    a.q.difference(&b.q).max_norm().max(a.y.add_scaled(-1.0, &b.y).max_norm())
}

/// The fitted order of a method over runs of the given numbers of steps. The exact end is taken from the tableau of
/// order 8 with ten times as many steps as the longest run has, so that of methods of orders up to 8 it sees the
/// errors; its own rounding grows like the root of their number.
pub(crate) fn measured_order<S: GaussSystem<Scalar = f64>>(
    method: &impl OneStep<S>,
    problem: &impl Problem<System = S>,
    start: &State<S>,
    span: f64,
    steps: &[u32],
) -> f64 {
    let most = 10 * steps.iter().copied().max().expect("some");
    let exact = march(&Rkmk::new(&Tableau::DORMAND_PRINCE_8), problem, start, span, most);
    let points: Vec<_> = steps
        .iter()
        .map(|&n| (span / f64::from(n), distance(&march(method, problem, start, span, n), &exact)))
        .collect();
    fitted_order(&points, f64::EPSILON * f64::from(most).sqrt())
}

/// A torque on a top, body frame.
pub(crate) type Torque = fn(f64, &UnitQuaternion<f64>, &SVector<f64, 3>) -> [f64; 3];

/// A torque that depends on everything, so that every order condition is needed.
pub(crate) const TORQUE: Feedback<Torque> = Feedback(|t, q, z| {
    let up = q.inverse() * SVector::from([0.0, 0.0, 1.0]);
    [0.8 * up[1] + 0.3 * t.sin(), -0.7 * up[0], 0.2 * z[0] * z[0]]
});

/// A torque that does not tell forward from backward: of a weight.
pub(crate) const WEIGHT: Feedback<Torque> = Feedback(|_, q, _| {
    let up = q.inverse() * SVector::from([0.0, 0.0, 1.0]);
    [0.6 * up[1], -0.6 * up[0], 0.0]
});

/// No torque.
pub(crate) const NONE: Feedback<Torque> = Feedback(|_, _, _| [0.0; 3]);

/// The free body of Hairer, Lubich & Wanner, *Geometric Numerical Integration*, fig. VII.5.3: body angular momentum
/// (0.2, 1, 0.4), quaternion w + xi + yj + zk = (0.4, 0.2, 0.4, 0.8).
pub(crate) const TOP: FreeTop<f64> = FreeTop { inertia: [0.5, 0.85, 1.0] };

/// Its start, with y = z.
pub(crate) fn start_by_velocity() -> State<FreeTop<f64>> {
    let q = UnitQuaternion::new_unchecked(Quaternion::new(0.4, 0.2, 0.4, 0.8));
    State { t: 0.0, q, y: SVector::from([0.2 / 0.5, 1.0 / 0.85, 0.4]) }
}

/// Its start, with y = p.
pub(crate) fn start_by_momentum() -> State<FreeTop<f64>> {
    State { y: SVector::from([0.2, 1.0, 0.4]), ..start_by_velocity() }
}
