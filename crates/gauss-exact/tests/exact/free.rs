//! Free motions: closed forms, the group property, what is kept, orders, and what is refused. Reference solutions are
//! met by derived kernels in `tests/splitting`.

use std::vec::Vec;

use gauss_exact::{FreeFlow, FreeMotion, MoserVeselov};
use gauss_runtime::lie::so3;
use gauss_runtime::simd::Lanes;
use nalgebra::{SVector, UnitQuaternion, Vector3};

use crate::integrate::IntegrationErrorKind;
use crate::real::Real;
use crate::triple::{quaternion, rotate, unit_quaternion};

type State = (UnitQuaternion<f64>, Vector3<f64>);

const EPSILON: f64 = f64::EPSILON;

/// Moments in every order and every degeneracy; the last two are a needle and a formal body of Hairer, Lubich & Wanner.
const BODIES: [[f64; 3]; 9] = [
    [1.0, 2.0, 3.0],
    [3.0, 1.5, 2.0],
    [2.0, 3.0, 1.25],
    [1.0, 1.0, 1.7],
    [2.0, 1.1, 2.0],
    [0.3, 2.0, 2.0],
    [1.0, 1.0, 1.0],
    [1.0, 1.000_000_2, 1e-6],
    [0.5, 0.85, 1.0],
];

/// Both sides of the separatrix, near it, on it for the first body up to rounding, along axes, and nearly so.
const MOMENTA: [[f64; 3]; 12] = [
    [0.2, 1.0, 0.4],
    [1.8, -0.4, -0.9],
    [-1.0, 0.3, 0.1],
    [0.1, -0.2, 2.0],
    [1e-9, 2.0, 3e-9],
    [3.0, 1.0, 5.196_152_422_706_632],
    [0.0, 1.5, 0.0],
    [0.0, 0.0, -3.0],
    [1e-170, -1e-200, 1.0],
    [1.0, 1e-12, -1e-12],
    [0.0, 1.0, 1.0],
    [1.0, 0.0, -1.0],
];

fn advance(motion: &impl FreeMotion<f64>, (q, y): State, h: f64) -> State {
    let turn = motion.turn(&y, h).expect("a regular step");
    (so3::renormalise(&(q * turn.rotation)), y + turn.change)
}

fn start(y: [f64; 3]) -> State {
    (unit_quaternion([0.2, 0.4, 0.8, 0.4]), Vector3::from(y))
}

/// The difference of two states: of attitudes as an angle, of momenta relative to their length.
fn distance(a: State, b: State) -> f64 {
    let delta = so3::difference(&a.0, &b.0);
    delta.amax().max((a.1 - b.1).amax() / b.1.norm().max(f64::MIN_POSITIVE))
}

fn energy(i: [f64; 3], y: Vector3<f64>) -> f64 {
    0.5 * (0..3).map(|k| y[k] * y[k] / i[k]).sum::<f64>()
}

/// How far a state can be off when it was computed in `calls` calls: each commits some 16 roundings to the momentum,
/// which the motion magnifies as it magnifies a small change of the start, and moments and spans are rounded once, so
/// that the angle through which it turns counts too.
fn allowed(i: [f64; 3], y: [f64; 3], t: f64, calls: f64) -> f64 {
    let flow = FreeFlow::new(i);
    let small = 2.0_f64.powi(-30);
    let reached = advance(&flow, start(y), t);
    let size = Vector3::from(y).norm();
    let sensitivity = (0..6).fold(1.0_f64, |most, k| {
        let mut changed = y;
        changed[k % 3] += if k < 3 { small * size } else { -small * size };
        most.max(distance(advance(&flow, start(changed), t), reached) / small)
    });
    let fastest = (0..3).fold(0.0_f64, |m, k| m.max((y[k] / i[k]).abs()));
    16.0 * EPSILON * calls * (sensitivity + fastest * t.abs())
}

#[test]
fn spans_add_up() {
    for i in BODIES {
        for y in MOMENTA {
            for (s, t) in [(0.3, 0.4), (2.0, -0.7), (5.0, 11.0), (-3.0, 1e-6)] {
                let flow = FreeFlow::new(i);
                let twice = advance(&flow, advance(&flow, start(y), s), t);
                let once = advance(&flow, start(y), s + t);
                // On the way the state may be more sensitive than from the start.
                let midway = advance(&flow, start(y), s).1.into();
                let bound = allowed(i, y, s + t, 3.0) + allowed(i, midway, t, 3.0) + allowed(i, y, s, 3.0);
                let error = distance(twice, once);
                assert!(error <= bound, "{i:?} {y:?} {s} + {t}: {error:e}, allowed {bound:e}");
            }
        }
    }
}

