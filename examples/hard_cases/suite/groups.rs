//! exp, log and dexp⁻¹ where closed formulas cancel or have a pole.

use std::error::Error;
use std::f64::consts::PI;

use gauss_runtime::lie::coefficients;
use gauss_runtime::lie::so3;
use gauss_runtime::prelude::*;
use gauss_tests::double_double::DoubleDouble;

use super::measure::worse;
use super::methods::{end, order_8};
use super::scenes::Scene;
use super::{Effort, Measure, naive};

type Measures = Result<Vec<Measure>, Box<dyn Error>>;

/// Angles from the smallest double to half a turn, all branches of the series among them.
fn angles(effort: Effort) -> Vec<f64> {
    let per_decade = if effort == Effort::Quick { 4 } else { 200 };
    let decades = (-20 * per_decade..=0).map(|n| PI * 10.0_f64.powf(f64::from(n) / f64::from(per_decade)));
    let linear = (1..500).map(|n| PI * f64::from(n) / 500.0);
    [5e-324, 1e-308, 1e-200, 1e-100].into_iter().chain(decades).chain(linear).collect()
}

/// Σ xⁿ·c(n), c(0) = first, c(n+1)/c(n) = p/q of the ratio.
fn sum(x: DoubleDouble, first: DoubleDouble, ratio: impl Fn(f64) -> (f64, f64)) -> DoubleDouble {
    let (mut total, mut term) = (DoubleDouble::ZERO, first);
    for n in 0..40 {
        total += term;
        let (p, q) = ratio(f64::from(n));
        term = term * x * DoubleDouble::from(p) / DoubleDouble::from(q);
    }
    total
}

/// (1 − cos θ)/θ², (θ − sin θ)/θ³ and (1 − (θ/2) cot(θ/2))/θ² at −θ², to 30 digits.
fn exact(minus_square: DoubleDouble) -> [DoubleDouble; 3] {
    let part = |p: f64, q: f64| DoubleDouble::from(p) / DoubleDouble::from(q);
    let versine = sum(minus_square, part(1.0, 2.0), |n| (1.0, (2.0 * n + 3.0) * (2.0 * n + 4.0)));
    let cubic = sum(minus_square, part(1.0, 6.0), |n| (1.0, (2.0 * n + 4.0) * (2.0 * n + 5.0)));
    // (2·versine − sinc)/θ² over 2·versine.
    let difference = sum(minus_square, part(1.0, 12.0), |n| (n + 2.0, (n + 1.0) * (2.0 * n + 5.0) * (2.0 * n + 6.0)));
    [versine, cubic, difference / (versine + versine)]
}

fn relative(found: f64, exact: DoubleDouble) -> f64 {
    ((DoubleDouble::from(found) - exact) / exact).high.abs()
}

/// The quaternion of a rotation vector, to 30 digits.
fn exact_exp(sigma: &Vector3<f64>) -> [DoubleDouble; 4] {
    let components = [sigma.x, sigma.y, sigma.z].map(DoubleDouble::from);
    let square = components.into_iter().fold(DoubleDouble::ZERO, |sum, c| sum + c * c);
    let x = -(square * DoubleDouble::from(0.25));
    let sinc = sum(x, DoubleDouble::ONE, |n| (1.0, (2.0 * n + 2.0) * (2.0 * n + 3.0)));
    let cosine = sum(x, DoubleDouble::ONE, |n| (1.0, (2.0 * n + 1.0) * (2.0 * n + 2.0)));
    let half = DoubleDouble::from(0.5) * sinc;
    let [x, y, z] = components.map(|c| half * c);
    [x, y, z, cosine]
}

/// The error of a quaternion: of its vector relative to the vector, of the scalar relative to 1. What is less than the
/// smallest double does not count.
fn quaternion_error(found: [f64; 4], exact: [DoubleDouble; 4]) -> f64 {
    let errors: [f64; 4] = std::array::from_fn(|i| (DoubleDouble::from(found[i]) - exact[i]).high.abs());
    let size = exact[..3].iter().fold(0.0_f64, |m, v| m.max(v.high.abs()));
    let vector = errors[..3].iter().fold(0.0_f64, |m, &e| worse(m, e));
    let counted = if vector <= 5e-324 { 0.0 } else { vector / size };
    worse(counted, errors[3])
}

const AXIS: [f64; 3] = [0.6, -0.48, 0.64];

