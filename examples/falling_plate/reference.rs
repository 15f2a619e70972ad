//! The equations of falling plates as they are printed in books and papers, typed by hand, and a method to solve them.

use std::f64::consts::PI;

/// Andersen, Pesavento & Wang (2005), dimensionless: x, y, θ and the velocities along, across, and of rotation; their
/// rates.
#[must_use]
pub fn falling_card(ratio: f64, beta: f64, [_, _, theta, u, v, w]: [f64; 6]) -> [f64; 6] {
    let (a, b, mu, c_t, c_r) = (1.4, 1.0, 0.2, 1.2, PI);
    let square = u * u + v * v;
    let circulation = 2.0 / PI * (-c_t * u * v / square.sqrt() + c_r * w);
    let drag = square.sqrt() / PI * (a - b * (u * u - v * v) / square);
    let inertia = 0.25 * (ratio * (1.0 + beta * beta) + 0.5 * (1.0 - beta * beta).powi(2));
    let (sine, cosine) = theta.sin_cos();
    [
        u * cosine - v * sine,
        u * sine + v * cosine,
        w,
        ((ratio + 1.0) * w * v - circulation * v - sine - drag * u) / (ratio + beta * beta),
        (-(ratio + beta * beta) * w * u + circulation * u - cosine - drag * v) / (ratio + 1.0),
        (-(1.0 - beta * beta) * u * v - (mu + mu * w.abs()) * w) / inertia,
    ]
}

/// Chaplygin's equation of a body that falls from rest in an ideal fluid: θ and its rate, and their rates.
///
/// The fluid's and the body's impulse is that of the weight W, −W t k₂. Along and across it is m₁ u and m₂ v, so that
/// the torque (m₁ − m₂) u v on the moment of inertia J is a function of the angle and the time alone.
#[must_use]
pub fn chaplygin([m1, m2, j]: [f64; 3], weight: f64, t: f64, [theta, rate]: [f64; 2]) -> [f64; 2] {
    let (sine, cosine) = theta.sin_cos();
    [rate, (m1 - m2) / (m1 * m2) * (weight * t).powi(2) * sine * cosine / j]
}

/// The classical method of Runge and Kutta from time 0 on, steps of one length: the state at every step.
pub fn runge_kutta<const N: usize>(
    rates: impl Fn(f64, [f64; N]) -> [f64; N],
    start: [f64; N],
    h: f64,
    steps: u32,
) -> Vec<[f64; N]> {
    let shifted = |y: [f64; N], k: [f64; N], part: f64| -> [f64; N] { std::array::from_fn(|i| y[i] + part * k[i]) };
    let mut states = vec![start];
    let mut y = start;
    for n in 0..steps {
        let t = h * f64::from(n);
        let a = rates(t, y);
        let b = rates(t + 0.5 * h, shifted(y, a, 0.5 * h));
        let c = rates(t + 0.5 * h, shifted(y, b, 0.5 * h));
        let d = rates(t + h, shifted(y, c, h));
        y = std::array::from_fn(|i| y[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]));
        states.push(y);
    }
    states
}