#[test]
fn energy_and_momentum_are_kept_by_every_call() {
    for i in BODIES {
        for y in MOMENTA {
            for t in [1e-3, 1.0, 37.0, 1e4] {
                let (q, reached) = advance(&FreeFlow::new(i), start(y), t);
                let y = Vector3::from(y);
                let t_defect = (energy(i, reached) / energy(i, y) - 1.0).abs();
                // Sums of three products, and components rounded once more.
                assert!(t_defect <= 8.0 * EPSILON, "{i:?} {y:?} {t}: T {t_defect:e}");
                assert!((reached.norm() / y.norm() - 1.0).abs() <= 8.0 * EPSILON, "{i:?} {y:?} {t}");
                let space = rotate(quaternion(&q), reached.into());
                let before = rotate(quaternion(&start([0.0; 3]).0), y.into());
                let off = Vector3::from(space) - Vector3::from(before);
                // ψ is the one large angle, and turns about the momentum; tilts and headings are of two states.
                assert!(off.amax() <= 32.0 * EPSILON * y.norm(), "{i:?} {y:?} {t}: {:e}", off.amax() / y.norm());
            }
        }
    }
}

/// A body of revolution: y turns at the rate y₃(1/I₁ − 1/I₃) about its axis, the axis at the rate |y|/I₁ about y.
#[test]
fn a_body_of_revolution_as_in_the_textbook() {
    for (i, axis) in [([1.0, 1.0, 1.7], 2), ([2.0, 1.1, 2.0], 1), ([0.3, 2.0, 2.0], 0)] {
        for y in MOMENTA {
            for t in [0.7, 12.0] {
                let across = i[(axis + 1) % 3];
                let momentum = Vector3::from(y);
                let mut about = Vector3::zeros();
                about[axis] = momentum[axis] * (1.0 / i[axis] - 1.0 / across) * t;
                let delta = so3::exp(&(momentum * (t / across))) * so3::exp(&about);
                let (q, _) = start(y);
                let expected = (q * delta, delta.inverse() * momentum);
                let error = distance(advance(&FreeFlow::new(i), (q, momentum), t), expected);
                let bound = allowed(i, y, t, 2.0);
                assert!(error <= bound, "{i:?} {y:?} {t}: {error:e}, allowed {bound:e}");
            }
        }
    }
}

/// A steady spin has the same sine and cosine in every call: their rounding, left alone, would add up to n/10 units of
/// the last place. What is left are roundings of momenta, of either sign: √n of them, with a factor.
#[test]
fn the_momentum_of_a_body_of_revolution_does_not_drift() {
    const CALLS: u32 = 100_000;
    let allowed = 4.0 * f64::from(CALLS).sqrt() * EPSILON;
    for (i, h) in [([1.0, 1.0, 0.3], 0.37), ([2.0, 1.1, 2.0], 0.9), ([0.3, 2.0, 2.0], 0.011)] {
        let (flow, before) = (FreeFlow::new(i), start([0.2, 1.0, 0.4]));
        let (_, y) = (0..CALLS).fold(before, |state, _| advance(&flow, state, h));
        assert!((y.norm() / before.1.norm() - 1.0).abs() < allowed, "{i:?}: {:e}", y.norm() / before.1.norm() - 1.0);
        assert!((energy(i, y) / energy(i, before.1) - 1.0).abs() < allowed, "{i:?}");
    }
}

/// Powers of two as units change nothing, also where squares would leave the range of numbers.
#[test]
fn units_do_not_matter() {
    let (i, y, t) = ([0.5, 0.85, 1.0], Vector3::new(0.2, 1.0, 0.4), 3.0);
    for exponent in [-500, 500] {
        let unit = 2.0_f64.powi(exponent);
        let scaled = i.map(|m| m * unit);
        for (plain, other) in [
            (FreeFlow::new(i).turn(&y, t), FreeFlow::new(scaled).turn(&(y * unit), t)),
            (MoserVeselov::new(i).turn(&y, t / 10.0), MoserVeselov::new(scaled).turn(&(y * unit), t / 10.0)),
        ] {
            let (plain, other) = (plain.expect("regular"), other.expect("regular"));
            // The discrete method's unit is the largest moment, 1 here.
            assert_eq!(plain.rotation, other.rotation);
            assert_eq!(plain.change * unit, other.change);
        }
    }
}

#[test]
fn rest_stays_rest() {
    let rest = Vector3::zeros();
    for motion in [FreeFlow::new([1.0, 2.0, 3.0]).turn(&rest, 5.0), MoserVeselov::new([1.0, 2.0, 3.0]).turn(&rest, 5.0)]
    {
        let turn = motion.expect("rest is regular");
        assert_eq!((turn.rotation, turn.change), (UnitQuaternion::identity(), rest));
    }
}

