//! The REMUS 100 in the horizontal plane, and its replay.

use std::error::Error;

use gauss_runtime::prelude::*;

use crate::recording::Recording;

/// Surge, sway and yaw: the part of the published coefficients (Prestero 2001, see `examples/data/remus100.json`) that
/// is left when the vehicle neither rolls nor pitches nor changes depth. k₁ north, k₂ east; body axes forward and
/// starboard.
#[derive(Clone, Copy, Debug, GaussDynamics)]
#[gauss(
    chart = left_invariant,
    motion = planar,
    input(thrust, rudder),
    define(v = body.body_velocity, w = body.body_angular_velocity),
    wrench(
        hull,
        force = [xuu * v.x * abs(v.x), yvv * v.y * abs(v.y) + yrr * w.z * abs(w.z) + yuv * v.x * v.y, 0],
        torque = [0, 0, nvv * v.y * abs(v.y) + nrr * w.z * abs(w.z) + nuvb * v.x * v.y],
    ),
    wrench(
        fins,
        force = [0, yuudr * v.x * v.x * rudder + yurf * v.x * w.z, 0],
        torque = [0, 0, nuudr * v.x * v.x * rudder + nuvf * v.x * v.y + nurf * v.x * w.z],
    ),
    force(propeller, body = body, value = [thrust, 0, 0]),
)]
pub struct Craft {
    /// kg.
    #[gauss(mass)]
    pub mass: f64,
    /// About the vertical axis, kg m².
    #[gauss(inertia)]
    pub inertia: f64,
    /// In the order (u, ω), pole O, kg, kg m, kg m².
    #[gauss(added_mass)]
    pub added: Matrix6<f64>,
    pub xuu: f64,
    pub yvv: f64,
    pub yrr: f64,
    pub yuv: f64,
    pub nvv: f64,
    pub nrr: f64,
    pub nuvb: f64,
    pub yuudr: f64,
    pub nuudr: f64,
    pub yurf: f64,
    pub nuvf: f64,
    pub nurf: f64,
}

impl Craft {
    /// The published vehicle, SI units.
    pub fn published() -> Self {
        let mut added = Matrix6::from_diagonal(&Vector6::new(0.93, 35.5, 35.5, 0.0704, 4.88, 4.88));
        (added[(1, 5)], added[(5, 1)]) = (-1.93, -1.93);
        (added[(2, 4)], added[(4, 2)]) = (1.93, 1.93);
        Self {
            mass: 299.0 / 9.81,
            inertia: 3.45,
            added,
            xuu: -1.62,
            yvv: -131.0,
            yrr: 0.632,
            yuv: -28.6,
            nvv: -3.18,
            nrr: -94.0,
            nuvb: 4.47,
            yuudr: 9.64,
            nuudr: -6.15,
            yurf: 6.15,
            nuvf: 6.15,
            nurf: -3.93,
        }
    }
}

/// The state at every row of a recording, from rest. Each interval between two rows is a run of its own: the input has
/// a kink at the rows, and a step that ends there does not meet it.
///
/// # Errors
/// When the integration stops.
pub fn replay(kernel: &CraftKernel, recording: &Recording) -> Result<Vec<Sample<CraftKernel>>, Box<dyn Error>> {
    let rows = recording.rows();
    let rest = SVector::zeros();
    let mut samples = vec![Sample {
        t: rows[0].time,
        q: Isometry2::identity(),
        z: rest,
        p: kernel.momentum(0.0, &Isometry2::identity(), &rest),
    }];
    for pair in rows.windows(2) {
        let last = &samples[samples.len() - 1];
        let run = Simulation::new(kernel).input_from(recording).adaptive(1e-11, 1e-12);
        samples.push(run.run_to_end(last.q, last.z, pair[0].time..pair[1].time)?.sample);
    }
    Ok(samples)
}

/// The same by hand: `(x, y, ψ, u, v, r)` at every row, by the classical Runge–Kutta method with so many steps between
/// two rows. The equations of motion are those of the manoeuvring literature.
pub fn replay_by_hand(recording: &Recording, steps: u32) -> Vec<[f64; 6]> {
    const MASS: f64 = 299.0 / 9.81;
    let rate = |t: f64, s: &SVector<f64, 6>| {
        let [_, _, psi, u, v, r]: [f64; 6] = (*s).into();
        let [thrust, rudder] = recording.at(t);
        let (sin, cos) = psi.sin_cos();
        // X_u̇ = −0.93, Y_v̇ = −35.5, Y_ṙ = N_v̇ = 1.93, N_ṙ = −4.88 enter the products as C_A(ν) ν says.
        let x = thrust - 1.62 * u * u.abs() + (MASS + 35.5) * v * r - 1.93 * r * r;
        let y = -131.0 * v * v.abs() + 0.632 * r * r.abs() - 28.6 * u * v
            + (6.15 - 0.93 - MASS) * u * r
            + 9.64 * u * u * rudder;
        let n =
            -3.18 * v * v.abs() - 94.0 * r * r.abs() + (4.47 + 6.15 - (35.5 - 0.93)) * u * v + (1.93 - 3.93) * u * r
                - 6.15 * u * u * rudder;
        // (m + 35.5) v̇ − 1.93 ṙ = Y, −1.93 v̇ + (3.45 + 4.88) ṙ = N.
        let (a, b, c) = (MASS + 35.5, -1.93, 3.45 + 4.88);
        let determinant = a * c - b * b;
        SVector::from([
            cos * u - sin * v,
            sin * u + cos * v,
            r,
            x / (MASS + 0.93),
            (c * y - b * n) / determinant,
            (a * n - b * y) / determinant,
        ])
    };
    let mut state = SVector::<f64, 6>::zeros();
    let mut states = vec![state.into()];
    for pair in recording.rows().windows(2) {
        let h = (pair[1].time - pair[0].time) / f64::from(steps);
        for n in 0..steps {
            let t = pair[0].time + h * f64::from(n);
            let k1 = rate(t, &state);
            let k2 = rate(t + 0.5 * h, &(state + k1 * (0.5 * h)));
            let k3 = rate(t + 0.5 * h, &(state + k2 * (0.5 * h)));
            let k4 = rate(t + h, &(state + k3 * h));
            state += (k1 + (k2 + k3) * 2.0 + k4) * (h / 6.0);
        }
        states.push(state.into());
    }
    states
}

/// The largest distance between the two, m.
pub fn apart(samples: &[Sample<CraftKernel>], by_hand: &[[f64; 6]]) -> f64 {
    let distance = |(sample, state): (&Sample<CraftKernel>, &[f64; 6])| {
        let place = sample.q.translation.vector;
        (place.x - state[0]).hypot(place.y - state[1])
    };
    samples.iter().zip(by_hand).map(distance).fold(0.0, f64::max)
}