pub fn small_angles(effort: Effort) -> Measures {
    let mut ours = [0.0_f64; 4];
    let mut typed = [0.0_f64; 4];
    for theta in angles(effort) {
        let square = theta * theta;
        // What a function of θ² is given is the rounded square; what one of θ is given is θ.
        let at_square = exact(-DoubleDouble::from(square));
        let at_angle = exact(-(DoubleDouble::from(theta) * DoubleDouble::from(theta)));
        let found = [coefficients::versine(square), coefficients::cubic(square), coefficients::dexp_inv(square)];
        let naive = [naive::versine(theta), naive::cubic(theta), naive::dexp_inv(theta)];
        for i in 0..3 {
            ours[i] = worse(ours[i], relative(found[i], at_square[i]));
            // Below 1e-8 everything is lost; 0/0 comes later.
            typed[i] = if theta < 1e-8 { typed[i] } else { worse(typed[i], relative(naive[i], at_angle[i])) };
        }
        let sigma = Vector3::from(AXIS) * theta;
        let q = so3::exp(&sigma).coords;
        ours[3] = worse(ours[3], quaternion_error([q[0], q[1], q[2], q[3]], exact_exp(&sigma)));
        typed[3] = worse(typed[3], quaternion_error(naive::exp(&sigma), exact_exp(&sigma)));
    }
    let zero = so3::exp(&Vector3::<f64>::zeros()) == UnitQuaternion::identity();
    let method = "series and half angles, θ from 5e-324 to π";
    let names = ["(1 − cos θ)/θ²", "(θ − sin θ)/θ³", "dexp⁻¹ coefficient"];
    let mut measures: Vec<Measure> = (0..3)
        .map(|i| {
            let what = format!("{}, relative error", names[i]);
            Measure::new(what, method, ours[i], 4e-16).naive("as it is written, θ above 1e-8", typed[i])
        })
        .collect();
    let note = if zero { "exp(0) is the identity, bit by bit" } else { "exp(0) is not the identity" };
    measures.push(
        Measure::new("exp on SO(3), relative error", method, ours[3], 4e-16)
            .naive("σ/|σ| sin(|σ|/2): 0/0 where |σ|² vanishes", typed[3])
            .note(note),
    );
    Ok(measures)
}

pub fn half_turn(effort: Effort) -> Measures {
    let per_decade = if effort == Effort::Quick { 4 } else { 100 };
    let (mut ours, mut typed) = (0.0_f64, 0.0_f64);
    for n in 0..=15 * per_decade {
        let theta = PI - 10.0_f64.powf(-f64::from(n) / f64::from(per_decade));
        let sigma = Vector3::from(AXIS) * theta;
        let rotation = so3::exp(&sigma);
        ours = worse(ours, (so3::log(&rotation) - sigma).amax() / theta);
        typed = worse(typed, (naive::angle(&rotation.to_rotation_matrix().into_inner()) - sigma.norm()).abs() / theta);
    }
    Ok(vec![
        Measure::new("log(exp σ) − σ, relative, |σ| up to π", "atan2 of vector and scalar part", ours, 8e-16)
            .because("4e-16 each for exp and log")
            .naive("arccosine of the trace", typed),
    ])
}

pub fn many_turns(effort: Effort) -> Measures {
    let scene = Scene::top("free_asym_top")?;
    let kernel = scene.free_top().kernel()?;
    let (start, last) = (scene.initial, scene.last);
    let h = if effort == Effort::Quick { 0.04 } else { 0.01 };
    // One rotation vector for the whole run, of Euler's equations by hand, with dexp⁻¹ in full.
    let inertia = scene.inertia.diagonal();
    let rate = |y: &SVector<f64, 6>| {
        let (s, w) = (Vector3::new(y[0], y[1], y[2]), Vector3::new(y[3], y[4], y[5]));
        let once = s.cross(&w);
        let turn = w + once * 0.5 + s.cross(&once) * naive::dexp_inv(s.norm().max(1e-6));
        let l = inertia.component_mul(&w);
        let spin = l.cross(&w).component_div(&inertia);
        SVector::from([turn.x, turn.y, turn.z, spin.x, spin.y, spin.z])
    };
    let w = start.omega;
    let y = SVector::from([0.0, 0.0, 0.0, w.x, w.y, w.z]);
    let steps = (scene.duration / h).round() as u64;
    let y = naive::runge_kutta(rate, y, h, steps, |_| ());
    let turned = start.pose().rotation * so3::exp(&Vector3::new(y[0], y[1], y[2]));
    let error = (turned.to_rotation_matrix().into_inner() - last.rotation).amax();
    let words = format!("one rotation vector for the run, RK4, h = {h}");
    Ok([
        ("order 8, recentred each step", end(&kernel, VelocityForm, order_8(h), &start, scene.duration)?),
        ("the same, momenta", end(&kernel, MomentumForm, order_8(h), &start, scene.duration)?),
    ]
    .into_iter()
    .map(|(method, (found, _))| {
        Measure::new("7 turns: worst error of R and ω", method, found.distance(&last), 1e-12).naive(&*words, error)
    })
    .collect())
}