#[test]
fn what_is_not_finite_is_refused() {
    for bad in [f64::NAN, f64::INFINITY] {
        let y = Vector3::new(1.0, bad, 0.5);
        let fine = Vector3::new(1.0, 2.0, 0.5);
        for i in BODIES {
            assert!(FreeFlow::new(i).turn(&y, 0.1).is_err() && FreeFlow::new(i).turn(&fine, bad).is_err(), "{i:?}");
            assert!(MoserVeselov::new(i).turn(&y, 0.1).is_err(), "{i:?}");
            assert!(MoserVeselov::new(i).turn(&fine, bad).is_err(), "{i:?}");
        }
    }
}

#[test]
fn a_step_beyond_the_range_is_refused_in_words() {
    let body = MoserVeselov::new([0.5, 0.85, 1.0]);
    let y = Vector3::new(0.2, 1.0, 0.4);
    for h in [3.0, 30.0, 1e10] {
        let refused = body.turn(&y, h).expect_err("several radians a step");
        assert!(matches!(refused, IntegrationErrorKind::NotConverged { .. }), "{h}: {refused:?}");
    }
}

/// The errors at T = 30 that were measured elsewhere with another implementation: max norm of the difference of R.
#[test]
fn corrections_have_their_orders_and_published_errors() {
    let i = [0.5, 0.85, 1.0];
    let q = unit_quaternion([0.2, 0.4, 0.8, 0.4]);
    let y = Vector3::new(0.2, 1.0, 0.4);
    let exact = advance(&FreeFlow::new(i), (q, y), 30.0);
    let matrix = |q: UnitQuaternion<f64>| q.to_rotation_matrix().into_inner();
    let published: [(u32, [f64; 4]); 5] = [
        (2, [4.2e-1, 1.0e-1, 2.5e-2, 6.2e-3]),
        (4, [1.4e-3, 8.6e-5, 5.3e-6, 3.3e-7]),
        (6, [2.3e-6, 3.6e-8, 5.5e-10, 8.6e-12]),
        (8, [2.3e-9, 8.8e-12, 4e-14, 0.0]),
        (10, [2.2e-12, 1.7e-14, 3e-15, 0.0]),
    ];
    for (order, published) in published {
        let method = MoserVeselov::of_order(i, order);
        let mut errors = Vec::new();
        for (published, steps) in published.into_iter().zip([150, 300, 600, 1200]) {
            let h = 30.0 / f64::from(steps);
            let reached = (0..steps).fold((q, y), |state, _| advance(&method, state, h));
            let error = (matrix(reached.0) - matrix(exact.0)).amax();
            // Two digits were published; the attitude there starts from another quaternion, so that R differs by a
            // rotation of space and its largest entry by some ten per cent. Rounding: one in every step, of random
            // sign, where a change of T by one turns the body by another angle 30 rad later.
            let rounding = 30.0 * EPSILON * f64::from(steps).sqrt();
            assert!(error <= 1.5 * published + rounding, "order {order}, {steps} steps: {error:e}, {published:e}");
            errors.push((error, rounding));
        }
        for pair in errors.windows(2).filter(|pair| pair[1].0 > 20.0 * pair[1].1) {
            let slope = (pair[0].0 / pair[1].0).log2();
            assert!((slope - f64::from(order)).abs() < 0.3, "order {order}: {slope}");
        }
    }
}

#[test]
fn a_step_back_undoes_a_step() {
    for i in [[0.5, 0.85, 1.0], [3.0, 1.5, 2.0]] {
        for y in MOMENTA {
            let back =
                |motion: &dyn Fn(State, f64) -> State, h: f64| distance(motion(motion(start(y), h), -h), start(y));
            let bound =
                allowed(i, y, 0.2, 4.0) + allowed(i, advance(&FreeFlow::new(i), start(y), 0.2).1.into(), -0.2, 4.0);
            let discrete = MoserVeselov::new(i);
            let exact = FreeFlow::new(i);
            assert!(back(&|state, h| advance(&discrete, state, h), 0.1) <= bound, "{i:?} {y:?}");
            assert!(back(&|state, h| advance(&exact, state, h), 0.2) <= bound, "{i:?} {y:?}");
        }
    }
}

#[test]
fn lanes_move_by_themselves() {
    let (i, y) = ([[0.5, 0.85, 1.0], [3.0, 1.5, 2.0]], [[0.2, 1.0, 0.4], [1.8, -0.4, -0.9]]);
    let pack = |v: [[f64; 3]; 2]| core::array::from_fn(|k| Lanes([v[0][k], v[1][k]]));
    let both = MoserVeselov::new(pack(i)).turn(&SVector::from(pack(y)), Lanes::from_f64(0.1)).expect("regular");
    for lane in 0..2 {
        let one = MoserVeselov::new(i[lane]).turn(&Vector3::from(y[lane]), 0.1).expect("regular");
        // The slower lane decides on the number of iterations: the other one may be nearer to its root.
        let off = (0..3).fold(0.0_f64, |m, k| m.max((both.change.data.0[0][k].0[lane] - one.change[k]).abs()));
        assert!(off <= 16.0 * EPSILON, "{off:e}");
    }
}
